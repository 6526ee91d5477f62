//! Degrees of the polynomials over one macro step.

use serde::{Deserialize, Serialize};

/// Degrees of the interpolation over a step, as far as they follow the estimates.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct StepDegrees {
    /// Of the multipliers.
    pub multipliers: Option<usize>,
    /// Of the exchanged variables.
    pub exchanged: Option<usize>,
}
