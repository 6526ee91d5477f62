//! Initial velocities that a run has chosen.

use serde::{Deserialize, Serialize};

/// An initial velocity that was chosen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FreeVelocity {
    /// Name of the subsystem.
    pub subsystem: String,
    /// Parameter of its model.
    pub parameter: String,
    /// Its value in the scene, in SI units.
    pub given: f64,
    /// Its value in the run.
    pub found: f64,
}
