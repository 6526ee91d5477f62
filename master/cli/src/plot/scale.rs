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

    /// Inverse of [`Scale::forward`].
    pub(super) fn backward(self, coordinate: f64) -> f64 {
        match self {
            Self::Linear => coordinate,
            Self::Logarithmic => 10f64.powf(coordinate),
        }
    }

    /// Smallest and largest value that can be drawn, `None` without any.
    pub(super) fn extent(self, values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
        values
            .filter(|value| self.holds(*value))
            .fold(None, |extent, value| match extent {
                None => Some((value, value)),
                Some((least, greatest)) => Some((least.min(value), greatest.max(value))),
            })
    }

    /// The extent, widened to a usable axis range if it is (nearly) a single value.
    pub(super) fn opened(self, (least, greatest): (f64, f64)) -> (f64, f64) {
        match self {
            Self::Logarithmic if greatest / least < 1.0 + ROUNDING => (least / 3.0, greatest * 3.0),
            Self::Linear => {
                let magnitude = least.abs().max(greatest.abs());
                let span = greatest - least;
                if magnitude < SMALLEST {
                    (-1.0, 1.0)
                } else if span <= ROUNDING * magnitude || span < SMALLEST {
                    (least - 0.1 * magnitude, greatest + 0.1 * magnitude)
                } else {
                    (least, greatest)
                }
            }
            Self::Logarithmic => (least, greatest),
        }
    }

    /// The range with a margin at both ends, as a share of its length.
    pub(super) fn padded(self, (lower, upper): (f64, f64), share: f64) -> (f64, f64) {
        let (low, high) = (self.forward(lower), self.forward(upper));
        let margin = share * (high - low);
        (self.backward(low - margin), self.backward(high + margin))
    }
}
