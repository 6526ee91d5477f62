//! The equation of motion.

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;
use nalgebra::DMatrix;

use super::description::{ENERGY, OUTPUTS_PER_MARKER, STATES};
use crate::mechanics::equation::EquationOfMotion;
use crate::mechanics::planar::{AxisPoint, Triple};

/// Centre of mass and angle `(x, y, angle)`, and their rates.
type State = [f64; 6];

/// Loads at the start and at the end.
type Loads = [f64; 6];

/// A free rigid link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeLink {
    mass: f64,
    inertia: f64,
    /// Start and end, from the centre of mass.
    markers: [AxisPoint; 2],
    gravity: f64,
}

impl FreeLink {
    /// # Errors
    /// [`SetupError`] if a parameter is missing or out of its range.
    pub fn from_setup(setup: &Setup) -> Result<Self, SetupError> {
        let half = 0.5 * setup.positive_parameter("length")?;
        Ok(Self {
            mass: setup.positive_parameter("m")?,
            inertia: setup.positive_parameter("inertia")?,
            markers: [-half, half].map(|along| AxisPoint { along }),
            gravity: setup.parameter("gravity")?,
        })
    }

    /// The state in which marker `start` has this position and velocity.
    pub fn state_of_start(&self, position: Triple, velocity: Triple) -> State {
        let [start, _] = self.markers;
        let centre = AxisPoint {
            along: -start.along,
        };
        let [x, y, angle] = centre.position(position);
        let [vx, vy, rate] = centre.velocity(angle, velocity);
        [x, y, angle, vx, vy, rate]
    }

    fn energy(&self, &[_, y, _, vx, vy, rate]: &State) -> f64 {
        0.5 * (self.mass * (vx * vx + vy * vy) + self.inertia * rate * rate)
            + self.mass * self.gravity * y
    }

    fn acceleration(&self, angle: f64, loads: &Loads) -> Triple {
        let &[fx_start, fy_start, _, fx_end, fy_end, _] = loads;
        let moment = self.sum(loads, |marker, load| marker.moment(angle, load));
        [
            (fx_start + fx_end) / self.mass,
            (fy_start + fy_end) / self.mass - self.gravity,
            moment / self.inertia,
        ]
    }

    fn sum(&self, loads: &Loads, of: impl Fn(AxisPoint, Triple) -> f64) -> f64 {
        let &[fx_start, fy_start, moment_start, fx_end, fy_end, moment_end] = loads;
        let [start, end] = self.markers;
        of(start, [fx_start, fy_start, moment_start]) + of(end, [fx_end, fy_end, moment_end])
    }
}

impl EquationOfMotion for FreeLink {
    type State = State;
    type Inputs = Loads;

    const STATE_NAMES: &'static [&'static str] = &["x", "y", "angle", "vx", "vy", "rate"];

    fn rate(&self, &[_, _, angle, vx, vy, rate]: &State, loads: &Loads) -> State {
        let [ax, ay, alpha] = self.acceleration(angle, loads);
        [vx, vy, rate, ax, ay, alpha]
    }

    fn jacobian(&self, state: &State, loads: &Loads, jacobian: &mut DMatrix<f64>) {
        let angle = state[2];
        let moment_by_angle = self.sum(loads, |marker, load| marker.moment_by_angle(angle, load));
        jacobian.fill(0.0);
        for i in 0..3 {
            jacobian[(i, i + 3)] = 1.0;
        }
        jacobian[(5, 2)] = moment_by_angle / self.inertia;
    }

    fn output(&self, state: &State, loads: &Loads, output: usize) -> Option<f64> {
        let &[x, y, angle, vx, vy, rate] = state;
        Some(match output {
            0..STATES => self.markers[output / OUTPUTS_PER_MARKER].output(
                output % OUTPUTS_PER_MARKER,
                [x, y, angle],
                [vx, vy, rate],
                || self.acceleration(angle, loads),
            ),
            STATES..ENERGY => state[output - STATES],
            ENERGY => self.energy(state),
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
        let link = FreeLink {
            mass: 1.3,
            inertia: 0.17,
            markers: [-0.45, 0.45].map(|along| AxisPoint { along }),
            gravity: 9.7,
        };
        let state = [0.3, -0.7, 1.1, 2.0, 0.9, -4.0];
        assert_jacobian(&link, &state, &[3.1, -1.7, 0.9, -2.0, 0.6, 4.4]);
    }
}
