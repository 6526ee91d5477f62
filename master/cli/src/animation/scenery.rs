//! What does not move: grid lines, lanes, scales in m.

use nalgebra::Vector3;
use serde::Serialize;

use super::stage::Stage;
use crate::plot::{Scale, Ticks};

/// Lines and numbers in inertial axes.
#[derive(Debug, Default, PartialEq, Serialize)]
pub(super) struct Scenery {
    /// Straight lines.
    pub lines: Vec<Line>,
    /// Numbers and names.
    pub labels: Vec<Label>,
}

/// A straight line between two points (m).
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct Line {
    /// Class in the style sheet.
    #[serde(skip)]
    pub class: &'static str,
    /// Its ends.
    pub ends: [[f64; 3]; 2],
}

/// A text at a point.
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct Label {
    /// What it says.
    #[serde(skip)]
    pub text: String,
    /// Where it is (m).
    pub at: [f64; 3],
    /// Pixels to the right and downwards from there.
    pub offset: (f64, f64),
    /// Which part of the text is there, as SVG has it.
    #[serde(skip)]
    pub anchor: &'static str,
}

const GRID: &str = "grid";
const AXIS: &str = "axis";

/// Numbers on the longest side.
const NUMBERS: f64 = 8.0;

/// From the grid to its numbers and from there to the name of the axis, in pixels.
const BELOW: (f64, f64) = (18.0, 36.0);
const LEFT: (f64, f64) = (-8.0, -44.0);
const RAISED: (f64, f64) = (5.0, -14.0);

/// In space, numbers stand this far outside the box, as a share of its size.
const OUTSIDE: f64 = 0.05;

impl Scenery {
    /// The scenery of a stage.
    pub fn of(stage: &Stage) -> Self {
        let mut scenery = Self::default();
        match stage.is_space {
            true => scenery.add_floor(stage),
            false => scenery.add_plane(stage),
        }
        for lane in stage.lanes() {
            let y = lane - 0.5 * stage.block();
            let end = |x: f64| Vector3::new(x, y, 0.0);
            scenery.line(AXIS, end(stage.low.x), end(stage.high.x));
        }
        scenery
    }

    fn add_plane(&mut self, stage: &Stage) {
        let (low, high) = (stage.low, stage.high);
        let at = |x: f64, y: f64| Vector3::new(x, y, 0.0);
        for (x, number) in ticks(low.x, high.x, stage) {
            self.line(class(x), at(x, low.y), at(x, high.y));
            self.label(&number, at(x, low.y), (0.0, BELOW.0), "middle");
        }
        let middle = 0.5 * (low + high);
        self.label("x in m", at(middle.x, low.y), (0.0, BELOW.1), "middle");
        if stage.has_heights {
            for (y, number) in ticks(low.y, high.y, stage) {
                self.line(class(y), at(low.x, y), at(high.x, y));
                self.label(&number, at(low.x, y), (LEFT.0, RAISED.0), "end");
            }
            self.label("y in m", at(low.x, high.y), (LEFT.0, RAISED.1), "end");
        }
    }

    /// A grid at the lowest z and a scale in z at the corner of the lowest x and y.
    fn add_floor(&mut self, stage: &Stage) {
        let (low, high) = (stage.low, stage.high);
        let at = |x: f64, y: f64| Vector3::new(x, y, low.z);
        let out = OUTSIDE * stage.size;
        for (x, number) in ticks(low.x, high.x, stage) {
            self.line(GRID, at(x, low.y), at(x, high.y));
            self.label(&number, at(x, low.y - out), (0.0, RAISED.0), "middle");
        }
        for (y, number) in ticks(low.y, high.y, stage) {
            self.line(GRID, at(low.x, y), at(high.x, y));
            self.label(&number, at(high.x + out, y), (0.0, RAISED.0), "middle");
        }
        for (z, number) in ticks(low.z, high.z, stage) {
            let on = Vector3::new(low.x, low.y, z);
            let tick = Vector3::new(0.2 * out, 0.2 * out, 0.0);
            self.line(AXIS, on - tick, on + tick);
            let beside = Vector3::new(low.x - 0.7 * out, low.y - 0.7 * out, z);
            self.label(&number, beside, (0.0, RAISED.0), "middle");
        }
        let corners = [
            at(low.x, low.y),
            at(high.x, low.y),
            at(high.x, high.y),
            at(low.x, high.y),
        ];
        for (corner, next) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            self.line(AXIS, *corner, *next);
        }
        let top = Vector3::new(low.x, low.y, high.z);
        self.line(AXIS, corners[0], top);
        let middle = 0.5 * (low + high);
        let beyond = 4.0 * out;
        let mut name = |text, at| self.label(text, at, (0.0, RAISED.0), "middle");
        name("x in m", at(middle.x, low.y - beyond));
        name("y in m", at(high.x + beyond, middle.y));
        name("z in m", top + Vector3::new(0.0, 0.0, out));
    }

    fn line(&mut self, class: &'static str, from: Vector3<f64>, to: Vector3<f64>) {
        self.lines.push(Line {
            class,
            ends: [from.into(), to.into()],
        });
    }

    fn label(&mut self, text: &str, at: Vector3<f64>, offset: (f64, f64), anchor: &'static str) {
        self.labels.push(Label {
            text: text.to_owned(),
            at: at.into(),
            offset,
            anchor,
        });
    }
}

/// Round places between `low` and `high` and their numbers, as close on all sides of a stage.
fn ticks(low: f64, high: f64, stage: &Stage) -> impl Iterator<Item = (f64, String)> {
    let longest = (stage.high - stage.low).max();
    let wanted = (NUMBERS * (high - low) / longest).ceil().max(1.0) as i32;
    let ticks = Ticks::in_range(Scale::Linear, (low, high), wanted);
    ticks.major.into_iter().map(|t| (t.coordinate, t.label))
}

/// The lines through 0 are stronger.
fn class(coordinate: f64) -> &'static str {
    if coordinate == 0.0 { AXIS } else { GRID }
}
