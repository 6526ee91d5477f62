//! Pictures of numerical results: data in, one SVG and one PNG out.
//!
//! Five charts: [`time_panels`] (quantities over time and, as [`Portrait`]s, over each other), [`convergence`] (log-log curves
//! with reference slopes; a work-precision diagram is the same chart with cost on the abscissa), [`map`] (stability over two
//! parameters), [`curves`] (any curves, as far as their axes reach) and [`region`] (a map with lines and named points).
//! All of them write `STEM.svg` and `STEM.png` from one drawing.
//!
//! What cannot be drawn is a gap in a line, never a failure: NaN, infinity, a magnitude above 1e300, and on a
//! logarithmic axis everything below 1e-300, zero and negative numbers.

mod axis;
mod canvas;
mod clip;
mod colour;
mod convergence;
mod curve;
mod curves;
mod error;
mod grid;
mod legend;
mod map;
mod panel;
mod portrait;
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

pub use convergence::{
    ConvergenceCurve, ConvergencePanel, ConvergencePlot, convergence, convergence_svg,
};
pub use curves::{Curve, CurvePanel, CurvePlot, curves};
pub use error::PlotError;
pub use grid::{MapAxis, MapCell, MapPanel, Verdict};
pub use map::{StabilityMap, map, map_svg};
pub use portrait::{Path, Portrait};
pub use region::{NamedPoint, RegionLine, RegionPlot, region};
pub use scale::Scale;
pub(crate) use style::{PALETTE_SIZE, palette_colour};
pub(crate) use tick::Ticks;
pub use time_marks::TimeMarks;
pub use time_panels::{TimePanel, TimePanels, TimeSeries, time_panels, time_panels_svg};

#[cfg(test)]
mod tests;
