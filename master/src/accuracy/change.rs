//! Sizes of corrections.

use serde::{Deserialize, Serialize};

/// What columns of an earlier step may leave of a correction where steps are fixed. The error that they leave changes from step to step, so it is
/// worse for the motion than an error of the multipliers of the same size that is smooth, and nothing else limits it.
pub const MOST_LEFT: f64 = 1e-4;

/// Size of a change of the coupling variables, the largest over the groups.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// Relative to the corrections of the last macro steps.
    pub of_usual: f64,
    /// Relative to the variables themselves.
    pub of_size: f64,
    /// Of what follows from the change, relative to the error that is allowed of a step, where an error is.
    pub of_allowed: Option<f64>,
    /// First variable of the group whose change is the largest, relative to the variables themselves.
    pub variable: usize,
}
