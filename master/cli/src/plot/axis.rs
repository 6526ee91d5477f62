use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::scale::Scale;
use super::style::{TICK_TEXT, text_width, units};
use super::tick::{Tick, Ticks};

/// A range on a scale with its ticks; the coordinate that plotters draws.
#[derive(Clone)]
pub(super) struct Axis {
    scale: Scale,
    lower: f64,
    upper: f64,
    ticks: Ticks,
}

impl Axis {
    /// An axis of the given length in drawing units whose labels stand side by side.
    pub(super) fn horizontal(scale: Scale, range: (f64, f64), length: i32) -> Self {
        Self::with_fitting_ticks(scale, range, |labels| {
            labels
                .iter()
                .map(|tick| text_width(&tick.label, TICK_TEXT) + units(24.0))
                .sum::<i32>()
                <= length
        })
    }

    /// An axis of the given length in drawing units whose labels stand one above the other.
    pub(super) fn vertical(scale: Scale, range: (f64, f64), length: i32) -> Self {
        Self::with_fitting_ticks(scale, range, |labels| {
            labels.len() as i32 * units(1.9 * TICK_TEXT) <= length
        })
    }

    /// An axis without ticks, for a panel without any point.
    pub(super) fn blank() -> Self {
        let ticks = Ticks {
            major: Vec::new(),
            minor: Vec::new(),
        };
        Self {
            scale: Scale::Linear,
            lower: 0.0,
            upper: 1.0,
            ticks,
        }
    }

    fn with_fitting_ticks(scale: Scale, range: (f64, f64), fits: impl Fn(&[Tick]) -> bool) -> Self {
        let mut wanted = 9;
        let mut ticks = Ticks::in_range(scale, range, wanted);
        while wanted > 2 && !fits(&ticks.major) {
            wanted -= 1;
            ticks = Ticks::in_range(scale, range, wanted);
        }
        Self {
            scale,
            lower: range.0,
            upper: range.1,
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
        let (low, high) = (
            self.scale.forward(self.lower),
            self.scale.forward(self.upper),
        );
        (self.scale.forward(value) - low) / (high - low)
    }

    /// Length of the axis in its uniform coordinate: a difference, or a number of decades.
    pub(super) fn span(&self) -> f64 {
        self.scale.forward(self.upper) - self.scale.forward(self.lower)
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        limit.0 + (self.position(*value) * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            self.ticks.minor.clone()
        } else {
            self.ticks.major.iter().map(|tick| tick.value).collect()
        }
    }

    fn range(&self) -> Range<f64> {
        self.lower..self.upper
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        self.ticks
            .major
            .iter()
            .find(|tick| tick.value == *value)
            .map(|tick| tick.label.clone())
            .unwrap_or_default()
    }
}
