//! Quantities over another quantity than the time: paths, phase portraits.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::canvas::{Drawn, Surface};
use super::curve::{self, Curve, Spread, drawable};
use super::panel::{Labels, Panel};
use super::scale::Scale;
use super::style::units;
use super::thinning::Run;

/// A panel with axes of its own.
#[derive(Clone, Debug)]
pub struct Portrait {
    /// Label of the x axis, with its unit.
    pub x_label: String,
    /// Label of the y axis, with its unit.
    pub y_label: String,
    /// Curves that go in any direction.
    pub paths: Vec<Curve>,
}

/// Height in pixels, with the labels.
pub(super) const HEIGHT: f64 = 460.0;

/// Most of them side by side, as a tiling has them.
pub(super) const IN_A_ROW: usize = 2;

const MARGIN: f64 = 0.04;

const LINEAR: [Scale; 2] = [Scale::Linear; 2];

/// Most points of all paths of a panel in the file, more only where there are very many paths.
const MOST_POINTS: usize = 20_000;

/// Pixels between points that are kept, and the most for a path with very many points.
const GAP: f64 = 0.5;
const WIDEST_GAP: f64 = 8.0;

impl Portrait {
    /// Whether a point of it can be drawn.
    pub(super) fn is_drawable(&self) -> bool {
        self.drawable().next().is_some()
    }

    fn drawable(&self) -> impl Iterator<Item = (f64, f64)> {
        drawable(&self.paths, LINEAR)
    }

    /// Draws it into an area; `names` are those in the legend of the picture.
    pub(super) fn draw<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
        names: &[&str],
    ) -> Drawn<DB> {
        let labels = Labels {
            title: "",
            x: &self.x_label,
            y: &self.y_label,
        };
        let x = Scale::Linear.reach(self.drawable().map(|(x, _)| x), MARGIN);
        let y = Scale::Linear.reach(self.drawable().map(|(_, y)| y), MARGIN);
        let inside = Panel::filling(area, &labels, [x, y], true)?;
        if !self.is_drawable() {
            return inside.note_no_data();
        }
        let most = MOST_POINTS / self.paths.len().max(1);
        self.paths.iter().try_for_each(|path| {
            let runs = thinned(path, &inside, most);
            curve::draw(&inside, runs, (&path.name, names), Spread::AlongCurve)
        })
    }
}

/// The path as unbroken runs without points that are close to the one before: with the least gap the picture is
/// that of all points. A path that takes long leaps leaves out whole points.
fn thinned<DB: Surface>(path: &Curve, inside: &Panel<DB>, most: usize) -> Vec<Run> {
    let points = |runs: &[Run]| runs.iter().map(Vec::len).sum::<usize>();
    let mut gap = GAP;
    let mut runs = spaced(path, inside, gap);
    while points(&runs) > most && gap < WIDEST_GAP {
        gap *= 2.0;
        runs = spaced(path, inside, gap);
    }
    let every = points(&runs).div_ceil(most.max(1)).max(1);
    let kept = |run: Run| run.into_iter().step_by(every).collect();
    runs.into_iter().map(kept).collect()
}

fn spaced<DB: Surface>(path: &Curve, inside: &Panel<DB>, gap: f64) -> Vec<Run> {
    let place = |(x, y): (f64, f64)| {
        let (right, up) = (inside.x.position(x), inside.y.position(y));
        (
            right * f64::from(inside.width),
            up * f64::from(inside.height),
        )
    };
    let gap = gap * f64::from(units(1.0));
    let mut runs = Vec::new();
    for points in path.runs(LINEAR) {
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
    runs
}
