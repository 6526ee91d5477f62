//! Solutions of equations of motion to a tolerance far below what they are compared with.

use super::ReferenceError;
use crate::integrators::Ode;
use crate::integrators::radau::{Radau, Tolerances};

/// Relative and absolute error tolerance of a step.
const TOLERANCE: f64 = 1e-12;

/// An equation whose interval begins at `start` (s): the time that it is asked at counts from 0.
struct Since<'a, O> {
    ode: &'a O,
    start: f64,
}

impl<O: Ode> Ode for Since<'_, O> {
    fn derivative(&self, tau: f64, y: &[f64], dy: &mut [f64]) {
        self.ode.derivative(self.start + tau, y, dy);
    }
}

/// The states of `ode` at `times` (s), from `start` at time 0, from which the time of the equation counts.
///
/// # Errors
/// [`ReferenceError`] if the times do not ascend from 0, or the integration fails.
pub fn states(
    ode: &impl Ode,
    start: &[f64],
    times: &[f64],
) -> Result<Vec<Vec<f64>>, ReferenceError> {
    let tolerances = Tolerances {
        relative: TOLERANCE,
        absolute: TOLERANCE,
    };
    let mut radau = Radau::new(start.len(), tolerances);
    let (mut reached, mut state) = (0.0, start.to_vec());
    let mut states = Vec::with_capacity(times.len());
    for (place, &time) in times.iter().enumerate() {
        if !(time.is_finite() && time >= reached) {
            return Err(ReferenceError::Time {
                place,
                time,
                reached,
            });
        }
        let since = Since {
            ode,
            start: reached,
        };
        radau
            .integrate(&since, time - reached, &mut state)
            .map_err(|error| ReferenceError::Integration {
                t: reached + error.tau,
                cause: error.cause,
            })?;
        reached = time;
        states.push(state.clone());
    }
    Ok(states)
}
