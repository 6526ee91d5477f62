//! The generalised-alpha method on velocity level (S2 Sect. 2.4, eqs. 20 to 26; Chung & Hulbert 1993, Arnold &
//! Bruels 2007).
//!
//! ```text
//! M a_{i+1} = f(t_{i+1}, q_{i+1}, v_{i+1}) + W lambda                    (20)
//! (1 - alpha_m) A_{i+1} + alpha_m A_i = (1 - alpha_f) a_{i+1} + alpha_f a_i   (21)
//! q_{i+1} = q_i + dt v_i + dt^2 [(1/2 - beta) A_i + beta A_{i+1}]        (22)
//! v_{i+1} = v_i + dt [(1 - gamma) A_i + gamma A_{i+1}]                   (23)
//! ```
//!
//! `gamma = 1/2 - alpha_m + alpha_f` (98) and `beta = (1 - alpha_m + alpha_f)^2 / 4` (102) give order 2 and the
//! strongest damping of high frequencies. Unconditionally stable for `alpha_m <= alpha_f <= 1/2` (100).

use super::{Outcome, Scheme, SchemeError};
use crate::nonsmooth::matrix::add_scaled;
use crate::nonsmooth::mechanics::{Mechanics, StepError};
use crate::nonsmooth::stages::{Coefficients, Stages};
use crate::nonsmooth::state::{State, Step};

/// Parameters and room to work.
#[derive(Debug, Clone)]
pub struct GeneralizedAlpha {
    alpha_m: f64,
    alpha_f: f64,
    beta: f64,
    gamma: f64,
    stages: Stages,
}

impl GeneralizedAlpha {
    /// With `alpha_m` and `alpha_f`.
    ///
    /// # Errors
    /// [`SchemeError::Alpha`].
    pub fn new(alpha_m: f64, alpha_f: f64, mechanics: &Mechanics) -> Result<Self, SchemeError> {
        let is_allowed = alpha_m.is_finite() && alpha_m <= alpha_f && alpha_f <= 0.5;
        if !is_allowed {
            return Err(SchemeError::Alpha { alpha_m, alpha_f });
        }
        Ok(Self::unrestricted(alpha_m, alpha_f, mechanics))
    }

    /// With any parameters, to study what happens outside of (100): high frequencies grow there, or a step has no
    /// solution.
    pub fn unrestricted(alpha_m: f64, alpha_f: f64, mechanics: &Mechanics) -> Self {
        Self {
            alpha_m,
            alpha_f,
            beta: 0.25 * (1.0 - alpha_m + alpha_f).powi(2),
            gamma: 0.5 - alpha_m + alpha_f,
            stages: Stages::new(mechanics, 1),
        }
    }

    /// With the spectral radius `rho_inf` for infinite frequency and the least damping of low ones (26).
    ///
    /// # Errors
    /// [`SchemeError::RhoInf`].
    pub fn optimal(rho_inf: f64, mechanics: &Mechanics) -> Result<Self, SchemeError> {
        if !(0.0..=1.0).contains(&rho_inf) {
            return Err(SchemeError::RhoInf(rho_inf));
        }
        let alpha_m = (2.0 * rho_inf - 1.0) / (rho_inf + 1.0);
        let alpha_f = rho_inf / (rho_inf + 1.0);
        Self::new(alpha_m, alpha_f, mechanics)
    }
}

impl Scheme for GeneralizedAlpha {
    fn advance(
        &mut self,
        mechanics: &mut Mechanics,
        step: Step<'_>,
        from: &State,
        to: &mut State,
    ) -> Result<Outcome, StepError> {
        let Self {
            alpha_m,
            alpha_f,
            beta,
            gamma,
            ref mut stages,
        } = *self;
        let dt = step.dt;
        // A_{i+1} = A^ + v_{i+1} / (gamma dt), from (23).
        let by_velocity = 1.0 / (gamma * dt);
        let share = (1.0 - alpha_m) / (1.0 - alpha_f);
        let stage = &mut stages.stages[0];
        stage.tau = step.tau + dt;
        for i in 0..from.q.len() {
            let (v, a, auxiliary) = (from.v[i], from.a[i], from.auxiliary[i]);
            let known = -(v + dt * (1.0 - gamma) * auxiliary) * by_velocity;
            stage.known_a[i] =
                share * known + (alpha_m * auxiliary - alpha_f * a) / (1.0 - alpha_f);
            stage.known_q[i] =
                from.q[i] + dt * (v + dt * ((0.5 - beta) * auxiliary + beta * known));
            stage.v[i] = v + dt * auxiliary;
        }
        let coefficients = Coefficients::single(beta / gamma * dt, share * by_velocity);
        to.forces.copy_from_slice(&from.forces);
        stages.solve(mechanics, step, &coefficients, &mut to.forces)?;

        let stage = &stages.stages[0];
        to.q.copy_from_slice(&stage.q);
        to.v.copy_from_slice(&stage.v);
        to.a.copy_from_slice(&stage.a);
        to.auxiliary.fill(0.0);
        add_scaled((1.0 - alpha_f) / (1.0 - alpha_m), &to.a, &mut to.auxiliary);
        add_scaled(alpha_f / (1.0 - alpha_m), &from.a, &mut to.auxiliary);
        add_scaled(
            -alpha_m / (1.0 - alpha_m),
            &from.auxiliary,
            &mut to.auxiliary,
        );
        to.inner_forces.fill(0.0);
        Ok(Outcome::Smooth)
    }
}
