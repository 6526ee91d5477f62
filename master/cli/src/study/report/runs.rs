//! Runs whose time is measured.

use linchpin_master::RunError;
use linchpin_master::scene::Scene;
use serde::{Deserialize, Serialize};

use super::Depth;
use crate::study::StudyError;
use crate::study::columns::{Column, names};
use crate::study::errors::{Quantity, RunErrors};
use crate::study::reference::{Monolithic, Reference};
use crate::study::run::{Ending, StudyRun};
use crate::study::runs::{watched, with_macro_step};

/// A run of the monolithic scene.
#[derive(Serialize, Deserialize)]
pub struct ToleranceRun {
    /// Relative and absolute tolerance of its solver.
    pub tolerance: f64,
    /// How it ended.
    pub ending: Ending,
}

/// A relative error of this size is that of a run which has nothing to do with the solution.
pub(super) const USELESS: f64 = 1.0;

/// Runs are repeated so many times, unless they have taken this long in s.
const REPETITIONS: usize = 5;
const LONG: f64 = 0.3;

impl Ending {
    /// In a word.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Done { .. } => "done",
            Self::Stopped(_) => "stopped",
            Self::Refused(_) => "refused",
            Self::Missing => "missing",
        }
    }

    /// Why the run is not stable; `None` if it is.
    pub fn instability(&self, quantity: Quantity) -> Option<String> {
        match self {
            Self::Done { .. } => {
                let error = self.error(quantity).filter(|error| *error >= USELESS)?;
                Some(format!("off by {error:.1e} of the solution"))
            }
            Self::Stopped(reason) | Self::Refused(reason) => Some(reason.clone()),
            Self::Missing => Some("the study ended before this run".to_owned()),
        }
    }
}

/// What all runs of a scene share.
pub struct Compared<'a> {
    /// The judged columns.
    pub columns: &'a [Column],
    /// What they are compared with.
    pub reference: &'a Reference,
    /// How often runs are repeated.
    pub depth: Depth,
}

impl Compared<'_> {
    /// Runs a scene with a macro step.
    ///
    /// # Errors
    /// The macro step does not fit the scene; an interrupt.
    pub fn run(&self, scene: &Scene, macro_step: f64) -> Result<StudyRun, StudyError> {
        let scene = with_macro_step(scene, macro_step)?;
        let are_means = scene.coupling.multipliers_are_step_means();
        let ending = self.timed(&scene, &names(self.columns), are_means);
        Ok(StudyRun { macro_step, ending })
    }

    /// Runs the monolithic scene with a tolerance; its macro points are those of `macro_step`.
    ///
    /// # Errors
    /// The solver cannot have this tolerance.
    pub fn run_monolithic(
        &self,
        monolithic: &Monolithic,
        tolerance: f64,
        macro_step: f64,
    ) -> Result<ToleranceRun, StudyError> {
        let scene = monolithic.with_tolerance(tolerance, macro_step)?;
        let ending = self.timed(&scene, monolithic.names(), false);
        Ok(ToleranceRun { tolerance, ending })
    }

    /// Runs several times; only the time differs from run to run.
    fn timed(&self, scene: &Scene, names: &[Option<String>], are_means: bool) -> Ending {
        let mut shortest: Option<Ending> = None;
        let mut spent = 0.0;
        for _ in 0..self.repetitions() {
            let mut errors = RunErrors::new(self.reference, self.columns, are_means);
            let statistics = match watched(scene, names, |t, values| errors.add(t, values)) {
                Ok(Ok(statistics)) => statistics,
                Ok(Err(reason)) => return Ending::Stopped(reason),
                Err(RunError::Scene(refusal)) => return Ending::Refused(refusal.to_string()),
                Err(RunError::Interrupted { .. }) => return Ending::Missing,
                Err(error) => return Ending::Stopped(error.to_string()),
            };
            let time = statistics.time_total;
            spent += time;
            let known = shortest.as_ref().and_then(Ending::wall_time);
            if known.is_none_or(|known| time < known) {
                shortest = Some(Ending::Done {
                    errors: errors.errors(),
                    statistics: Box::new(statistics),
                });
            }
            if spent > LONG {
                break;
            }
        }
        shortest.unwrap_or_else(|| Ending::Stopped("no run".to_owned()))
    }

    fn repetitions(&self) -> usize {
        match self.depth {
            Depth::Full => REPETITIONS,
            Depth::Quick => 1,
        }
    }
}
