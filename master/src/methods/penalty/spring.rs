//! What stands in place of a condition.

use serde::Serialize;

/// A spring and a damper in place of one condition `g` of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spring {
    /// Load per unit of `g`, greater than 0: N/m, for angles N m.
    pub stiffness: f64,
    /// Load per unit of `g'`, 0 or greater; default 0: N s/m, for angles N m s.
    pub damping: f64,
}
