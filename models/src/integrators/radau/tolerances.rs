//! What error is allowed.

/// Error that a run may have: `absolute + relative |y_i|` in unknown `i`.
///
/// Too large: the result is wrong by that much. Too small (`relative` near 1e-15): rounding prevents convergence
/// and the integration fails.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Relative part, positive.
    pub relative: f64,
    /// Absolute part in the unit of the unknowns, positive.
    pub absolute: f64,
}

impl Tolerances {
    /// Tolerance of an unknown of this size.
    pub fn at(&self, size: f64) -> f64 {
        self.absolute + self.relative * size.abs()
    }
}
