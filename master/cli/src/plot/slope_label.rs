use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Drawn, Surface};
use super::panel::Panel;
use super::style::{REFERENCE_TEXT, TICK_TEXT, text, text_width, units};

/// Distance in pixels between the points that stand for a line when a label looks for free room.
const SAMPLING: f64 = 8.0;

/// Places tried for a label along its line.
const CANDIDATES: u32 = 37;

/// Pixels between a line and its label.
const GAP: f64 = 2.0;

/// A straight line between two places of the panel.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub from: (i32, i32),
    pub to: (i32, i32),
}

impl Line {
    fn at(&self, share: f64) -> (i32, i32) {
        let between = |from: i32, to: i32| from + (share * f64::from(to - from)).round() as i32;
        (
            between(self.from.0, self.to.0),
            between(self.from.1, self.to.1),
        )
    }

    pub(super) fn sampled(&self) -> impl Iterator<Item = (i32, i32)> {
        let length = f64::from(self.to.0 - self.from.0).hypot(f64::from(self.to.1 - self.from.1));
        let count = (length / f64::from(units(SAMPLING))).ceil().max(1.0) as u32;
        (0..=count).map(move |step| self.at(f64::from(step) / f64::from(count)))
    }
}

/// The name of a reference line.
pub(super) struct Label {
    text: String,
    half_width: i32,
    half_height: i32,
}

impl Label {
    pub(super) fn new(text: String) -> Self {
        let half_width = text_width(&text, TICK_TEXT) / 2 + units(4.0);
        Self {
            text,
            half_width,
            half_height: units(0.65 * TICK_TEXT),
        }
    }

    pub(super) fn draw<DB: Surface>(&self, panel: &Panel<DB>, centre: (i32, i32)) -> Drawn<DB> {
        let style = text(TICK_TEXT, REFERENCE_TEXT, HPos::Center, VPos::Center);
        panel.area.draw_text(&self.text, &style, centre)
    }

    pub(super) fn corners(&self, (x, y): (i32, i32)) -> [(i32, i32); 5] {
        let (w, h) = (self.half_width, self.half_height);
        [
            (x - w, y - h),
            (x + w, y - h),
            (x, y),
            (x - w, y + h),
            (x + w, y + h),
        ]
    }

    /// The place beside the line, inside the panel, that is farthest from everything taken.
    pub(super) fn freest_place<DB: Surface>(
        &self,
        panel: &Panel<DB>,
        line: &Line,
        taken: &[(i32, i32)],
    ) -> Option<(i32, i32)> {
        let (w, h) = (self.half_width, self.half_height);
        let inside = |(x, y): (i32, i32)| {
            let across = x.clamp(w, (panel.width - w).max(w));
            let down = y.clamp(h, (panel.height - h).max(h));
            (across, down)
        };
        let beside = |step: u32| {
            let (x, y) = line.at(f64::from(step) / f64::from(CANDIDATES));
            let (dx, dy) = self.clear_of(line);
            [inside((x + dx, y + dy)), inside((x - dx, y - dy))]
        };
        let places = (0..=CANDIDATES).flat_map(beside);
        let freedom = |place: &(i32, i32)| self.clearance(*place, taken);
        places.max_by(|one, other| freedom(one).total_cmp(&freedom(other)))
    }

    /// Shift from a point of the line, square to the line, after which the label just does not touch it.
    fn clear_of(&self, line: &Line) -> (i32, i32) {
        let (x, y) = (
            f64::from(line.to.0 - line.from.0),
            f64::from(line.to.1 - line.from.1),
        );
        let length = x.hypot(y).max(1.0);
        let normal = (-y / length, x / length);
        let reach = f64::from(self.half_width) * normal.0.abs()
            + f64::from(self.half_height) * normal.1.abs()
            + f64::from(units(GAP));
        (
            (reach * normal.0).round() as i32,
            (reach * normal.1).round() as i32,
        )
    }

    /// Distance to the nearest taken place in half sizes of the label: below 1 they overlap, beyond 2 it is far enough.
    fn clearance(&self, centre: (i32, i32), taken: &[(i32, i32)]) -> f64 {
        let distance = |&(x, y): &(i32, i32)| {
            let across = f64::from(x - centre.0).abs() / f64::from(self.half_width);
            let down = f64::from(y - centre.1).abs() / f64::from(self.half_height);
            across.max(down)
        };
        taken.iter().map(distance).fold(2.0, f64::min)
    }
}
