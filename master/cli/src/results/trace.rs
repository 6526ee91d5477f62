//! A time series in bounded memory, for pictures.

use super::Thinned;

/// Most points that are kept.
const MOST_POINTS: usize = 1 << 16;

/// Points `(x, y)` of a long run: a sum of result columns over another one, such as the time.
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
    /// Places of the columns of `x` and of `y` in a row.
    places: [Vec<usize>; 2],
}

impl Trace {
    /// An empty series; `places` are those of the columns of `x` and of `y` in a row.
    pub fn new(
        name: String,
        panel: usize,
        shows_multipliers: bool,
        places: [Vec<usize>; 2],
    ) -> Self {
        Self {
            name,
            panel,
            shows_multipliers,
            points: Thinned::at_most(MOST_POINTS),
            places,
        }
    }

    /// Takes the values of a row.
    pub fn record(&mut self, values: &[f64]) {
        let sum = |places: &Vec<usize>| places.iter().map(|place| values[*place]).sum();
        let [x, y] = &self.places;
        self.points.push(|| (sum(x), sum(y)));
    }
}
