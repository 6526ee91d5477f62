//! Solver `radau5`: implicit, with step-size control.

use linchpin_worker::{Inputs, Interval, StepFailure};

use super::equation::{Driven, Equation};
use super::run::{Solver, State};
use crate::integrators::IntegrationError;
use crate::integrators::radau::{Radau, Tolerances};

/// Radau IIA of order 5. Its memory is the step size that it proposes to go on with.
#[derive(Debug)]
pub struct Adaptive {
    radau: Radau,
    tolerances: Tolerances,
}

impl Adaptive {
    pub fn new(tolerances: Tolerances) -> Self {
        Self {
            radau: Radau::new(2, tolerances),
            tolerances,
        }
    }
}

impl Solver for Adaptive {
    fn step(
        &mut self,
        equation: &Equation,
        interval: Interval,
        inputs: &Inputs,
        state: &mut State,
    ) -> Result<(), StepFailure> {
        let ode = Driven { equation, inputs };
        self.radau
            .integrate(&ode, interval.length, state)
            .map_err(|error| at(interval, error))
    }

    fn perturbed_step(
        &mut self,
        equation: &Equation,
        interval: Interval,
        inputs: &Inputs,
        state: &mut State,
    ) -> Result<(), StepFailure> {
        let ode = Driven { equation, inputs };
        if self.radau.has_recorded(interval.length, state) {
            self.radau
                .replay(&ode, state)
                .map_err(|error| at(interval, error))
        } else {
            self.step(equation, interval, inputs, state)
        }
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

    fn tolerance(&self, state: &State) -> Option<f64> {
        let largest = state
            .iter()
            .fold(0.0, |largest: f64, value| largest.max(value.abs()));
        Some(self.tolerances.at(largest))
    }
}

fn at(interval: Interval, error: IntegrationError) -> StepFailure {
    StepFailure::Recoverable {
        t: interval.start + error.tau,
        message: error.to_string(),
    }
}
