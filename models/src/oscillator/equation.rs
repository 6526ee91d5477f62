//! The equation of motion, once for all solvers.

use linchpin_proto::polynomial::MAX_NODES;
use linchpin_worker::Inputs;
use nalgebra::DMatrix;

use super::description::{A, F, PARTNER_V, PARTNER_X, V, X};
use super::parameters::{LoadStep, OscillatorParameters, PartnerSpring};
use crate::mechanics::equation::EquationOfMotion;

/// Position (m) and velocity (m/s).
pub type State = [f64; 2];

/// `m v' = u - c x - d v` with the springs and dampers to ground and to the partner taken together,
/// `u = f + k_p x_p + d_p v_p`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equation {
    pub mass: f64,
    pub stiffness: f64,
    pub damping: f64,
    partner: PartnerSpring,
    pub load: LoadStep,
}

impl Equation {
    pub fn new(own: OscillatorParameters, partner: PartnerSpring, load: LoadStep) -> Self {
        Self {
            mass: own.m,
            stiffness: own.c + partner.stiffness,
            damping: own.d + partner.damping,
            partner,
            load,
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

    /// Coefficients of `u(length s) = u_0 + u_1 s + u_2 s^2 + ...`.
    pub fn force_powers(&self, inputs: &Inputs, length: f64) -> [f64; MAX_NODES] {
        let powers = |input| inputs.polynomial(input).powers(length);
        let (f, partner_x, partner_v) = (powers(F), powers(PARTNER_X), powers(PARTNER_V));
        std::array::from_fn(|j| self.force(f[j], partner_x[j], partner_v[j]))
    }
}

impl EquationOfMotion for Equation {
    type State = State;
    type Inputs = [f64; 3];

    const STATE_NAMES: &'static [&'static str] = &["x", "v"];
    const IS_LINEAR: bool = true;

    fn rate(&self, &[x, v]: &State, &[f, partner_x, partner_v]: &[f64; 3]) -> State {
        let u = self.force(f, partner_x, partner_v);
        [v, self.acceleration(x, v, u)]
    }

    fn add_own_loads(&self, t: f64, [f, ..]: &mut [f64; 3]) {
        if t >= self.load.from {
            *f += self.load.force;
        }
    }

    fn jacobian(&self, _: &State, _: &[f64; 3], jacobian: &mut DMatrix<f64>) {
        jacobian[(0, 0)] = 0.0;
        jacobian[(0, 1)] = 1.0;
        jacobian[(1, 0)] = -self.stiffness / self.mass;
        jacobian[(1, 1)] = -self.damping / self.mass;
    }

    fn output(&self, state: &State, inputs: &[f64; 3], output: usize) -> Option<f64> {
        match output {
            X => Some(state[0]),
            V => Some(state[1]),
            A => Some(self.rate(state, inputs)[1]),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::equation::tests::assert_jacobian;

    #[test]
    fn the_jacobian_is_the_derivative_of_the_rate() {
        let equation = Equation {
            mass: 1.3,
            stiffness: 70.0,
            damping: 0.83,
            partner: PartnerSpring {
                stiffness: 20.0,
                damping: 0.3,
            },
            load: LoadStep {
                force: 0.0,
                from: 0.0,
            },
        };
        assert_jacobian(&equation, &[0.7, -2.9], &[3.1, -1.7, 0.9]);
    }
}
