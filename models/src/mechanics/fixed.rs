//! Solver `rk4`: fixed steps.

use linchpin_proto::readable::number;
use linchpin_worker::{Interval, StepFailure};

use super::adaptive::at;
use super::equation::{Driven, EquationOfMotion};
use super::integrals::{Integrals, Integrating};
use super::run::Solver;
use crate::integrators::Rk4;

/// More parts than this in one macro step are taken for a mistake in `step`.
const MOST_PARTS: f64 = 1e7;

/// Parts of a macro step, by which its length may miss a multiple of `step`, that are taken for rounding.
const ROUNDING: f64 = 1e-9;

/// Every macro step is cut into equal parts not longer than `step`. Repeated steps are the same to the bit, so
/// perturbed steps need nothing.
#[derive(Debug)]
pub struct Fixed {
    step: f64,
    rk4: Rk4,
    steps: u64,
}

impl Fixed {
    /// For `dimension` states.
    pub fn new(dimension: usize, step: f64) -> Self {
        Self {
            step,
            rk4: Rk4::new(dimension),
            steps: 0,
        }
    }
}

impl<E: EquationOfMotion> Solver<E> for Fixed {
    fn step(
        &mut self,
        ode: &Driven<E>,
        interval: Interval,
        state: &mut E::State,
        integrals: &mut Integrals,
    ) -> Result<(), StepFailure> {
        let parts = parts(interval, self.step)?;
        let mut integrating = Integrating {
            driven: ode,
            length: interval.length,
            integrals,
        };
        let over = (interval.length, parts);
        self.rk4
            .integrate_beside(ode, over, state.as_mut(), &mut integrating)
            .map_err(|error| at(interval, error))?;
        self.steps += parts;
        Ok(())
    }

    fn internal_steps(&self) -> u64 {
        self.steps
    }
}

/// Number of equal parts, not longer than `step`, of a macro step.
///
/// # Errors
/// A recoverable [`StepFailure`] if there are too many.
pub fn parts(interval: Interval, step: f64) -> Result<u64, StepFailure> {
    let parts = (interval.length / step - ROUNDING).ceil().max(1.0);
    if parts > MOST_PARTS {
        return Err(StepFailure::Recoverable {
            t: interval.start,
            message: format!(
                "a macro step of {} s has more than {MOST_PARTS} internal steps of {} s; \
                 raise solver.step or shorten the macro step",
                number(interval.length),
                number(step)
            ),
        });
    }
    Ok(parts as u64)
}
