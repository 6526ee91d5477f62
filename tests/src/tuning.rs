//! Spring and damper of a coupling, tuned with the solution known: the best that such a coupling can reach.

/// The best spring and damper found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuned {
    /// Decimal logarithms of stiffness and damping.
    pub exponents: [f64; 2],
    /// The error with them.
    pub error: f64,
}

impl Tuned {
    /// Stiffness and damping.
    pub fn values(&self) -> [f64; 2] {
        self.exponents.map(|exponent| 10f64.powf(exponent))
    }

    fn better(self, other: Self) -> Self {
        if other.error < self.error {
            other
        } else {
            self
        }
    }
}

/// Looks for the smallest `error([stiffness, damping])`: a grid of half decades, three to each side of `around` (decimal
/// logarithms), then ever finer ones around the best point.
pub fn tune(around: [f64; 2], error: impl Fn([f64; 2]) -> f64) -> Tuned {
    let best_around = |[stiffness, damping]: [f64; 2], steps: i32, step: f64| {
        let offsets = move || (-steps..=steps).map(move |offset| f64::from(offset) * step);
        let grid = offsets().flat_map(|k| offsets().map(move |d| [stiffness + k, damping + d]));
        let tuned = grid.map(|exponents| Tuned {
            exponents,
            error: error(exponents.map(|exponent| 10f64.powf(exponent))),
        });
        tuned.reduce(Tuned::better).unwrap()
    };
    let coarse = best_around(around, 6, 0.5);
    [0.2, 0.07, 0.025].into_iter().fold(coarse, |best, step| {
        best_around(best.exponents, 2, step).better(best)
    })
}
