//! Solver `radau5`: implicit, with step-size control.

use linchpin_worker::{Interval, StepFailure};

use super::equation::{Driven, EquationOfMotion};
use super::integrals::{Integrals, Integrating};
use super::run::Solver;
use crate::integrators::radau::{Radau, Tolerances};
use crate::integrators::{Cause, IntegrationError};

/// Radau IIA of order 5. Its memory is the step size that it proposes to go on with.
#[derive(Debug)]
pub struct Adaptive {
    radau: Radau,
    tolerances: Tolerances,
}

impl Adaptive {
    /// For `dimension` states.
    pub fn new(dimension: usize, tolerances: Tolerances) -> Self {
        Self {
            radau: Radau::new(dimension, tolerances),
            tolerances,
        }
    }

    /// By the internal steps that were recorded.
    fn repeat<E: EquationOfMotion>(
        &mut self,
        driven: &Driven<E>,
        interval: Interval,
        state: &mut E::State,
        integrals: &mut Integrals,
    ) -> Result<(), StepFailure> {
        let mut integrating = Integrating {
            driven,
            length: interval.length,
            integrals,
        };
        self.radau
            .replay_beside(driven, state.as_mut(), &mut integrating)
            .map_err(|error| at(interval, error))
    }
}

impl<E: EquationOfMotion> Solver<E> for Adaptive {
    fn step(
        &mut self,
        ode: &Driven<E>,
        interval: Interval,
        state: &mut E::State,
        integrals: &mut Integrals,
    ) -> Result<(), StepFailure> {
        let mut integrating = Integrating {
            driven: ode,
            length: interval.length,
            integrals,
        };
        self.radau
            .integrate_beside(ode, interval.length, state.as_mut(), &mut integrating)
            .map_err(|error| at(interval, error))
    }

    fn perturbed_step(
        &mut self,
        ode: &Driven<E>,
        interval: Interval,
        state: &mut E::State,
        integrals: &mut Integrals,
    ) -> Result<(), StepFailure> {
        if self.radau.has_recorded_over(interval.length) {
            self.repeat(ode, interval, state, integrals)
        } else {
            self.step(ode, interval, state, integrals)
        }
    }

    /// A response is small against the error tolerance of the motion, so it takes the motion's steps and not its own.
    fn respond(
        &mut self,
        driven: &Driven<E>,
        direction: &Driven<E>,
        interval: Interval,
        state: &E::State,
        response: &mut E::State,
        integrals: &mut Integrals,
    ) -> Result<(), StepFailure> {
        if !self.radau.has_recorded(interval.length, state.as_ref()) {
            let mut end = *state;
            self.step(driven, interval, &mut end, &mut Integrals::default())?;
        }
        self.repeat(direction, interval, response, integrals)
    }

    fn memory(&self) -> f64 {
        self.radau.proposed_step()
    }

    fn recall(&mut self, memory: f64) {
        self.radau.propose_step(memory);
    }

    fn internal_steps(&self) -> u64 {
        self.radau.steps()
    }

    fn tolerance(&self, state: &E::State) -> Option<f64> {
        let largest = state
            .as_ref()
            .iter()
            .fold(0.0, |largest: f64, value| largest.max(value.abs()));
        Some(self.tolerances.at(largest))
    }
}

/// A failure of the integrator at its time in the scene.
pub fn at(interval: Interval, error: IntegrationError) -> StepFailure {
    let t = interval.start + error.tau;
    match error.cause {
        Cause::Cancelled => StepFailure::Cancelled { t },
        _ => StepFailure::Recoverable {
            t,
            message: error.to_string(),
        },
    }
}
