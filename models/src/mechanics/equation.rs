//! What a model gives: the equation of motion `y' = f(y, u)` and its outputs.

use linchpin_worker::Inputs;
use nalgebra::DMatrix;

use super::joint_loads::JointLoads;
use crate::integrators::Ode;

/// A fixed number of values: states or inputs.
pub trait Vector: Copy + Send + AsRef<[f64]> + AsMut<[f64]> {
    /// All zero.
    const ZERO: Self;
}

impl<const N: usize> Vector for [f64; N] {
    const ZERO: Self = [0.0; N];
}

/// An equation of motion with states `y` and inputs `u`.
pub trait EquationOfMotion: Send {
    /// The states `y`.
    type State: Vector;
    /// The inputs `u`, in the order of the model's description; loads of joints are added to those of the markers.
    type Inputs: Vector;

    /// Names of the states, for messages.
    const STATE_NAMES: &'static [&'static str];

    /// Whether `f` and the outputs are linear in states and inputs together, without a constant part: the motion is then the
    /// sum of the motions that its causes have alone, and the derivative in a direction is the motion from zero under that
    /// direction.
    const IS_LINEAR: bool = false;

    /// `f(y, u)`.
    fn rate(&self, state: &Self::State, inputs: &Self::Inputs) -> Self::State;

    /// Writes `df/dy` to `jacobian`, all of it.
    fn jacobian(&self, state: &Self::State, inputs: &Self::Inputs, jacobian: &mut DMatrix<f64>);

    /// Output number `output` of the model's description; `None` if there is none. Positions of markers do not depend
    /// on the inputs.
    fn output(&self, state: &Self::State, inputs: &Self::Inputs, output: usize) -> Option<f64>;

    /// Adds the loads that the model brings itself at time `t` (s) to the inputs; they belong to the motion and to no direction.
    fn add_own_loads(&self, _t: f64, _inputs: &mut Self::Inputs) {}

    /// Brings a state that a macro step has reached back to where states belong (a quaternion to unit length).
    fn settle(&self, _state: &mut Self::State) {}
}

/// The equation under given inputs and joint loads, as integrators want it.
#[derive(Debug, Clone, Copy)]
pub struct Driven<'a, E> {
    pub equation: &'a E,
    pub inputs: &'a Inputs,
    pub joint_loads: &'a JointLoads,
    /// Time at `tau = 0` in s; `None` for the motion in a direction, which no load of the model's own drives.
    pub start: Option<f64>,
}

impl<E: EquationOfMotion> Driven<'_, E> {
    /// State and inputs at `tau`.
    pub fn at(&self, tau: f64, y: &[f64]) -> (E::State, E::Inputs) {
        let mut state = E::State::ZERO;
        state.as_mut().copy_from_slice(y);
        let mut inputs = self
            .joint_loads
            .inputs_at(self.equation, &state, self.inputs, tau);
        if let Some(start) = self.start {
            self.equation.add_own_loads(start + tau, &mut inputs);
        }
        (state, inputs)
    }
}

impl<E: EquationOfMotion> Ode for Driven<'_, E> {
    fn derivative(&self, tau: f64, y: &[f64], dy: &mut [f64]) {
        let (state, inputs) = self.at(tau, y);
        dy.copy_from_slice(self.equation.rate(&state, &inputs).as_ref());
    }

    /// Joint loads depend on the state by way of the markers: then the integrator's differences serve.
    fn jacobian(&self, tau: f64, y: &[f64], jacobian: &mut DMatrix<f64>) -> bool {
        if !self.joint_loads.is_empty() {
            return false;
        }
        let (state, inputs) = self.at(tau, y);
        self.equation.jacobian(&state, &inputs, jacobian);
        true
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// Asserts that the Jacobian of an equation is that of central differences of its rate.
    pub fn assert_jacobian<E: EquationOfMotion>(
        equation: &E,
        state: &E::State,
        inputs: &E::Inputs,
    ) {
        let n = E::STATE_NAMES.len();
        assert_eq!(n, state.as_ref().len());
        let mut jacobian = DMatrix::repeat(n, n, f64::NAN);
        equation.jacobian(state, inputs, &mut jacobian);
        for j in 0..n {
            let rate_at = |change: f64| {
                let mut moved = *state;
                moved.as_mut()[j] += change;
                equation.rate(&moved, inputs)
            };
            let increment = 1e-5;
            let (low, high) = (rate_at(-increment), rate_at(increment));
            for (i, (low, high)) in low.as_ref().iter().zip(high.as_ref()).enumerate() {
                let difference = (high - low) / (2.0 * increment);
                let own = jacobian[(i, j)];
                assert!(
                    (own - difference).abs() < 1e-8 * (1.0 + own.abs()),
                    "row {i}, column {}: {own} instead of {difference}",
                    E::STATE_NAMES[j]
                );
            }
        }
    }
}
