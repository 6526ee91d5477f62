//! The half-explicit timestepping scheme of second order (HETS; S2 refs. 40, 41 and Sect. 4.4).
//!
//! ```text
//! M(q_i) (v~ - v_i) = dt [f(t_i, q_i, v_i) + W(q_i) lambda_i],   laws of contact for W(q_i + dt v_i)^T v~
//! q_{i+1} = q_i + dt/2 (v_i + v~)
//! v_{i+1} = v_i + dt/2 [a_i + a_{i+1}],   a_i = (v~ - v_i) / dt
//! M(q_{i+1}) a_{i+1} = f(t_{i+1}, q_{i+1}, v~) + W(q_{i+1}) lambda_{i+1},   laws for W(q_{i+1})^T v_{i+1}
//! ```
//!
//! Order 2. Explicit in all but the contact forces: stable for `omega dt < 2`, no damping.

use super::{Outcome, Scheme};
use crate::nonsmooth::matrix::add_scaled;
use crate::nonsmooth::mechanics::{Mechanics, StepError};
use crate::nonsmooth::state::{State, Step};

/// Room to work.
#[derive(Debug, Clone)]
pub struct Hets {
    force: Vec<f64>,
    predicted: Vec<f64>,
    /// Place of the laws of the first half, `q_i + dt v_i`.
    place: Vec<f64>,
    /// `W^T` there.
    laws: Vec<f64>,
}

impl Hets {
    /// For a system.
    pub fn new(mechanics: &Mechanics) -> Self {
        let row = vec![0.0; mechanics.order()];
        Self {
            force: row.clone(),
            place: row.clone(),
            laws: vec![0.0; mechanics.rows() * mechanics.order()],
            predicted: row,
        }
    }
}

impl Scheme for Hets {
    fn advance(
        &mut self,
        mechanics: &mut Mechanics,
        step: Step<'_>,
        from: &State,
        to: &mut State,
    ) -> Result<Outcome, StepError> {
        let dt = step.dt;
        mechanics.factor_mass(&from.q)?;
        mechanics.force(step.drive, step.tau, [&from.q, &from.v], &mut self.force);
        mechanics.factors.solve(&mut self.force);
        self.predicted.copy_from_slice(&from.v);
        add_scaled(dt, &self.force, &mut self.predicted);
        to.inner_forces.copy_from_slice(&from.inner_forces);
        if step.active.contains(&true) {
            self.place.copy_from_slice(&from.q);
            add_scaled(dt, &from.v, &mut self.place);
            mechanics
                .system
                .directions(&from.q, &mut mechanics.directions);
            mechanics.system.directions(&self.place, &mut self.laws);
        }
        let (predicted, inner) = (&mut self.predicted, &mut to.inner_forces);
        mechanics.hold(step.active, dt, Some(&self.laws), predicted, inner)?;

        to.q.copy_from_slice(&from.q);
        add_scaled(0.5 * dt, &from.v, &mut to.q);
        add_scaled(0.5 * dt, &self.predicted, &mut to.q);

        mechanics.factor_mass(&to.q)?;
        let end = step.tau + dt;
        mechanics.force(step.drive, end, [&to.q, &self.predicted], &mut self.force);
        mechanics.factors.solve(&mut self.force);
        for (i, v) in to.v.iter_mut().enumerate() {
            *v = 0.5 * (from.v[i] + self.predicted[i] + dt * self.force[i]);
        }
        to.a.copy_from_slice(&to.v);
        to.forces.copy_from_slice(&from.forces);
        mechanics.direct(&to.q, step.active);
        mechanics.hold(step.active, 0.5 * dt, None, &mut to.v, &mut to.forces)?;

        // a_{i+1}: what the forces alone gave, and what the contacts added over half a step.
        for (i, a) in to.a.iter_mut().enumerate() {
            *a = self.force[i] + 2.0 / dt * (to.v[i] - *a);
        }
        to.auxiliary.copy_from_slice(&to.a);
        Ok(Outcome::Smooth)
    }
}
