//! What a scene says of variable macro steps.

use serde::Serialize;

/// What a run with variable macro steps keeps to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StepControl {
    /// Error of positions relative to their size.
    pub tolerance: f64,
    /// Error in m or rad that is allowed whatever the size; absent: 1e-3 of the tolerance, for lengths times the size of the mechanism.
    pub absolute_tolerance: Option<f64>,
    /// Shortest macro step in s; default 1e-9 of the simulated time.
    pub least_step: f64,
    /// Longest macro step in s; default a tenth of the simulated time.
    pub greatest_step: f64,
}
