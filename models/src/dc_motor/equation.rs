//! The equation of motion.

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;
use nalgebra::DMatrix;

use super::description::{ANGLE, CURRENT, PIN, POWER, RATE, STORED_ENERGY, TORQUE};
use crate::mechanics::equation::EquationOfMotion;
use crate::mechanics::planar::{AxisPoint, Triple};

/// Angle (rad), its rate (rad/s), current (A).
type State = [f64; 3];

/// Voltage (V), then force in x and y (N) and moment (N m) at the shaft and at the pin.
type Inputs = [f64; 7];

/// The shaft, from itself.
const SHAFT: AxisPoint = AxisPoint { along: 0.0 };

/// A direct-current motor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motor {
    inertia: f64,
    resistance: f64,
    inductance: f64,
    back_emf: f64,
    torque_constant: f64,
    friction: f64,
    pin: AxisPoint,
    shaft: [f64; 2],
}

impl Motor {
    /// # Errors
    /// [`SetupError`] if a parameter is missing or out of its range.
    pub fn from_setup(setup: &Setup) -> Result<Self, SetupError> {
        Ok(Self {
            inertia: setup.positive_parameter("inertia")?,
            resistance: setup.non_negative_parameter("resistance")?,
            inductance: setup.positive_parameter("inductance")?,
            back_emf: setup.parameter("back_emf")?,
            torque_constant: setup.parameter("torque_constant")?,
            friction: setup.non_negative_parameter("friction")?,
            pin: AxisPoint {
                along: setup.non_negative_parameter("crank")?,
            },
            shaft: [setup.parameter("shaft_x")?, setup.parameter("shaft_y")?],
        })
    }

    fn torque(&self, current: f64) -> f64 {
        self.torque_constant * current
    }

    fn stored_energy(&self, &[_, rate, current]: &State) -> f64 {
        0.5 * (self.inertia * rate * rate + self.inductance * current * current)
    }

    /// Output number `component` of a marker.
    fn marker(&self, point: AxisPoint, component: usize, state: &State, inputs: &Inputs) -> f64 {
        let &[angle, rate, _] = state;
        let [x, y] = self.shaft;
        let acceleration = || [0.0, 0.0, self.rate(state, inputs)[1]];
        point.output(component, [x, y, angle], [0.0, 0.0, rate], acceleration)
    }
}

/// Voltage, load at the shaft, load at the pin.
fn split(&[voltage, sx, sy, sm, px, py, pm]: &Inputs) -> (f64, Triple, Triple) {
    (voltage, [sx, sy, sm], [px, py, pm])
}

impl EquationOfMotion for Motor {
    type State = State;
    type Inputs = Inputs;

    const STATE_NAMES: &'static [&'static str] = &["angle", "rate", "current"];

    fn rate(&self, &[angle, rate, current]: &State, inputs: &Inputs) -> State {
        let (voltage, at_shaft, at_pin) = split(inputs);
        let moment = self.torque(current) - self.friction * rate
            + SHAFT.moment(angle, at_shaft)
            + self.pin.moment(angle, at_pin);
        let across_inductance = voltage - self.resistance * current - self.back_emf * rate;
        [
            rate,
            moment / self.inertia,
            across_inductance / self.inductance,
        ]
    }

    fn jacobian(&self, &[angle, ..]: &State, inputs: &Inputs, jacobian: &mut DMatrix<f64>) {
        let (_, _, at_pin) = split(inputs);
        jacobian.fill(0.0);
        jacobian[(0, 1)] = 1.0;
        jacobian[(1, 0)] = self.pin.moment_by_angle(angle, at_pin) / self.inertia;
        jacobian[(1, 1)] = -self.friction / self.inertia;
        jacobian[(1, 2)] = self.torque_constant / self.inertia;
        jacobian[(2, 1)] = -self.back_emf / self.inductance;
        jacobian[(2, 2)] = -self.resistance / self.inductance;
    }

    fn output(&self, state: &State, inputs: &Inputs, output: usize) -> Option<f64> {
        let &[angle, rate, current] = state;
        Some(match output {
            0..PIN => self.marker(SHAFT, output, state, inputs),
            PIN..ANGLE => self.marker(self.pin, output - PIN, state, inputs),
            ANGLE => angle,
            RATE => rate,
            CURRENT => current,
            TORQUE => self.torque(current),
            POWER => inputs[0] * current,
            STORED_ENERGY => self.stored_energy(state),
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::equation::tests::assert_jacobian;

    #[test]
    fn the_jacobian_is_the_derivative_of_the_rate() {
        let motor = Motor {
            inertia: 0.083,
            resistance: 0.43,
            inductance: 0.31,
            back_emf: 0.72,
            torque_constant: 0.69,
            friction: 0.057,
            pin: AxisPoint { along: 0.9 },
            shaft: [0.3, -0.2],
        };
        let inputs = [5.3, 1.9, -0.7, 0.4, 3.1, -1.7, 0.9];
        assert_jacobian(&motor, &[1.1, -4.0, 2.3], &inputs);
    }
}
