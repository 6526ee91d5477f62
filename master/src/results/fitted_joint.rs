//! Joints whose geometry a run has fitted to the start.

use serde::{Deserialize, Serialize};

/// A joint that was open at the start by more than rounding and less than `coupling.start_tolerance`, and how its geometry at marker b was changed so
/// that it is closed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FittedJoint {
    /// Its name.
    pub joint: String,
    /// By how much its point at b was shifted, m.
    pub shift: f64,
    /// By how much its axis at b, or the attitude that it keeps, was turned, rad.
    pub turn: f64,
}
