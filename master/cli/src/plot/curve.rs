//! A curve inside its axes: lines, dots where a point stands alone, and the markers that tell curves apart.

use plotters::prelude::*;

use super::canvas::{Drawn, Surface};
use super::legend::distinct;
use super::panel::Panel;
use super::spread::spread as spread_along_axis;
use super::style::{curve_style, stroke, units};
use super::thinning::Run;

/// Width of the lines in pixels.
pub(super) const LINE_WIDTH: f64 = 1.75;

const DOT_RADIUS: f64 = 3.0;
const MARKER_RADIUS: f64 = 5.0;
const MARKERS_PER_CURVE: usize = 9;

/// Names that share a panel with others: their curves have a marker and an entry in the legend. A curve alone in its
/// panel is told by the labels of the axes.
pub(super) fn names_to_tell_apart<'a>(panels: impl Iterator<Item = Vec<&'a str>>) -> Vec<&'a str> {
    distinct(panels.filter(|names| names.len() > 1).flatten())
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
    let index = names.iter().position(|other| *other == name);
    let (colour, marker) = curve_style(index.unwrap_or(0));
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
