//! What may stand against a macro step that no worker has taken yet.

use crate::accuracy::{Estimate, SingularPosition};
use crate::error::RunError;
use crate::layout::Layout;
use crate::methods::SingularRow;
use crate::policies::iteration::Unconverged;
use crate::policies::step_size::{Cause, Repetition, StepSize};
use crate::time::MacroStep;

/// Why an attempt at a macro step came to nothing. Workers stand where they stood before it.
#[derive(Debug)]
pub struct Rejection {
    cause: Cause,
    /// What the run stops with where no step can be shorter.
    error: Box<RunError>,
}

impl Rejection {
    /// The error is larger than allowed: that `found`, and that which the step would have had with the degrees of its repetition.
    pub fn by_error(
        layout: &Layout,
        step: MacroStep,
        step_size: &StepSize,
        [found, next]: [Estimate; 2],
    ) -> Self {
        Self {
            cause: Cause::Error { found, next },
            error: Box::new(RunError::LeastStep {
                t: step.start,
                step: step.length,
                error: found.scaled,
                tolerance: step_size.control().tolerance,
                variable: found.suspect_name(layout),
            }),
        }
    }

    /// The corrections have not come to an end within their number.
    pub fn not_converged(layout: &Layout, step: MacroStep, because: Unconverged) -> Self {
        Self {
            cause: match because.rejects {
                true => Cause::NotConverged(because.share),
                false => Cause::Failed,
            },
            error: Box::new(RunError::NotConverged {
                t: step.start,
                step: step.length,
                unknown: layout.variable_name(because.change.variable),
                change: because.change.of_size,
                tolerance: because.tolerance,
                passes: because.passes,
                rate: because.rate,
                remedy: "a smaller coupling.macro_step",
            }),
        }
    }

    /// How the step, which may end near a singular position, is repeated; the error if it cannot be.
    pub fn repetition(
        self,
        step_size: Option<&mut StepSize>,
        step: MacroStep,
        singular: Option<SingularPosition>,
    ) -> Result<Repetition, RunError> {
        let Self { cause, error } = self;
        let is_final = cause == Cause::Failed && !error.may_vanish_with_a_shorter_step();
        let Some(step_size) = step_size.filter(|own| own.varies() && !is_final) else {
            return Err(*error);
        };
        match step_size.repeat(step, cause, singular) {
            Some(repetition) => {
                log(step, cause, &error, repetition);
                Ok(repetition)
            }
            None if singular.is_some() => Err(RunError::NearSingular(error)),
            None => Err(of_least_step(*error)),
        }
    }
}

impl From<RunError> for Rejection {
    fn from(error: RunError) -> Self {
        Self {
            cause: Cause::Failed,
            error: Box::new(error),
        }
    }
}

/// Nothing determines a multiplier in `step`.
pub fn singular(singular: SingularRow, layout: &Layout, step: MacroStep) -> RunError {
    RunError::Singular {
        unknown: layout.variable_name(singular.row),
        level: singular.level.name(),
        t: step.start,
        step: step.length,
    }
}

/// The error of a failure of the shortest step.
fn of_least_step(mut error: RunError) -> RunError {
    match &mut error {
        RunError::NotConverged { remedy, .. } => {
            *remedy = "a smaller coupling.least_step, which H has come down to";
            error
        }
        RunError::LeastStep { .. } => error,
        _ => RunError::NoShorterStep(Box::new(error)),
    }
}

/// Why a step is repeated, and how.
fn log(step: MacroStep, cause: Cause, error: &RunError, repetition: Repetition) {
    let (tried, next) = (step.length, repetition.length);
    match (cause, error) {
        (Cause::Error { found, .. }, RunError::LeastStep { variable, .. }) => {
            tracing::debug!(
                H = tried,
                error = found.scaled,
                order = found.order,
                of = variable,
                next_H = next,
                has_jumped = repetition.has_jumped,
                "rejected: error above tolerance"
            );
        }
        (Cause::NotConverged(_), because) => {
            tracing::debug!(H = tried, next_H = next, %because, "rejected: not converged");
        }
        (_, because) => tracing::debug!(H = tried, next_H = next, %because, "rejected: failed"),
    }
}
