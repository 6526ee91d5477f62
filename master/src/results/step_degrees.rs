//! Degrees of the polynomials over one macro step.

/// Degrees of the interpolation over a step, as far as they follow the estimates.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct StepDegrees {
    /// Of the multipliers.
    pub multipliers: Option<usize>,
    /// Of the exchanged variables.
    pub exchanged: Option<usize>,
}
