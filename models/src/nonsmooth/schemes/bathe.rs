//! Bathe's method on velocity level (S2 Sect. 2.6, eqs. 56 to 61; Bathe 2007, Bathe & Noh 2012).
//!
//! Half a step of the trapezoidal rule, then backward differences through three points; the equations of motion and the
//! laws of contact hold at `t_{i+1/2}` and at `t_{i+1}`.
//!
//! ```text
//! v_{i+1/2} = v_i + dt/4 (a_i + a_{i+1/2}),   q_{i+1/2} = q_i + dt/4 (v_i + v_{i+1/2})          (58, 59)
//! v_{i+1} = (q_i - 4 q_{i+1/2} + 3 q_{i+1}) / dt,   a_{i+1} = (v_i - 4 v_{i+1/2} + 3 v_{i+1}) / dt   (60, 61)
//! ```
//!
//! Order 2, unconditionally stable for linear systems, spectral radius 0 for infinite frequency. No parameters.

use super::{Outcome, Scheme};
use crate::nonsmooth::mechanics::{Mechanics, StepError};
use crate::nonsmooth::stages::{Coefficients, Stages};
use crate::nonsmooth::state::{State, Step};

/// Room to work: one stage for each half.
#[derive(Debug, Clone)]
pub struct Bathe {
    middle: Stages,
    end: Stages,
}

impl Bathe {
    /// For a system.
    pub fn new(mechanics: &Mechanics) -> Self {
        Self {
            middle: Stages::new(mechanics, 1),
            end: Stages::new(mechanics, 1),
        }
    }
}

impl Scheme for Bathe {
    fn advance(
        &mut self,
        mechanics: &mut Mechanics,
        step: Step<'_>,
        from: &State,
        to: &mut State,
    ) -> Result<Outcome, StepError> {
        let dt = step.dt;
        let n = from.q.len();

        let middle = &mut self.middle.stages[0];
        middle.tau = step.tau + 0.5 * dt;
        for i in 0..n {
            let (v, a) = (from.v[i], from.a[i]);
            middle.known_q[i] = from.q[i] + 0.25 * dt * v;
            middle.known_a[i] = -a - 4.0 / dt * v;
            middle.v[i] = v + 0.5 * dt * a;
        }
        let coefficients = Coefficients::single(0.25 * dt, 4.0 / dt);
        to.inner_forces.copy_from_slice(&from.inner_forces);
        self.middle
            .solve(mechanics, step, &coefficients, &mut to.inner_forces)?;

        let middle = &self.middle.stages[0];
        let end = &mut self.end.stages[0];
        end.tau = step.tau + dt;
        for i in 0..n {
            end.known_q[i] = (4.0 * middle.q[i] - from.q[i]) / 3.0;
            end.known_a[i] = (from.v[i] - 4.0 * middle.v[i]) / dt;
            end.v[i] = middle.v[i] + 0.5 * dt * middle.a[i];
        }
        let coefficients = Coefficients::single(dt / 3.0, 3.0 / dt);
        to.forces.copy_from_slice(&from.forces);
        self.end
            .solve(mechanics, step, &coefficients, &mut to.forces)?;

        let end = &self.end.stages[0];
        to.q.copy_from_slice(&end.q);
        to.v.copy_from_slice(&end.v);
        to.a.copy_from_slice(&end.a);
        to.auxiliary.copy_from_slice(&end.a);
        Ok(Outcome::Smooth)
    }
}
