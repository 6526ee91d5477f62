//! The equation of motion.

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;
use nalgebra::DMatrix;

use super::description::{ANGLE, ENERGY, OUTPUTS_PER_MARKER, RATE};
use crate::mechanics::equation::EquationOfMotion;
use crate::mechanics::planar::{AxisPoint, Triple};

/// Angle (rad) and its rate (rad/s).
type State = [f64; 2];

/// Loads at the tip and at the centre of mass.
type Loads = [f64; 6];

/// A link on a hinge in the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HingedLink {
    mass: f64,
    /// About the hinge.
    inertia: f64,
    centre: AxisPoint,
    tip: AxisPoint,
    hinge: [f64; 2],
    gravity: f64,
    spring: f64,
    damping: f64,
    rest_angle: f64,
}

impl HingedLink {
    /// # Errors
    /// [`SetupError`] if a parameter is missing or out of its range.
    pub fn from_setup(setup: &Setup) -> Result<Self, SetupError> {
        let mass = setup.positive_parameter("m")?;
        let length = setup.positive_parameter("length")?;
        let centre = 0.5 * length + setup.parameter("offset")?;
        Ok(Self {
            mass,
            inertia: setup.positive_parameter("inertia")? + mass * centre * centre,
            centre: AxisPoint { along: centre },
            tip: AxisPoint { along: length },
            hinge: [setup.parameter("hinge_x")?, setup.parameter("hinge_y")?],
            gravity: setup.parameter("gravity")?,
            spring: setup.non_negative_parameter("spring")?,
            damping: setup.non_negative_parameter("damping")?,
            rest_angle: setup.parameter("rest_angle")?,
        })
    }

    fn weight(&self) -> Triple {
        [0.0, -self.mass * self.gravity, 0.0]
    }

    fn sum(&self, loads: &Loads, of: impl Fn(AxisPoint, Triple) -> f64) -> f64 {
        let &[
            fx_tip,
            fy_tip,
            moment_tip,
            fx_centre,
            fy_centre,
            moment_centre,
        ] = loads;
        of(self.tip, [fx_tip, fy_tip, moment_tip])
            + of(self.centre, [fx_centre, fy_centre, moment_centre])
            + of(self.centre, self.weight())
    }

    fn energy(&self, &[angle, rate]: &State) -> f64 {
        let [_, height, _] = self.centre.position([self.hinge[0], self.hinge[1], angle]);
        let turn = angle - self.rest_angle;
        0.5 * (self.inertia * rate * rate + self.spring * turn * turn)
            + self.mass * self.gravity * height
    }
}

impl EquationOfMotion for HingedLink {
    type State = State;
    type Inputs = Loads;

    const STATE_NAMES: &'static [&'static str] = &["angle", "rate"];

    fn rate(&self, &[angle, rate]: &State, loads: &Loads) -> State {
        let moment = self.sum(loads, |point, load| point.moment(angle, load))
            - self.spring * (angle - self.rest_angle)
            - self.damping * rate;
        [rate, moment / self.inertia]
    }

    fn jacobian(&self, &[angle, _]: &State, loads: &Loads, jacobian: &mut DMatrix<f64>) {
        let moment_by_angle =
            self.sum(loads, |point, load| point.moment_by_angle(angle, load)) - self.spring;
        jacobian[(0, 0)] = 0.0;
        jacobian[(0, 1)] = 1.0;
        jacobian[(1, 0)] = moment_by_angle / self.inertia;
        jacobian[(1, 1)] = -self.damping / self.inertia;
    }

    fn output(&self, state: &State, loads: &Loads, output: usize) -> Option<f64> {
        let &[angle, rate] = state;
        Some(match output {
            0..ANGLE => {
                let [x, y] = self.hinge;
                let acceleration = || [0.0, 0.0, self.rate(state, loads)[1]];
                let marker = [self.tip, self.centre][output / OUTPUTS_PER_MARKER];
                let component = output % OUTPUTS_PER_MARKER;
                marker.output(component, [x, y, angle], [0.0, 0.0, rate], acceleration)
            }
            ANGLE => angle,
            RATE => rate,
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
        let link = HingedLink {
            mass: 1.3,
            inertia: 0.6,
            centre: AxisPoint { along: 0.56 },
            tip: AxisPoint { along: 0.9 },
            hinge: [0.3, -0.2],
            gravity: 9.7,
            spring: 21.0,
            damping: 0.83,
            rest_angle: 0.3,
        };
        assert_jacobian(&link, &[1.1, -4.0], &[3.1, -1.7, 0.9, -0.8, 2.2, 0.7]);
    }
}
