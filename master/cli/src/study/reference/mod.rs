//! What the runs of a study are compared with.

mod monolithic;
mod trajectory;

use linchpin_master::RunError;
use linchpin_master::results::Statistics;
use linchpin_master::scene::{self, Scene};

use super::StudyError;
use super::columns::{Column, Kind, names};
use super::runs::{Variant, watched};
use crate::closed_form::{self, ClosedForm};
pub use monolithic::Monolithic;
pub use trajectory::Trajectory;

/// Exact or nearly exact values of the judged columns.
pub enum Reference {
    /// The exact solution.
    ClosedForm {
        /// The solution.
        solution: ClosedForm,
        /// What the judged columns are of it.
        quantities: Vec<Option<closed_form::Quantity>>,
    },
    /// A run.
    Run {
        /// Its macro points; those of a monolithic scene are interpolated.
        trajectory: Trajectory,
        /// Judged columns that have values at macro points of the run only: multipliers that jump from step to step.
        at_points_only: Vec<bool>,
    },
}

impl Reference {
    /// The reference that does not depend on the runs: closed form or monolithic scene. `None`: the finest run.
    ///
    /// # Errors
    /// [`StudyError`]: what is asked for does not exist, or the monolithic scene does not run.
    pub fn known(
        variant: &Variant,
        columns: &[Column],
        wanted: scene::Reference,
    ) -> Result<Option<Self>, StudyError> {
        let closed_form = || {
            let solution = ClosedForm::of(&variant.scene)?;
            Some(Self::closed_form(solution, columns))
        };
        match wanted {
            scene::Reference::Finest => Ok(None),
            scene::Reference::ClosedForm => {
                let found = closed_form().ok_or_else(|| StudyError::NoClosedForm {
                    case: variant.in_words(),
                })?;
                Ok(Some(found))
            }
            scene::Reference::Monolithic => {
                let found = Monolithic::of(&variant.scene, columns)?;
                let found = found.ok_or_else(|| StudyError::NoMonolithic {
                    case: variant.in_words(),
                })?;
                Ok(Some(found.reference(variant)?))
            }
            scene::Reference::Automatic => match closed_form() {
                Some(reference) => Ok(Some(reference)),
                None => match Monolithic::of(&variant.scene, columns)? {
                    Some(monolithic) => Ok(Some(monolithic.reference(variant)?)),
                    None => Ok(None),
                },
            },
        }
    }

    fn closed_form(solution: ClosedForm, columns: &[Column]) -> Self {
        let quantities = columns.iter().map(|column| solution.quantity(&column.name));
        Self::ClosedForm {
            quantities: quantities.collect(),
            solution,
        }
    }

    /// A run of a coupled scene, whose multipliers may jump, with its statistics; or how it diverged.
    ///
    /// # Errors
    /// What stopped the run otherwise.
    pub fn of_run(
        scene: &Scene,
        columns: &[Column],
    ) -> Result<Result<(Self, Statistics), String>, RunError> {
        let mut trajectory = Trajectory::new(columns.len());
        let outcome = watched(scene, &names(columns), |t, values| {
            trajectory.add(t, values);
        })?;
        let at_points_only = columns.iter().map(|column| column.kind == Kind::Multiplier);
        let reference = Self::Run {
            trajectory,
            at_points_only: at_points_only.collect(),
        };
        Ok(outcome.map(|statistics| (reference, statistics)))
    }

    /// Whether it knows values between the macro points of all runs.
    pub fn is_dense(&self) -> bool {
        match self {
            Self::ClosedForm { .. } => true,
            Self::Run { at_points_only, .. } => !at_points_only.contains(&true),
        }
    }

    /// Value of a column at time `t`; `None` where nothing is known.
    pub fn value(&self, column: usize, t: f64) -> Option<f64> {
        match self {
            Self::ClosedForm {
                solution,
                quantities,
            } => solution.value(quantities[column]?, t),
            Self::Run {
                trajectory,
                at_points_only,
            } => {
                let value = match at_points_only[column] {
                    true => trajectory.at_point(column, t),
                    false => trajectory.value(column, t),
                };
                value.filter(|value| value.is_finite())
            }
        }
    }
}
