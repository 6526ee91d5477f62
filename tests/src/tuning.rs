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

    /// A row of the tables of `docs/evidence/methods.md`.
    pub fn row(&self, macro_step: f64, order: &str, degree: usize) -> String {
        let [stiffness, damping] = self.values();
        let error = self.error;
        format!(
            "| {macro_step:e} | {order} | {degree} | {error:.1e} | {stiffness:.1e} | {damping:.1e} |\n"
        )
    }

    fn better(self, other: Self) -> Self {
        if other.error < self.error {
            other
        } else {
            self
        }
    }
}

/// Head of a table of such rows.
pub const TABLE_HEAD: &str =
    "| H | order | k | error | K, N/m | D, N s/m |\n|---|---|---|---|---|---|\n";

/// Looks for the smallest `error([stiffness, damping])`: a grid of half decades, `steps` of them to each side of `around` (decimal
/// logarithms), then ever finer ones around the best point.
pub fn tune(around: [f64; 2], steps: i32, error: impl Fn([f64; 2]) -> f64) -> Tuned {
    let best_around = |[stiffness, damping]: [f64; 2], steps: i32, step: f64| {
        let offsets = move || (-steps..=steps).map(move |offset| f64::from(offset) * step);
        let grid = offsets().flat_map(|k| offsets().map(move |d| [stiffness + k, damping + d]));
        let tuned = grid.map(|exponents| Tuned {
            exponents,
            error: error(exponents.map(|exponent| 10f64.powf(exponent))),
        });
        tuned.reduce(Tuned::better).unwrap()
    };
    let coarse = best_around(around, steps, 0.5);
    [0.2, 0.07, 0.025].into_iter().fold(coarse, |best, step| {
        best_around(best.exponents, 2, step).better(best)
    })
}

/// A tuned spring of a penalty coupling (Jacobi), and its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TunedSpring {
    /// Macro step (s).
    pub macro_step: f64,
    /// Degree of the multipliers.
    pub degree: usize,
    /// Stiffness (N/m).
    pub stiffness: f64,
    /// Damping (N s/m).
    pub damping: f64,
    /// NRMS that it reaches.
    pub error: f64,
}

impl TunedSpring {
    /// The settings of the coupling, without the macro step and without the key of the method.
    pub fn coupling(&self) -> String {
        let Self {
            degree,
            stiffness,
            damping,
            ..
        } = self;
        format!("penalty degree={degree} stiffness={stiffness:e} damping={damping:e}")
    }
}

const fn tuned(
    macro_step: f64,
    degree: usize,
    stiffness: f64,
    damping: f64,
    error: f64,
) -> TunedSpring {
    TunedSpring {
        macro_step,
        degree,
        stiffness,
        damping,
        error,
    }
}

/// S1's oscillator, t <= 0.5 s; error of the position of the first mass.
pub const OSCILLATOR: [TunedSpring; 4] = [
    tuned(1e-2, 0, 2.455e4, 1.245e2, 9.03e-3),
    tuned(1e-3, 0, 2.455e6, 1.318e3, 9.01e-5),
    tuned(1e-2, 1, 1.549e4, 7.328e1, 1.38e-2),
    tuned(1e-3, 1, 1.230e6, 7.328e2, 1.79e-4),
];

/// S1's double pendulum, t <= 0.4 s; error of the angles.
pub const DOUBLE_PENDULUM: [TunedSpring; 4] = [
    tuned(1e-2, 0, 7.762e3, 4.121e1, 6.77e-4),
    tuned(1e-3, 0, 6.918e5, 3.508e2, 7.55e-6),
    tuned(1e-2, 1, 5.888e3, 2.317e1, 9.08e-4),
    tuned(1e-3, 1, 4.898e5, 2.188e2, 1.06e-5),
];

/// S1's slider-crank, t <= 1.4 s; error of the angles.
pub const SLIDER_CRANK: [TunedSpring; 2] = [
    tuned(1e-2, 0, 1.778e4, 1.109e2, 2.94e-4),
    tuned(1e-2, 1, 1.230e4, 7.328e1, 4.16e-4),
];
