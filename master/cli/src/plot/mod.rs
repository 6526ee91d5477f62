//! Pictures of numerical results: data in, one SVG and one PNG out.
//!
//! Four kinds of [`Chart`]: [`QuantityPanels`] (columns over time, each quantity by itself), [`TimePanels`] (chosen panels over
//! time and, as [`Portrait`]s, over other quantities),
//! [`CurvePlot`] (log-log curves of errors with reference slopes, a work-precision diagram with cost on the abscissa,
//! any other curves as far as their axes reach) and [`StabilityMap`] (stability over two parameters, with lines and
//! named points).
//!
//! What cannot be drawn is a gap in a line, never a failure: NaN, infinity, a magnitude above 1e300, and on a
//! logarithmic axis everything below 1e-300, zero and negative numbers.

mod axis;
mod canvas;
mod clip;
mod colour;
mod curve;
mod curves;
mod error;
mod grid;
mod legend;
mod map;
mod panel;
mod portrait;
mod quantity_panels;
mod region;
mod scale;
mod slope;
mod slope_label;
mod spread;
mod style;
mod thinning;
mod tick;
mod tiling;
mod time_marks;
mod time_panels;

pub use canvas::{Chart, Format};
pub use curve::Curve;
pub use curves::{CurvePanel, CurvePlot, Markers};
pub use error::PlotError;
pub use grid::{MapAxis, MapCell, MapPanel, Verdict};
pub use map::StabilityMap;
pub use portrait::Portrait;
pub use quantity_panels::{Block, MOST_CURVES, QuantityPanels};
pub use region::{NamedPoint, RegionLine};
pub use scale::Scale;
pub(crate) use style::{PALETTE_SIZE, palette_colour};
pub(crate) use tick::Ticks;
pub use time_marks::{MarkKind, TimeMarks};
pub use time_panels::{TimePanel, TimePanels};

#[cfg(test)]
mod tests;
