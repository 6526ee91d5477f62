//! Quantities over another quantity than the time: paths, phase portraits.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::axis::Axis;
use super::canvas::{Drawn, Surface};
use super::curve::{self, Spread};
use super::panel::{Axes, Panel, inner_height, inner_width, room_left};
use super::scale::{Scale, padded};
use super::style::units;
use super::thinning::Run;

/// A panel with axes of its own.
#[derive(Clone, Debug)]
pub struct Portrait {
    /// Label of the x axis, with its unit.
    pub x_label: String,
    /// Label of the y axis, with its unit.
    pub y_label: String,
    /// Curves; equal names in several panels have equal colours.
    pub paths: Vec<Path>,
}

/// A curve that goes in any direction.
#[derive(Clone, Debug)]
pub struct Path {
    /// Name in the legend.
    pub name: String,
    /// Points in their order.
    pub points: Vec<(f64, f64)>,
}

/// Height in pixels, with the labels.
pub(super) const HEIGHT: f64 = 460.0;

/// Most of them side by side, as a tiling has them.
pub(super) const IN_A_ROW: usize = 2;

const MARGIN: f64 = 0.04;

/// Most points of all paths of a panel in the file, more only where there are very many paths.
const MOST_POINTS: usize = 20_000;

/// Pixels between points that are kept, and the most for a path with very many points.
const GAP: f64 = 0.5;
const WIDEST_GAP: f64 = 8.0;

impl Portrait {
    pub(super) fn names(&self) -> Vec<&str> {
        self.paths.iter().map(|path| path.name.as_str()).collect()
    }

    /// Whether a point of it can be drawn.
    pub(super) fn is_drawable(&self) -> bool {
        self.drawable().next().is_some()
    }

    fn drawable(&self) -> impl Iterator<Item = (f64, f64)> {
        let points = self.paths.iter().flat_map(|path| &path.points).copied();
        points.filter(|(x, y)| Scale::Linear.holds(*x) && Scale::Linear.holds(*y))
    }

    /// Draws it into an area; `names` are those in the legend of the picture.
    pub(super) fn draw<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
        names: &[&str],
    ) -> Drawn<DB> {
        let axis = |values: Vec<f64>, make: &dyn Fn((f64, f64)) -> Axis| {
            let extent = Scale::Linear.extent(values.into_iter());
            extent.map_or_else(Axis::blank, |extent| {
                make(padded(Scale::Linear.range(extent), MARGIN))
            })
        };
        let height = inner_height(area, "");
        let y = axis(self.drawable().map(|(_, y)| y).collect(), &|range| {
            Axis::vertical(Scale::Linear, range, height)
        });
        let left = room_left(&y);
        let width = inner_width(area, left);
        let x = axis(self.drawable().map(|(x, _)| x).collect(), &|range| {
            Axis::horizontal(Scale::Linear, range, width)
        });
        let axes = Axes {
            title: "",
            x,
            y,
            x_label: Some(&self.x_label),
            y_label: &self.y_label,
            left,
            grid: true,
        };
        let inside = Panel::new(area, axes)?;
        if !self.is_drawable() {
            return inside.note_no_data();
        }
        let most = MOST_POINTS / self.paths.len().max(1);
        self.paths.iter().try_for_each(|path| {
            let runs = path.thinned(&inside, most);
            curve::draw(&inside, runs, (&path.name, names), Spread::AlongCurve)
        })
    }
}

impl Path {
    /// The path as unbroken runs without points that are close to the one before: with the least gap the picture is
    /// that of all points. A path that takes long leaps leaves out whole points.
    fn thinned<DB: Surface>(&self, inside: &Panel<DB>, most: usize) -> Vec<Run> {
        let points = |runs: &[Run]| runs.iter().map(Vec::len).sum::<usize>();
        let mut gap = GAP;
        let mut runs = self.spaced(inside, gap);
        while points(&runs) > most && gap < WIDEST_GAP {
            gap *= 2.0;
            runs = self.spaced(inside, gap);
        }
        let every = points(&runs).div_ceil(most.max(1)).max(1);
        let kept = |run: Run| run.into_iter().step_by(every).collect();
        runs.into_iter().map(kept).collect()
    }

    fn spaced<DB: Surface>(&self, inside: &Panel<DB>, gap: f64) -> Vec<Run> {
        let place = |(x, y): (f64, f64)| {
            let (right, up) = (inside.x.position(x), inside.y.position(y));
            (
                right * f64::from(inside.width),
                up * f64::from(inside.height),
            )
        };
        let gap = gap * f64::from(units(1.0));
        let mut runs = Vec::new();
        let holds = |(x, y): &(f64, f64)| inside.x.holds(*x) && inside.y.holds(*y);
        for points in self.points.split(|point| !holds(point)) {
            let mut run = Run::new();
            let mut before = (f64::INFINITY, f64::INFINITY);
            for (number, &point) in points.iter().enumerate() {
                let here = place(point);
                let is_far = (here.0 - before.0).hypot(here.1 - before.1) >= gap;
                if is_far || number + 1 == points.len() {
                    before = here;
                    run.push(point);
                }
            }
            runs.push(run);
        }
        runs.retain(|run| !run.is_empty());
        runs
    }
}
