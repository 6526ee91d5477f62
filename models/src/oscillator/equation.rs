//! The equation of motion, once for all solvers.

use linchpin_proto::polynomial::MAX_NODES;
use linchpin_worker::Inputs;
use nalgebra::DMatrix;

use super::description::{F, PARTNER_V, PARTNER_X};
use super::parameters::{OscillatorParameters, PartnerSpring};
use crate::integrators::Ode;

/// `m v' = u - c x - d v` with the springs and dampers to ground and to the partner taken together,
/// `u = f + k_p x_p + d_p v_p`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equation {
    pub mass: f64,
    pub stiffness: f64,
    pub damping: f64,
    partner: PartnerSpring,
}

impl Equation {
    pub fn new(own: OscillatorParameters, partner: PartnerSpring) -> Self {
        Self {
            mass: own.m,
            stiffness: own.c + partner.stiffness,
            damping: own.d + partner.damping,
            partner,
        }
    }

    /// `v'` at position `x` and velocity `v` under the force `u`.
    pub fn acceleration(&self, x: f64, v: f64, u: f64) -> f64 {
        (u - self.stiffness * x - self.damping * v) / self.mass
    }

    /// `u` of the values of the inputs.
    pub fn force(&self, f: f64, partner_x: f64, partner_v: f64) -> f64 {
        f + self.partner.stiffness * partner_x + self.partner.damping * partner_v
    }

    /// `u` at `tau` seconds after the start of the step.
    pub fn force_at(&self, inputs: &Inputs, tau: f64) -> f64 {
        let value = |input| inputs.value(input, tau);
        self.force(value(F), value(PARTNER_X), value(PARTNER_V))
    }

    /// Coefficients of `u(length s) = u_0 + u_1 s + u_2 s^2 + ...`.
    pub fn force_powers(&self, inputs: &Inputs, length: f64) -> [f64; MAX_NODES] {
        let powers = |input| inputs.polynomial(input).powers(length);
        let (f, partner_x, partner_v) = (powers(F), powers(PARTNER_X), powers(PARTNER_V));
        std::array::from_fn(|j| self.force(f[j], partner_x[j], partner_v[j]))
    }
}

/// The equation under given inputs, as integrators want it: `y = (x, v)`.
#[derive(Debug, Clone, Copy)]
pub struct Driven<'a> {
    pub equation: &'a Equation,
    pub inputs: &'a Inputs,
}

impl Ode for Driven<'_> {
    fn derivative(&self, tau: f64, y: &[f64], dy: &mut [f64]) {
        let u = self.equation.force_at(self.inputs, tau);
        dy[0] = y[1];
        dy[1] = self.equation.acceleration(y[0], y[1], u);
    }

    fn jacobian(&self, _tau: f64, _y: &[f64], jacobian: &mut DMatrix<f64>) -> bool {
        let Equation {
            mass,
            stiffness,
            damping,
            ..
        } = *self.equation;
        jacobian[(0, 0)] = 0.0;
        jacobian[(0, 1)] = 1.0;
        jacobian[(1, 0)] = -stiffness / mass;
        jacobian[(1, 1)] = -damping / mass;
        true
    }
}
