//! Macro time: the equidistant grid, and the plan of a run. No other place adds macro steps up.

mod grid;
mod plan;

pub(crate) use grid::at_start;
pub use grid::{MacroGrid, MacroStep};
pub use plan::TimePlan;
