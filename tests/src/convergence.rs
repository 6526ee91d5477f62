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

/// Relative errors of positions and velocities below this are rounding.
pub const STATE_ROUNDING: f64 = 1e-13;

/// Relative errors of multipliers below this are rounding: g'' is solved for them, with position / H^2 in it.
pub const LAMBDA_ROUNDING: f64 = 1e-10;

impl Study {
    /// Runs `errors` for every macro step.
    pub fn new(macro_steps: &[f64], errors: impl Fn(f64) -> Errors) -> Self {
        Self {
            runs: macro_steps.iter().map(|&h| (h, errors(h))).collect(),
        }
    }

    /// Least-squares slope of log(error) over log(H), without errors below `rounding`.
    ///
    /// # Panics
    /// Fewer than three errors are left.
    pub fn order(&self, of: Of, rounding: f64) -> f64 {
        let points: Vec<(f64, f64)> = self
            .runs
            .iter()
            .map(|(h, errors)| (h.ln(), of(errors)))
            .filter(|(_, error)| *error > rounding)
            .map(|(h, error)| (h, error.ln()))
            .collect();
        assert!(
            points.len() >= 3,
            "{} errors are too few for an order\n{self}",
            points.len()
        );
        slope(&points)
    }

    /// Orders of position, state and multiplier.
    pub fn orders(&self) -> [f64; 3] {
        [
            self.order(|errors| errors.x, STATE_ROUNDING),
            self.order(|errors| errors.state, STATE_ROUNDING),
            self.order(|errors| errors.lambda, LAMBDA_ROUNDING),
        ]
    }
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
