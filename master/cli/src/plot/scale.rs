use super::axis::Reach;

/// How an axis turns values into lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences are equal lengths.
    Linear,
    /// Equal ratios are equal lengths; only positive values can be drawn.
    Logarithmic,
}

/// Beyond these magnitudes, spans and tick steps would overflow or lose their digits.
const LARGEST: f64 = 1e300;
const SMALLEST: f64 = 1e-300;

/// Values that differ by less than this part of their size are drawn as a constant: it is rounding.
const ROUNDING: f64 = 1e-12;

impl Scale {
    /// Whether the value has a place on an axis of this scale.
    pub(super) fn holds(self, value: f64) -> bool {
        match self {
            Self::Linear => value.is_finite() && value.abs() <= LARGEST,
            Self::Logarithmic => (SMALLEST..=LARGEST).contains(&value),
        }
    }

    /// Coordinate in which this scale is uniform.
    pub(super) fn forward(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Logarithmic => value.log10(),
        }
    }

    /// Smallest and largest value that can be drawn, `None` without any.
    pub(super) fn extent(self, values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
        extent(values.filter(|value| self.holds(*value)))
    }

    /// What an axis of this scale shows of these values, with a margin at both ends as a share of its length.
    pub(super) fn reach(self, values: impl Iterator<Item = f64>, margin: f64) -> Reach {
        let extent = self.extent(values);
        let range = extent.map(|extent| padded(self.range(extent), margin));
        (self, range)
    }

    /// Range of the uniform coordinate that shows an extent of values, widened if that is (nearly) a single value.
    pub(super) fn range(self, (least, greatest): (f64, f64)) -> (f64, f64) {
        let (low, high) = (self.forward(least), self.forward(greatest));
        let magnitude = least.abs().max(greatest.abs());
        let widening = match self {
            Self::Logarithmic if high - low < ROUNDING => 0.5,
            Self::Linear if magnitude < SMALLEST => 1.0,
            Self::Linear if high - low <= (ROUNDING * magnitude).max(SMALLEST) => 0.1 * magnitude,
            _ => 0.0,
        };
        (low - widening, high + widening)
    }
}

/// Smallest and largest value, `None` without any.
pub(super) fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |extent, value| match extent {
        None => Some((value, value)),
        Some((least, greatest)) => Some((f64::min(least, value), f64::max(greatest, value))),
    })
}

/// The range with a margin at both ends, as a share of its length.
fn padded((low, high): (f64, f64), share: f64) -> (f64, f64) {
    let margin = share * (high - low);
    (low - margin, high + margin)
}
