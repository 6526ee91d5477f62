//! The coupling method of a run, of either family.

use crate::coupling::corrector::Corrector;
use crate::coupling::uncorrected::Uncorrected;
use crate::results::StepDegrees;

/// The coupling method with its state.
pub(crate) enum Scheme {
    Corrected(Box<dyn Corrector>),
    Uncorrected(Box<dyn Uncorrected>),
}

impl Scheme {
    /// Multipliers at the present macro point.
    pub(crate) fn multipliers(&self) -> &[f64] {
        match self {
            Self::Corrected(method) => method.multipliers(),
            Self::Uncorrected(method) => method.multipliers(),
        }
    }

    /// By what factor the responses of a subsystem to loads differed most from those of inertia, if no macro step resolves that.
    pub(crate) fn unresolved(&self, subsystem: usize) -> Option<f64> {
        match self {
            Self::Corrected(method) => method.resolution().unresolved(subsystem),
            Self::Uncorrected(_) => None,
        }
    }

    /// Degrees of the polynomials over the last macro step, as far as they follow the estimates.
    pub(crate) fn degrees(&self) -> StepDegrees {
        match self {
            Self::Corrected(method) => method.degrees(),
            Self::Uncorrected(_) => StepDegrees::default(),
        }
    }
}
