//! Observed orders of convergence.

use std::fmt;

use crate::errors::Errors;

/// Errors at several macro steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    runs: Vec<(f64, Errors)>,
}

/// One of the errors.
pub type Of = fn(&Errors) -> f64;

/// Relative errors of positions below this are rounding.
pub const POSITION_ROUNDING: f64 = 2e-14;

/// Relative errors of positions and velocities together below this are rounding: the noise of the multipliers shakes
/// the velocities.
pub const STATE_ROUNDING: f64 = 1e-12;

/// Relative errors of multipliers below this are rounding: they come from positions divided by H^2.
pub const LAMBDA_ROUNDING: f64 = 2e-10;

impl Study {
    /// Runs `errors` for every macro step.
    pub fn new(macro_steps: &[f64], errors: impl Fn(f64) -> Errors) -> Self {
        Self {
            runs: macro_steps.iter().map(|&h| (h, errors(h))).collect(),
        }
    }

    /// Least-squares slope of log(error) over log(H) for the three smallest macro steps with an error above `rounding`.
    ///
    /// # Panics
    /// Fewer than three errors are above it.
    pub fn order(&self, of: Of, rounding: f64) -> f64 {
        let mut points: Vec<(f64, f64)> = self
            .runs
            .iter()
            .filter(|(_, errors)| of(errors) > rounding)
            .map(|(h, errors)| (h.ln(), of(errors).ln()))
            .collect();
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        assert!(
            points.len() >= 3,
            "{} errors are too few for an order\n{self}",
            points.len()
        );
        slope(&points[..3])
    }

    /// Orders of position, state and multiplier.
    pub fn orders(&self) -> [f64; 3] {
        [
            self.order(|errors| errors.x, POSITION_ROUNDING),
            self.order(|errors| errors.state, STATE_ROUNDING),
            self.order(|errors| errors.lambda, LAMBDA_ROUNDING),
        ]
    }
}

/// Least-squares slope of log(error) over log(H).
pub fn slope_of(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let points: Vec<_> = points.map(|(h, error)| (h.ln(), error.ln())).collect();
    slope(&points)
}

/// Order of each of several errors over all macro steps.
pub fn orders_of<const N: usize>(steps: &[f64], errors: &[[f64; N]]) -> [f64; N] {
    std::array::from_fn(|of| {
        let points = steps.iter().zip(errors);
        slope_of(points.map(|(h, errors)| (*h, errors[of])))
    })
}

/// Asserts that no order is lower than `least` by more than 0.15; prints all errors.
pub fn assert_least_orders<const N: usize>(
    case: &str,
    steps: &[f64],
    errors: &[[f64; N]],
    least: [f64; N],
) {
    let orders = orders_of(steps, errors);
    let report = format!("{case}: {orders:.2?}, least {least:?}\n{errors:?}");
    println!("{report}");
    let mut pairs = orders.iter().zip(least);
    assert!(
        pairs.all(|(order, least)| *order > least - 0.15),
        "{report}"
    );
}

/// Asserts the observed orders of the errors of all cases, of which `errors` gives those for a macro step, to 0.15.
pub fn assert_all_orders<const N: usize>(
    cases: &[(&str, [f64; N])],
    steps: &[f64],
    errors: impl Fn(&str, f64) -> [f64; N],
) {
    let mut report = String::new();
    let mut wrong = 0;
    for (case, expected) in cases {
        let of_steps: Vec<[f64; N]> = steps.iter().map(|&h| errors(case, h)).collect();
        let orders = orders_of(steps, &of_steps);
        let differ = |(order, expected): (&f64, &f64)| (order - expected).abs() > 0.15;
        let is_wrong = orders.iter().zip(expected).any(differ);
        let mark = if is_wrong { " <-- not as expected" } else { "" };
        report += &format!("{case}: {orders:.2?}, expected {expected:?}{mark}\n{of_steps:?}\n");
        wrong += usize::from(is_wrong);
    }
    println!("{report}");
    assert!(
        wrong == 0,
        "{wrong} of {} cases have other orders:\n{report}",
        cases.len()
    );
}

fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x_mean, y_mean) = (mean(|point| point.0), mean(|point| point.1));
    let moments = points
        .iter()
        .map(|(x, y)| ((x - x_mean) * (y - y_mean), (x - x_mean).powi(2)));
    let (mixed, square) = moments.fold((0.0, 0.0), |sum, term| (sum.0 + term.0, sum.1 + term.1));
    mixed / square
}

/// Asserts the orders of position, state and multiplier for each of `cases`; prints all errors if one is wrong.
pub fn assert_orders(cases: &[(&str, [f64; 3])], tolerance: f64, study: impl Fn(&str) -> Study) {
    let mut report = String::new();
    let mut wrong = 0;
    for (case, expected) in cases {
        let study = study(case);
        let orders = study.orders();
        let differ = |(order, expected): (&f64, &f64)| (order - expected).abs() > tolerance;
        let is_wrong = orders.iter().zip(expected).any(differ);
        let mark = if is_wrong { " <-- not as expected" } else { "" };
        report += &format!("{case}: {orders:.2?}, expected {expected:?}{mark}\n{study}");
        wrong += usize::from(is_wrong);
    }
    println!("{report}");
    assert!(
        wrong == 0,
        "{wrong} of {} cases have other orders",
        cases.len()
    );
}

impl fmt::Display for Study {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:>10} {:>10} {:>10} {:>10}",
            "H", "x", "state", "lambda"
        )?;
        for (h, errors) in &self.runs {
            let Errors { x, state, lambda } = errors;
            writeln!(f, "{h:>10.3e} {x:>10.3e} {state:>10.3e} {lambda:>10.3e}")?;
        }
        Ok(())
    }
}
