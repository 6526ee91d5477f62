//! Jacobian by differences, where an equation does not give its own.

use nalgebra::DMatrix;

use crate::integrators::Ode;

/// Forward differences with the increment of RADAU5, `sqrt(eps max(1e-5, |y_j|))`.
#[derive(Debug)]
pub struct Differences {
    shifted: Vec<f64>,
    derivative: Vec<f64>,
}

impl Differences {
    pub fn new(dimension: usize) -> Self {
        Self {
            shifted: vec![0.0; dimension],
            derivative: vec![0.0; dimension],
        }
    }

    /// Writes `df/dy` at `y`, where the derivative is `at_y`.
    pub fn jacobian(
        &mut self,
        ode: &impl Ode,
        tau: f64,
        y: &[f64],
        at_y: &[f64],
        jacobian: &mut DMatrix<f64>,
    ) {
        self.shifted.copy_from_slice(y);
        for (j, y_j) in y.iter().enumerate() {
            self.shifted[j] = y_j + (f64::EPSILON * y_j.abs().max(1e-5)).sqrt();
            let increment = self.shifted[j] - y_j;
            ode.derivative(tau, &self.shifted, &mut self.derivative);
            for (i, (shifted, at_y)) in self.derivative.iter().zip(at_y).enumerate() {
                jacobian[(i, j)] = (shifted - at_y) / increment;
            }
            self.shifted[j] = *y_j;
        }
    }
}
