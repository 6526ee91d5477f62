//! Singular positions that a mechanism has passed.

use serde::{Deserialize, Serialize};

/// Positions in which the joints do not determine their multipliers, and what was made of them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct SingularPassages {
    /// How often the mechanism has passed one.
    pub count: u64,
    /// The macro point in s that was nearest to the first one.
    pub first: Option<f64>,
    /// Variable macro steps near one that were taken although their error was larger than allowed, since shorter ones were no better.
    pub unsolved_steps: u64,
}
