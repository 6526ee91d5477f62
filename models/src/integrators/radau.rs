//! Radau IIA of order 5 with step-size control, for stiff equations and short intervals.
//!
//! Three stages, L-stable, stiffly accurate; error estimate, simplified Newton iteration and predictive control
//! after Hairer & Wanner, Solving Ordinary Differential Equations II (2nd ed. 1996), Sect. IV.8. Made for
//! co-simulation, where it is stopped and started thousands of times:
//!
//! * it starts warm, with the step size that it proposed at the end of the interval before;
//! * the result is a function of the state, that step size and the inputs only, so a restored run gives the same
//!   bits; matrices are kept as long as step size and Jacobian stay the same;
//! * the accepted steps of an interval are recorded, and [`Radau::replay`] repeats them with other inputs: same step
//!   sizes, same matrices, same number of iterations. The result then depends smoothly on the inputs, and
//!   differences of two runs are derivatives (internal numerical differentiation).

mod control;
mod differences;
mod estimate;
mod matrices;
mod newton;
mod record;
mod tableau;
#[cfg(test)]
mod tests;
mod tolerances;

use linchpin_worker::Cancel;
use nalgebra::DMatrix;

use super::{Cause, IntegrationError, Ode, Quadrature, check};
use control::StepControl;
use differences::Differences;
use estimate::{Estimate, weighted_norm};
use matrices::MatrixStore;
use newton::{Attempt, Stages};
use record::{Record, RecordedStep};

pub use tolerances::Tolerances;

/// Accepted internal steps in one interval; more is taken for a failure of the step-size control.
const MOST_STEPS: usize = 100_000;

/// Newton's error over the tolerance. Small, so that what it leaves is no noise in differences of two runs.
const NEWTON_GOAL: f64 = 1e-3;

/// Newton's error in units of the last place of the unknown, if that is larger.
const NEWTON_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The Jacobian is renewed if the last ratio of two Newton corrections was above this.
const SLOW_RATE: f64 = 1e-3;

/// Shortest step over the length of the interval.
const SHORTEST: f64 = 1e-13;

/// Integrator for one system of equations; keeps its memory.
#[derive(Debug)]
pub struct Radau {
    tolerances: Tolerances,
    control: StepControl,
    stages: Stages,
    matrices: MatrixStore,
    record: Record,
    jacobian: DMatrix<f64>,
    differences: Differences,
    derivative: Vec<f64>,
    goal: Vec<f64>,
    estimate: Estimate,
    steps: u64,
}

/// Why a step must be tried again.
enum Rejected {
    Diverged,
    Inaccurate(f64),
}

impl Radau {
    /// For `dimension` unknowns.
    pub fn new(dimension: usize, tolerances: Tolerances) -> Self {
        Self {
            tolerances,
            control: StepControl::new(),
            stages: Stages::new(dimension),
            matrices: MatrixStore::default(),
            record: Record::default(),
            jacobian: DMatrix::zeros(dimension, dimension),
            differences: Differences::new(dimension),
            derivative: vec![0.0; dimension],
            goal: vec![0.0; dimension],
            estimate: Estimate::new(dimension, tolerances),
            steps: 0,
        }
    }

    /// Step size (s) to go on with; 0 before the first step. Together with the state it is all that
    /// [`Radau::integrate`] depends on.
    pub fn proposed_step(&self) -> f64 {
        self.control.proposed()
    }

    /// Goes on with this step size; with 0 the first step is chosen anew.
    pub fn propose_step(&mut self, step: f64) {
        self.control.propose(step);
    }

    /// Accepted steps so far, repeated ones included.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Advances `y` over `length` (s) and records the steps.
    ///
    /// # Errors
    /// [`IntegrationError`] if no step is short enough, the solution is not finite, or it is cancelled; `y` is then what was reached.
    pub fn integrate(
        &mut self,
        ode: &impl Ode,
        length: f64,
        y: &mut [f64],
    ) -> Result<(), IntegrationError> {
        self.integrate_beside(ode, length, y, &mut ())
    }

    /// The same, and `beside` with it: its error is not controlled.
    ///
    /// # Errors
    /// As [`Radau::integrate`].
    pub fn integrate_beside(
        &mut self,
        ode: &impl Ode,
        length: f64,
        y: &mut [f64],
        beside: &mut impl Quadrature,
    ) -> Result<(), IntegrationError> {
        self.record.begin(y);
        self.matrices.clear();
        self.stages.restart();
        self.control.restart();
        let cancel = Cancel::current();
        let mut tau = 0.0;
        let mut jacobian_due = true;
        while tau < length {
            check(&cancel, tau)?;
            if self.record.steps.len() == MOST_STEPS {
                let cause = Cause::TooManySteps { limit: MOST_STEPS };
                return Err(IntegrationError { tau, cause });
            }
            self.prepare(ode, tau, length, y, jacobian_due)
                .map_err(|cause| IntegrationError { tau, cause })?;
            let (step, rate) = self
                .advance(ode, [tau, length], y, beside)
                .map_err(|cause| IntegrationError { tau, cause })?;
            tau = if step < length - tau {
                tau + step
            } else {
                length
            };
            jacobian_due = rate > SLOW_RATE;
        }
        self.record.complete(length);
        Ok(())
    }

    /// Whether the last [`Radau::integrate`] reached its end and was over this length from this `y`.
    pub fn has_recorded(&self, length: f64, y: &[f64]) -> bool {
        self.record.is_of(length, y)
    }

    /// Whether the last [`Radau::integrate`] reached its end and was over this length.
    pub fn has_recorded_over(&self, length: f64) -> bool {
        self.record.is_over(length)
    }

