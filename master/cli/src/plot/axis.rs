use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::scale::Scale;
use super::style::{TICK_TEXT, text_width, units};
use super::tick::{Tick, Ticks};

const MOST_TICKS: i32 = 9;

/// Pixels between tick labels side by side.
const LABEL_GAP: f64 = 24.0;

/// Distance between tick labels one above the other, in text heights.
const LINE_SPACING: f64 = 1.55;

/// What an axis shows: a range of the coordinate in which its scale is uniform; none if its panel has no point.
pub(super) type Reach = (Scale, Option<(f64, f64)>);

/// A range on a scale with its ticks. To plotters it is an axis of the coordinate in which the scale is uniform.
#[derive(Clone)]
pub(super) struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
    ticks: Ticks,
}

impl Axis {
    /// An axis of the given length in drawing units, with labels side by side.
    pub(super) fn horizontal((scale, range): Reach, length: i32) -> Self {
        let room = |tick: &Tick| text_width(&tick.label, TICK_TEXT) + units(LABEL_GAP);
        range.map_or_else(Self::blank, |range| {
            Self::with_fitting_ticks(scale, range, length, room)
        })
    }

    /// The same with labels one above the other.
    pub(super) fn vertical((scale, range): Reach, length: i32) -> Self {
        let room = |_: &Tick| units(LINE_SPACING * TICK_TEXT);
        range.map_or_else(Self::blank, |range| {
            Self::with_fitting_ticks(scale, range, length, room)
        })
    }

    /// An axis without ticks, for a panel without any point.
    fn blank() -> Self {
        let ticks = Ticks {
            major: Vec::new(),
            minor: Vec::new(),
        };
        Self {
            scale: Scale::Linear,
            low: 0.0,
            high: 1.0,
            ticks,
        }
    }

    /// The densest ticks whose labels, with this room for each, do not touch.
    fn with_fitting_ticks(
        scale: Scale,
        range: (f64, f64),
        length: i32,
        room: impl Fn(&Tick) -> i32,
    ) -> Self {
        let (low, high) = range;
        let apart = |pair: &[Tick]| {
            let distance = (pair[1].coordinate - pair[0].coordinate) / (high - low);
            distance * f64::from(length) >= f64::from(room(&pair[0]) + room(&pair[1])) / 2.0
        };
        let mut wanted = MOST_TICKS;
        let mut ticks = Ticks::in_range(scale, range, wanted);
        while wanted > 1 && !ticks.major.windows(2).all(apart) {
            wanted -= 1;
            ticks = Ticks::in_range(scale, range, wanted);
        }
        Self {
            scale,
            low,
            high,
            ticks,
        }
    }

    /// Width in drawing units of the widest tick label.
    pub(super) fn label_width(&self) -> i32 {
        self.ticks
            .major
            .iter()
            .map(|tick| text_width(&tick.label, TICK_TEXT))
            .max()
            .unwrap_or(0)
    }

    /// Whether the value has a place on this axis.
    pub(super) fn holds(&self, value: f64) -> bool {
        self.scale.holds(value)
    }

    /// Place of the value as a share of the axis: 0 at the lower, 1 at the upper end.
    pub(super) fn position(&self, value: f64) -> f64 {
        self.share(self.scale.forward(value))
    }

    /// The same for a value of the uniform coordinate.
    pub(super) fn share(&self, coordinate: f64) -> f64 {
        (coordinate - self.low) / (self.high - self.low)
    }

    /// Length of the axis in its uniform coordinate: a difference, or a number of decades.
    pub(super) fn span(&self) -> f64 {
        self.high - self.low
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, coordinate: &f64, limit: (i32, i32)) -> i32 {
        limit.0 + (self.share(*coordinate) * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            self.ticks.minor.clone()
        } else {
            self.ticks
                .major
                .iter()
                .map(|tick| tick.coordinate)
                .collect()
        }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, coordinate: &f64) -> String {
        self.ticks
            .major
            .iter()
            .find(|tick| tick.coordinate == *coordinate)
            .map(|tick| tick.label.clone())
            .unwrap_or_default()
    }
}
