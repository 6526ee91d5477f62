//! A curve inside its axes: lines, dots where a point stands alone, and the markers that tell curves apart.

use plotters::prelude::*;

use super::canvas::{Drawn, Surface};
use super::legend::{distinct, style_of};
use super::panel::Panel;
use super::scale::Scale;
use super::spread::spread as spread_along_axis;
use super::style::{stroke, units};
use super::thinning::Run;

/// Points that are joined by straight lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name in the legend; equal names in several panels have equal colours, and an empty one is left out.
    pub name: String,
    /// Points in their order. One that cannot be drawn breaks the line.
    pub points: Vec<(f64, f64)>,
}

impl Curve {
    /// The parts without a point that axes of these scales cannot hold.
    pub(super) fn runs(&self, scales: [Scale; 2]) -> impl Iterator<Item = &[(f64, f64)]> {
        let points = self.points.split(move |point| !holds(scales, point));
        points.filter(|run| !run.is_empty())
    }
}

fn holds([x, y]: [Scale; 2], point: &(f64, f64)) -> bool {
    x.holds(point.0) && y.holds(point.1)
}

/// All points of curves that axes of these scales can hold.
pub(super) fn drawable(curves: &[Curve], scales: [Scale; 2]) -> impl Iterator<Item = (f64, f64)> {
    let points = curves.iter().flat_map(|curve| &curve.points).copied();
    points.filter(move |point| holds(scales, point))
}

/// Names of curves.
pub(super) fn names(curves: &[Curve]) -> impl Iterator<Item = &str> {
    curves.iter().map(|curve| curve.name.as_str())
}

/// Width of the lines in pixels.
pub(super) const LINE_WIDTH: f64 = 1.75;

const DOT_RADIUS: f64 = 3.0;
const MARKER_RADIUS: f64 = 5.0;
const MARKERS_PER_CURVE: usize = 9;

/// Names that share a panel with others: their curves have a marker and an entry in the legend. A curve alone in its
/// panel is told by the labels of the axes.
pub(super) fn names_to_tell_apart<'a>(panels: impl Iterator<Item = &'a [Curve]>) -> Vec<&'a str> {
    distinct(panels.filter(|curves| curves.len() > 1).flat_map(names))
}

/// How the markers of a curve are spread.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Spread {
    /// Equally far apart along the x axis, where no curve goes backwards.
    AlongAxis,
    /// Equally many points apart.
    AlongCurve,
}

/// Draws a curve of this name in the style that its place among `names` gives it.
pub(super) fn draw<DB: Surface>(
    inside: &Panel<DB>,
    runs: Vec<Run>,
    (name, names): (&str, &[&str]),
    spread: Spread,
) -> Drawn<DB> {
    let (index, colour, marker) = style_of(name, names);
    let mut places = Vec::new();
    for run in runs {
        let run: Vec<(i32, i32)> = run.into_iter().map(|point| inside.place(point)).collect();
        match run[..] {
            [alone] => {
                let dot = Circle::new(alone, units(DOT_RADIUS), colour.filled());
                inside.area.draw(&dot)?;
            }
            _ => DB::polyline(&inside.area, &run, stroke(colour, LINE_WIDTH))?,
        }
        places.extend(run);
    }
    let Some(index) = index else { return Ok(()) };
    // Moved from curve to curve, so that coinciding ones stay distinguishable.
    let offset = (index as f64 + 0.5) / names.len() as f64;
    let centres = match spread {
        Spread::AlongAxis => {
            spread_along_axis(&places, inside.width, MARKERS_PER_CURVE, offset).collect()
        }
        Spread::AlongCurve => along_curve(&places, offset),
    };
    for centre in centres {
        marker.draw(&inside.area, centre, units(MARKER_RADIUS), colour)?;
    }
    Ok(())
}

fn along_curve(places: &[(i32, i32)], offset: f64) -> Vec<(i32, i32)> {
    let distance = places.len() as f64 / MARKERS_PER_CURVE as f64;
    let mut marked: Vec<usize> = (0..MARKERS_PER_CURVE)
        .map(|count| ((count as f64 + offset) * distance) as usize)
        .collect();
    marked.dedup();
    marked
        .into_iter()
        .filter_map(|place| places.get(place).copied())
        .collect()
}
