//! Conditions that a mechanism has more often than once.

use serde::{Deserialize, Serialize};

/// Conditions of the joints that follow from others at the start: how the joints share their loads is not determined, and multipliers of least
/// norm are taken.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Redundancy {
    /// Number of conditions that follow from others.
    pub conditions: usize,
    /// The joints that have part in that, in alphabetic order.
    pub joints: Vec<String>,
}
