//! A time series in bounded memory, for pictures.

use super::Thinned;

/// Most points that are kept.
const MOST_POINTS: usize = 1 << 16;

/// Points `(x, y)` of a long run, where `x` is the time or what its panel shows its curves over.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Result column, or the sum of several.
    pub name: String,
    /// Number of its panel in the picture.
    pub panel: usize,
    /// Whether it shows multipliers.
    pub shows_multipliers: bool,
    /// Times in s, or values of the other quantity, and values.
    pub points: Thinned<(f64, f64)>,
}

impl Trace {
    /// An empty series of one or more result columns.
    pub fn new(name: String, panel: usize, shows_multipliers: bool) -> Self {
        Self {
            name,
            panel,
            shows_multipliers,
            points: Thinned::at_most(MOST_POINTS),
        }
    }
}
