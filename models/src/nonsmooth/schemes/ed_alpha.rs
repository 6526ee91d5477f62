//! The energy decaying ED-alpha method on velocity level (S2 Sect. 2.7, eqs. 77 to 84; Bottasso 1997, Bottasso &
//! Trainelli 2004).
//!
//! The motion may jump at the start of the step, to the stage `j` at `t_i`; the equations of motion and the laws of
//! contact hold there and at `t_{i+1}`, and both are solved together.
//!
//! ```text
//! v_j = v_i + dt alpha_ar [alpha (a_j - a_i) - a_{i+1} + a_i],   v_{i+1} = v_i + dt/2 (a_j + a_{i+1})   (79, 80)
//! q_j = q_i + dt alpha_ar [alpha (v_j - v_i) - v_{i+1} + v_i],   q_{i+1} = q_i + dt/2 (v_j + v_{i+1})   (81, 82)
//! ```
//!
//! `alpha = (1 - rho_inf)/(1 + rho_inf)` (84) gives the spectral radius for infinite frequency, whatever `alpha_ar`,
//! which places the cut-off. Order 2; for linear systems 3 with `alpha_ar = 1/6`.

use super::{Outcome, Scheme, SchemeError};
use crate::nonsmooth::mechanics::{Mechanics, StepError};
use crate::nonsmooth::stages::{Coefficients, Stages};
use crate::nonsmooth::state::{State, Step};

/// Stage at `t_{i+1}`.
const END: usize = 0;
/// Stage `j` at `t_i`.
const JUMP: usize = 1;

/// Parameters and room to work.
#[derive(Debug, Clone)]
pub struct EdAlpha {
    alpha: f64,
    alpha_ar: f64,
    stages: Stages,
    /// Forces of both stages.
    forces: Vec<f64>,
}

impl EdAlpha {
    /// With `rho_inf` and `alpha_ar`.
    ///
    /// # Errors
    /// [`SchemeError`]: parameters out of range, or no damping for a system with contacts.
    pub fn new(rho_inf: f64, alpha_ar: f64, mechanics: &Mechanics) -> Result<Self, SchemeError> {
        if !(0.0..=1.0).contains(&rho_inf) {
            return Err(SchemeError::RhoInf(rho_inf));
        }
        if !(alpha_ar > 0.0 && alpha_ar.is_finite()) {
            return Err(SchemeError::AlphaAr(alpha_ar));
        }
        if rho_inf == 1.0 && mechanics.rows() > 0 {
            return Err(SchemeError::UndampedContacts);
        }
        Ok(Self {
            alpha: (1.0 - rho_inf) / (1.0 + rho_inf),
            alpha_ar,
            stages: Stages::new(mechanics, 2),
            forces: vec![0.0; 2 * mechanics.rows()],
        })
    }
}

impl Scheme for EdAlpha {
    fn advance(
        &mut self,
        mechanics: &mut Mechanics,
        step: Step<'_>,
        from: &State,
        to: &mut State,
    ) -> Result<Outcome, StepError> {
        let (dt, alpha, alpha_ar) = (step.dt, self.alpha, self.alpha_ar);
        // c4 to c7 and c12 to c15 of S2 eq. (90), with the factor dt of the errata.
        let shared = 1.0 / (dt * (1.0 + alpha));
        let mut coefficients = Coefficients::default();
        coefficients.a[END] = [2.0 * alpha * shared, -shared / alpha_ar];
        coefficients.a[JUMP] = [2.0 * shared, shared / alpha_ar];
        coefficients.q[END] = [0.5 * dt, 0.5 * dt];
        coefficients.q[JUMP] = [-dt * alpha_ar, dt * alpha_ar * alpha];
        let carried = (1.0 - alpha) / (1.0 + alpha);
        let [end, jump] = &mut self.stages.stages[..] else {
            return Err(StepError::NotFinite);
        };
        end.tau = step.tau + dt;
        jump.tau = step.tau;
        for i in 0..from.q.len() {
            let (q, v, a) = (from.q[i], from.v[i], from.a[i]);
            end.known_a[i] = (1.0 / alpha_ar - 2.0 * alpha) * shared * v + carried * a;
            jump.known_a[i] = -(1.0 / alpha_ar + 2.0) * shared * v - carried * a;
            end.known_q[i] = q;
            jump.known_q[i] = q + dt * alpha_ar * (1.0 - alpha) * v;
            end.v[i] = v + dt * a;
            jump.v[i] = v;
        }
        let rows = mechanics.rows();
        self.forces[..rows].copy_from_slice(&from.forces);
        self.forces[rows..].copy_from_slice(&from.inner_forces);
        self.stages
            .solve(mechanics, step, &coefficients, &mut self.forces)?;

        let end = &self.stages.stages[END];
        to.q.copy_from_slice(&end.q);
        to.v.copy_from_slice(&end.v);
        to.a.copy_from_slice(&end.a);
        to.auxiliary.copy_from_slice(&end.a);
        to.forces.copy_from_slice(&self.forces[..rows]);
        to.inner_forces.copy_from_slice(&self.forces[rows..]);
        Ok(Outcome::Smooth)
    }
}