    /// Advances `y` by the steps of the last [`Radau::integrate`], without control. Under the same inputs the result
    /// is the same to the bit.
    ///
    /// # Errors
    /// [`IntegrationError`] if the solution is not finite, or it is cancelled.
    pub fn replay(&mut self, ode: &impl Ode, y: &mut [f64]) -> Result<(), IntegrationError> {
        self.replay_beside(ode, y, &mut ())
    }

    /// The same, and `beside` with it.
    ///
    /// # Errors
    /// As [`Radau::replay`].
    pub fn replay_beside(
        &mut self,
        ode: &impl Ode,
        y: &mut [f64],
        beside: &mut impl Quadrature,
    ) -> Result<(), IntegrationError> {
        self.stages.restart();
        let cancel = Cancel::current();
        for &RecordedStep {
            tau,
            step,
            iterations,
            matrices,
        } in &self.record.steps
        {
            check(&cancel, tau)?;
            let matrices = self.matrices.get(matrices);
            let attempt = Attempt {
                tau,
                step,
                y,
                matrices,
            };
            let repeated = self.stages.repeat(ode, attempt, iterations);
            repeated.map_err(|_| IntegrationError {
                tau,
                cause: Cause::Diverged { step },
            })?;
            self.stages.accept(tau, step, y, beside);
            self.steps += 1;
            if !is_finite(y) {
                return Err(IntegrationError {
                    tau,
                    cause: Cause::NotFinite,
                });
            }
        }
        Ok(())
    }

    /// Derivative, Jacobian, scales and the first step size at a new point.
    fn prepare(
        &mut self,
        ode: &impl Ode,
        tau: f64,
        length: f64,
        y: &[f64],
        jacobian_due: bool,
    ) -> Result<(), Cause> {
        ode.derivative(tau, y, &mut self.derivative);
        if !(is_finite(y) && is_finite(&self.derivative)) {
            return Err(Cause::NotFinite);
        }
        if jacobian_due {
            self.renew_jacobian(ode, tau, y);
        }
        for (goal, y) in self.goal.iter_mut().zip(y) {
            *goal = (NEWTON_GOAL * self.tolerances.at(*y)).max(NEWTON_ROUNDING * y.abs());
        }
        if self.control.proposed() == 0.0 {
            self.control.propose(self.first_step(length, y));
        }
        Ok(())
    }

    /// A hundredth of the time in which the state changes by its own size (Hairer & Wanner I, Sect. II.4).
    fn first_step(&self, length: f64, y: &[f64]) -> f64 {
        let size = weighted_norm(y, &self.goal);
        let speed = weighted_norm(&self.derivative, &self.goal);
        let time = 0.01 * size / speed;
        if time.is_finite() && time > 0.0 {
            time
        } else {
            0.01 * length
        }
    }

    /// One accepted step from `y` at `tau`; returns its size and Newton's last rate.
    fn advance(
        &mut self,
        ode: &impl Ode,
        [tau, length]: [f64; 2],
        y: &mut [f64],
        beside: &mut impl Quadrature,
    ) -> Result<(f64, f64), Cause> {
        let mut careful = self.record.steps.is_empty();
        loop {
            let rest = length - tau;
            let longest = beside.longest_step(length);
            // What is left but for rounding is one step.
            let step = match rest <= longest * (1.0 + SHORTEST) {
                true => self.control.fitting(rest),
                false => self.control.fitting(rest).min(longest),
            };
            let rejected = match self.attempt(ode, tau, step, y, careful) {
                Ok(rate) => {
                    self.stages.accept(tau, step, y, beside);
                    return Ok((step, rate));
                }
                Err(rejected) => rejected,
            };
            let is_shortest = step <= SHORTEST * length;
            match rejected {
                Rejected::Diverged if is_shortest => return Err(Cause::Diverged { step }),
                Rejected::Inaccurate(error) if is_shortest => {
                    return Err(Cause::Inaccurate { step, error });
                }
                Rejected::Diverged => {
                    self.renew_jacobian(ode, tau, y);
                    self.control.halve(step);
                }
                Rejected::Inaccurate(error) => self.control.reject(step, error),
            }
            careful = true;
        }
    }

    /// Tries one step from `y`.
    fn attempt(
        &mut self,
        ode: &impl Ode,
        tau: f64,
        step: f64,
        y: &[f64],
        careful: bool,
    ) -> Result<f64, Rejected> {
        let place = self.matrices.place(step, &self.jacobian);
        let attempt = Attempt {
            tau,
            step,
            y,
            matrices: self.matrices.get(place),
        };
        let converged = self
            .stages
            .solve(ode, attempt, &self.goal)
            .map_err(|_| Rejected::Diverged)?;
        let error =
            self.estimate
                .over_allowed(ode, attempt, &self.derivative, &self.stages.z, careful);
        if !error.is_finite() {
            return Err(Rejected::Diverged);
        }
        if error > 1.0 {
            return Err(Rejected::Inaccurate(error));
        }
        self.control.accept(step, error);
        self.record.steps.push(RecordedStep {
            tau,
            step,
            iterations: converged.iterations,
            matrices: place,
        });
        self.steps += 1;
        Ok(converged.rate)
    }

    fn renew_jacobian(&mut self, ode: &impl Ode, tau: f64, y: &[f64]) {
        if !ode.jacobian(tau, y, &mut self.jacobian) {
            self.differences
                .jacobian(ode, tau, y, &self.derivative, &mut self.jacobian);
        }
    }
}

fn is_finite(values: &[f64]) -> bool {
    values.iter().all(|value| value.is_finite())
}
