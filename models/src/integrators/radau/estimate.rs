//! Estimated error of a step (Hairer & Wanner II, Sect. IV.8, eqs. 8.19 and 8.20).

use nalgebra::DVector;

use super::newton::Attempt;
use super::tableau::{ERROR, dot};
use super::tolerances::Tolerances;
use crate::integrators::Ode;

/// The embedded estimate of order 3, filtered by the real iteration matrix, and its memory.
#[derive(Debug)]
pub struct Estimate {
    tolerances: Tolerances,
    factor: f64,
    scales: Vec<f64>,
    shifted: Vec<f64>,
    derivative: Vec<f64>,
    error: DVector<f64>,
}

impl Estimate {
    pub fn new(dimension: usize, tolerances: Tolerances) -> Self {
        Self {
            tolerances,
            factor: allowed_over_tolerance(tolerances),
            scales: vec![0.0; dimension],
            shifted: vec![0.0; dimension],
            derivative: vec![0.0; dimension],
            error: DVector::zeros(dimension),
        }
    }

    /// Estimated error over what is allowed, for a step with the stages `z` that starts with `derivative`.
    ///
    /// A `careful` estimate that is too large is filtered a second time: in the first step of a stiff transient the
    /// first one is far too pessimistic.
    pub fn over_allowed(
        &mut self,
        ode: &impl Ode,
        attempt: Attempt,
        derivative: &[f64],
        z: &[Vec<f64>; 3],
        careful: bool,
    ) -> f64 {
        for ((scale, y), z) in self.scales.iter_mut().zip(attempt.y).zip(&z[2]) {
            *scale = self.factor * self.tolerances.at(y.abs().max((y + z).abs()));
        }
        let first = filtered(&mut self.error, attempt, derivative, z, &self.scales);
        if first <= 1.0 || !careful {
            return first;
        }
        for ((shifted, y), error) in self
            .shifted
            .iter_mut()
            .zip(attempt.y)
            .zip(self.error.iter())
        {
            *shifted = y + error;
        }
        ode.derivative(attempt.tau, &self.shifted, &mut self.derivative);
        filtered(&mut self.error, attempt, &self.derivative, z, &self.scales)
    }
}

/// Allowed estimate over tolerance.
///
/// The estimate is of order h^4, the global error of order h^5. An estimate of `0.1 tol^(4/5)` therefore keeps the
/// error of a run proportional to the tolerance. The plain comparison is too strict by a factor `tol^(-1/4)`;
/// Hairer's `0.1 tol^(2/3)` (RADAU5) keeps the error *per step* proportional, which grows with the number of steps.
fn allowed_over_tolerance(tolerances: Tolerances) -> f64 {
    0.1 * tolerances.relative.max(tolerances.absolute).powf(-0.2)
}

fn filtered(
    error: &mut DVector<f64>,
    attempt: Attempt,
    derivative: &[f64],
    z: &[Vec<f64>; 3],
    scales: &[f64],
) -> f64 {
    for (k, error) in error.iter_mut().enumerate() {
        *error = derivative[k] + dot(&ERROR, [z[0][k], z[1][k], z[2][k]]) / attempt.step;
    }
    if !attempt.matrices.solve_real(error) {
        return f64::INFINITY;
    }
    weighted_norm(error.as_slice(), scales)
}

/// Root mean square of `values[i] / scales[i]`.
pub fn weighted_norm(values: &[f64], scales: &[f64]) -> f64 {
    let sum: f64 = values
        .iter()
        .zip(scales)
        .map(|(value, scale)| (value / scale).powi(2))
        .sum();
    (sum / values.len() as f64).sqrt()
}
