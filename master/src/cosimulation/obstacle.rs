//! What may stand against a macro step that no worker has taken yet.

use crate::coupling::error_estimate::Estimate;
use crate::error::RunError;

/// Why an attempt at a macro step came to nothing. Workers stand where they stood before it.
#[derive(Debug)]
pub(super) struct Obstacle {
    pub kind: Kind,
    /// What the run stops with where no step can be shorter.
    pub error: Box<RunError>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// The error is larger than allowed.
    Error {
        found: Estimate,
        /// The error that the step would have had with the degrees of its repetition.
        next: Estimate,
    },
    /// The corrections have not come to an end within their number, and the scene rejects such a step. With this share of the step they
    /// would just have, if the rate of convergence tells.
    NotConverged(Option<f64>),
    /// A worker has refused the look-ahead, or the coupling has no solution.
    Failed,
}

impl From<RunError> for Obstacle {
    fn from(error: RunError) -> Self {
        Self {
            kind: Kind::Failed,
            error: Box::new(error),
        }
    }
}

impl From<Obstacle> for RunError {
    fn from(obstacle: Obstacle) -> Self {
        *obstacle.error
    }
}

impl RunError {
    /// The error of a failure of the shortest step.
    pub(super) fn of_least_step(mut self) -> Self {
        match &mut self {
            Self::NotConverged { remedy, .. } => {
                *remedy = "a smaller coupling.least_step, which H has come down to";
                self
            }
            Self::LeastStep { .. } => self,
            _ => Self::NoShorterStep(Box::new(self)),
        }
    }
}
