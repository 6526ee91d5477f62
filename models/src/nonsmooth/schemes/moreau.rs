//! Moreau's midpoint rule (Moreau 1999, Jean 1999; S2 Sect. 4.4), the classic timestepping scheme.
//!
//! ```text
//! q_m = q_i + dt/2 v_i
//! M(q_m) (v_{i+1} - v_i) = dt f(t_i + dt/2, q_m, v_i) + W(q_m) P
//! q_{i+1} = q_m + dt/2 v_{i+1}
//! ```
//!
//! The impulses `P` of the contacts that are closed at the middle hold impacts and forces together, by Newton's law of
//! impact for `W^T v`. Order 1 where a contact is closed. Explicit: stable for `omega dt < 2`.

use super::{Outcome, Scheme};
use crate::nonsmooth::activity::{closed_contacts, closes_anew};
use crate::nonsmooth::impact::restitution;
use crate::nonsmooth::matrix::{add_scaled, dot};
use crate::nonsmooth::mechanics::{Mechanics, StepError};
use crate::nonsmooth::state::{State, Step};

/// Room to work.
#[derive(Debug, Clone)]
pub struct Moreau {
    force: Vec<f64>,
    gaps: Vec<f64>,
    active: Vec<bool>,
    active_before: Vec<bool>,
    middle: Vec<f64>,
}

impl Moreau {
    /// For a system.
    pub fn new(mechanics: &Mechanics) -> Self {
        let contacts = mechanics.contacts().len();
        Self {
            force: vec![0.0; mechanics.order()],
            gaps: vec![0.0; contacts],
            active: vec![false; contacts],
            active_before: vec![false; contacts],
            middle: vec![0.0; mechanics.order()],
        }
    }
}

impl Scheme for Moreau {
    fn advance(
        &mut self,
        mechanics: &mut Mechanics,
        step: Step<'_>,
        from: &State,
        to: &mut State,
    ) -> Result<Outcome, StepError> {
        let dt = step.dt;
        // The middle of the step before, where its contacts were looked at.
        self.middle.copy_from_slice(&from.q);
        add_scaled(-0.5 * dt, &from.v, &mut self.middle);
        mechanics.system.gaps(&self.middle, &mut self.gaps);
        closed_contacts(mechanics.contacts(), &self.gaps, &mut self.active_before);
        to.q.copy_from_slice(&from.q);
        add_scaled(0.5 * dt, &from.v, &mut to.q);
        mechanics.system.gaps(&to.q, &mut self.gaps);
        closed_contacts(mechanics.contacts(), &self.gaps, &mut self.active);

        mechanics.factor_mass(&to.q)?;
        let middle = step.tau + 0.5 * dt;
        mechanics.force(step.drive, middle, [&to.q, &from.v], &mut self.force);
        mechanics.factors.solve(&mut self.force);
        to.v.copy_from_slice(&from.v);
        add_scaled(dt, &self.force, &mut to.v);

        mechanics.direct(&to.q, &self.active);
        mechanics.begin_problem();
        mechanics.add_laws(&self.active, 0);
        for row in 0..mechanics.problem.len() {
            let direction = mechanics.direction(row);
            let before = restitution(mechanics, row) * dot(direction, &from.v);
            let free = dot(direction, &to.v) + before;
            mechanics.problem.free.push(free);
        }
        // The unknowns are forces, impulses over dt, so that they can be compared with those of other schemes.
        mechanics.add_delassus(dt, None);
        to.forces.copy_from_slice(&from.forces);
        mechanics.solve_problem(&mut to.forces)?;
        mechanics.judge_problem();
        mechanics.respond(dt, &mut to.v);

        add_scaled(0.5 * dt, &to.v, &mut to.q);
        for (i, a) in to.a.iter_mut().enumerate() {
            *a = (to.v[i] - from.v[i]) / dt;
        }
        to.auxiliary.copy_from_slice(&to.a);
        to.inner_forces.fill(0.0);
        let has_impact = closes_anew(&self.active_before, &self.active);
        if has_impact {
            to.impulses.fill(0.0);
            add_scaled(dt, &to.forces, &mut to.impulses);
        }
        Ok(Outcome::Impulsive { has_impact })
    }
}
