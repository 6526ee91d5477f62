//! Macro time: the equidistant grid, and the plan of a run. No other place adds macro steps up.

mod grid;
mod plan;

pub use grid::{MacroGrid, MacroStep};
pub(crate) use grid::{ROUNDING, at_start};
pub use plan::TimePlan;

/// A macro step is at most this many times as long as the one before. More would make the polynomials over unequal steps unstable.
pub const MOST_GROWTH: f64 = 2.0;
