//! The classical Runge-Kutta method of order 4 (Kutta 1901).

use linchpin_worker::Cancel;

use super::{IntegrationError, Ode, Quadrature, check};

/// Integrator with fixed steps; keeps its memory.
#[derive(Debug, Clone)]
pub struct Rk4 {
    slope: Vec<f64>,
    sum: Vec<f64>,
    stage: Vec<f64>,
}

impl Rk4 {
    /// For `dimension` unknowns.
    pub fn new(dimension: usize) -> Self {
        Self {
            slope: vec![0.0; dimension],
            sum: vec![0.0; dimension],
            stage: vec![0.0; dimension],
        }
    }

    /// Advances `y` over `length` (s) in `parts` equal steps. The result may be infinite or not a number if the
    /// steps are too long for the equation.
    ///
    /// # Errors
    /// [`IntegrationError`] if it is cancelled; `y` is then what was reached.
    pub fn integrate(
        &mut self,
        ode: &impl Ode,
        length: f64,
        parts: u64,
        y: &mut [f64],
    ) -> Result<(), IntegrationError> {
        self.integrate_beside(ode, (length, parts), y, &mut ())
    }

    /// The same, and `beside` with it.
    ///
    /// # Errors
    /// As [`Rk4::integrate`].
    pub fn integrate_beside(
        &mut self,
        ode: &impl Ode,
        (length, parts): (f64, u64),
        y: &mut [f64],
        beside: &mut impl Quadrature,
    ) -> Result<(), IntegrationError> {
        let cancel = Cancel::current();
        let step = length / parts as f64;
        for part in 0..parts {
            let tau = length * (part as f64 / parts as f64);
            check(&cancel, tau)?;
            self.advance(ode, tau, step, y, beside);
        }
        Ok(())
    }

    fn advance(
        &mut self,
        ode: &impl Ode,
        tau: f64,
        step: f64,
        y: &mut [f64],
        beside: &mut impl Quadrature,
    ) {
        self.sum.fill(0.0);
        self.slope.fill(0.0);
        for (node, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            for ((stage, y), slope) in self.stage.iter_mut().zip(y.iter()).zip(&self.slope) {
                *stage = y + node * step * slope;
            }
            beside.add(tau + node * step, &self.stage, step / 6.0 * weight);
            ode.derivative(tau + node * step, &self.stage, &mut self.slope);
            for (sum, slope) in self.sum.iter_mut().zip(&self.slope) {
                *sum += weight * slope;
            }
        }
        for (y, sum) in y.iter_mut().zip(&self.sum) {
            *y += step / 6.0 * sum;
        }
    }
}
