//! The stages of one step by simplified Newton iteration (Hairer & Wanner II, Sect. IV.8).

use nalgebra::{Complex, DVector};

use super::matrices::Matrices;
use super::tableau::{ALPHA, B, BETA, C, GAMMA, T, T_INVERSE, collocation_weights, dot};
use crate::integrators::{Ode, Quadrature};

/// Iterations after which a step is given up.
const MOST_ITERATIONS: usize = 10;

/// One attempt: `h = step` from `y` at `tau`.
#[derive(Debug, Clone, Copy)]
pub struct Attempt<'a> {
    pub tau: f64,
    pub step: f64,
    pub y: &'a [f64],
    pub matrices: &'a Matrices,
}

/// How the iteration went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Converged {
    pub iterations: usize,
    /// Last ratio of two corrections; 0 if there was only one.
    pub rate: f64,
}

/// The iteration does not converge in this step: its step must be shorter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Diverged;

/// Stage increments `z_i = y(tau + c_i h) - y(tau)` and what their iteration needs.
#[derive(Debug)]
pub struct Stages {
    pub z: [Vec<f64>; 3],
    w: [Vec<f64>; 3],
    f: [Vec<f64>; 3],
    stage: Vec<f64>,
    real: DVector<f64>,
    complex: DVector<Complex<f64>>,
    accepted: Option<f64>,
    accepted_z: [Vec<f64>; 3],
}

impl Stages {
    pub fn new(dimension: usize) -> Self {
        let row = || vec![0.0; dimension];
        let rows = || [row(), row(), row()];
        Self {
            z: rows(),
            w: rows(),
            f: rows(),
            stage: row(),
            real: DVector::zeros(dimension),
            complex: DVector::zeros(dimension),
            accepted: None,
            accepted_z: rows(),
        }
    }

    /// Forgets the step before: an input may jump.
    pub fn restart(&mut self) {
        self.accepted = None;
    }

    /// Brings `y` to the end of the step from `tau`, and `beside` with it, and keeps its stages; the next step starts from their polynomial.
    pub fn accept(&mut self, tau: f64, step: f64, y: &mut [f64], beside: &mut impl Quadrature) {
        for ((z, c), b) in self.z.iter().zip(C).zip(B) {
            for ((stage, y), z) in self.stage.iter_mut().zip(&*y).zip(z) {
                *stage = y + z;
            }
            beside.add(tau + c * step, &self.stage, b * step);
        }
        for (y, z) in y.iter_mut().zip(&self.z[2]) {
            *y += z;
        }
        self.accepted = Some(step);
        std::mem::swap(&mut self.z, &mut self.accepted_z);
    }

    /// Iterates until the estimated error is below `goal`.
    pub fn solve(
        &mut self,
        ode: &impl Ode,
        attempt: Attempt,
        goal: &[f64],
    ) -> Result<Converged, Diverged> {
        self.start(attempt.step);
        self.iterate(ode, attempt)?;
        let mut last = self.correction(goal);
        if last <= 1.0 {
            return Ok(Converged {
                iterations: 1,
                rate: 0.0,
            });
        }
        for iterations in 2..=MOST_ITERATIONS {
            self.iterate(ode, attempt)?;
            let correction = self.correction(goal);
            let rate = correction / last;
            if rate.is_nan() || rate >= 1.0 {
                return Err(Diverged);
            }
            let left = correction * rate / (1.0 - rate);
            if left <= 1.0 {
                return Ok(Converged { iterations, rate });
            }
            let remaining = (MOST_ITERATIONS - iterations) as i32;
            if left * rate.powi(remaining) > 1.0 {
                return Err(Diverged);
            }
            last = correction;
        }
        Err(Diverged)
    }

    /// Iterates as often as told.
    pub fn repeat(
        &mut self,
        ode: &impl Ode,
        attempt: Attempt,
        iterations: usize,
    ) -> Result<(), Diverged> {
        self.start(attempt.step);
        for _ in 0..iterations {
            self.iterate(ode, attempt)?;
        }
        Ok(())
    }

    /// Start: the collocation polynomial of the step before, continued; zero in the first step.
    fn start(&mut self, step: f64) {
        let Some(before) = self.accepted else {
            self.z
                .iter_mut()
                .chain(&mut self.w)
                .for_each(|row| row.fill(0.0));
            return;
        };
        let weights = C.map(|c| collocation_weights(1.0 + c * step / before));
        for k in 0..self.stage.len() {
            let old = [
                self.accepted_z[0][k],
                self.accepted_z[1][k],
                self.accepted_z[2][k],
            ];
            let z = weights.map(|row| dot(&row, old) - old[2]);
            for i in 0..3 {
                self.z[i][k] = z[i];
                self.w[i][k] = dot(&T_INVERSE[i], z);
            }
        }
    }

    fn iterate(&mut self, ode: &impl Ode, attempt: Attempt) -> Result<(), Diverged> {
        self.derivatives(ode, attempt);
        self.residuals(attempt.step);
        if !(attempt.matrices.solve_real(&mut self.real)
            && attempt.matrices.solve_complex(&mut self.complex))
        {
            return Err(Diverged);
        }
        self.correct();
        Ok(())
    }

    fn derivatives(&mut self, ode: &impl Ode, attempt: Attempt) {
        for ((z, f), c) in self.z.iter().zip(&mut self.f).zip(C) {
            for ((stage, y), z) in self.stage.iter_mut().zip(attempt.y).zip(z) {
                *stage = y + z;
            }
            ode.derivative(attempt.tau + c * attempt.step, &self.stage, f);
        }
    }

    fn residuals(&mut self, step: f64) {
        for k in 0..self.stage.len() {
            let f = [self.f[0][k], self.f[1][k], self.f[2][k]];
            self.real[k] = dot(&T_INVERSE[0], f) - GAMMA / step * self.w[0][k];
            self.complex[k] = Complex::new(dot(&T_INVERSE[1], f), dot(&T_INVERSE[2], f))
                - Complex::new(ALPHA / step, BETA / step)
                    * Complex::new(self.w[1][k], self.w[2][k]);
        }
    }

    fn correct(&mut self) {
        for k in 0..self.stage.len() {
            self.w[0][k] += self.real[k];
            self.w[1][k] += self.complex[k].re;
            self.w[2][k] += self.complex[k].im;
            let w = [self.w[0][k], self.w[1][k], self.w[2][k]];
            for (z, row) in self.z.iter_mut().zip(&T) {
                z[k] = dot(row, w);
            }
        }
    }

    /// Root mean square of the last correction of the stages over `goal`.
    fn correction(&self, goal: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (k, goal) in goal.iter().enumerate() {
            let correction = [self.real[k], self.complex[k].re, self.complex[k].im];
            sum += T
                .iter()
                .map(|row| (dot(row, correction) / goal).powi(2))
                .sum::<f64>();
        }
        (sum / (3 * goal.len()) as f64).sqrt()
    }
}
