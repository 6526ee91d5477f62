//! The equation of motion.

use linchpin_proto::joint_load::Wrench;
use nalgebra::{DMatrix, Matrix3, Quaternion, Vector3};

use super::description::{ENERGY, OMEGA, OUTPUTS_PER_MARKER, POSITION, VELOCITY};
use super::parameters::BodyParameters;
use crate::mechanics::equation::EquationOfMotion;
use crate::mechanics::spatial::{
    BodyAcceleration, BodyMotion, BodyPoint, attitude_rate, attitude_rate_by_attitude,
    attitude_rate_by_omega, real_first,
};

/// Position of the centre, attitude `(w, x, y, z)`, velocity of the centre, angular velocity in the body's axes.
type State = [f64; 13];

/// Force and moment at the start, then at the end.
type Loads = [f64; 12];

/// A free rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeBody {
    parameters: BodyParameters,
}

/// The state of a motion.
pub fn state(motion: &BodyMotion) -> State {
    let attitude = real_first(&motion.attitude);
    join(
        &motion.position,
        attitude.as_ref(),
        &motion.velocity,
        &motion.omega,
    )
}

/// The motion of a state.
fn motion(&[x, y, z, qw, qx, qy, qz, vx, vy, vz, omega1, omega2, omega3]: &State) -> BodyMotion {
    BodyMotion {
        position: Vector3::new(x, y, z),
        attitude: Quaternion::new(qw, qx, qy, qz),
        velocity: Vector3::new(vx, vy, vz),
        omega: Vector3::new(omega1, omega2, omega3),
    }
}

fn join(
    position: &Vector3<f64>,
    &[qw, qx, qy, qz]: &[f64; 4],
    velocity: &Vector3<f64>,
    omega: &Vector3<f64>,
) -> State {
    let ([x, y, z], [vx, vy, vz]) = ((*position).into(), (*velocity).into());
    let [omega1, omega2, omega3] = (*omega).into();
    [x, y, z, qw, qx, qy, qz, vx, vy, vz, omega1, omega2, omega3]
}

impl FreeBody {
    pub fn new(parameters: BodyParameters) -> Self {
        Self { parameters }
    }

    fn loaded_points(&self, loads: &Loads) -> [(BodyPoint, Wrench); 2] {
        let vector = |first: usize| Vector3::new(loads[first], loads[first + 1], loads[first + 2]);
        let wrench = |first: usize| Wrench {
            force: vector(first),
            moment: vector(first + 3),
        };
        let [start, end] = self.parameters.markers;
        [(start, wrench(0)), (end, wrench(6))]
    }

    /// Newton's law and Euler's equations.
    fn acceleration(&self, motion: &BodyMotion, loads: &Loads) -> BodyAcceleration {
        let BodyParameters {
            mass,
            inertia,
            gravity,
            ..
        } = self.parameters;
        let BodyMotion {
            attitude, omega, ..
        } = motion;
        let points = self.loaded_points(loads);
        let force: Vector3<f64> = points.iter().map(|(_, load)| load.force).sum();
        let moments = points
            .iter()
            .map(|(point, load)| point.moment(attitude, load));
        let moment = moments.sum::<Vector3<f64>>() - omega.cross(&inertia.component_mul(omega));
        BodyAcceleration {
            centre: force / mass - gravity * Vector3::z(),
            alpha: moment.component_div(&inertia),
        }
    }

    fn energy(&self, motion: &BodyMotion) -> f64 {
        let BodyParameters {
            mass,
            inertia,
            gravity,
            ..
        } = self.parameters;
        let turning = motion.omega.dot(&inertia.component_mul(&motion.omega));
        0.5 * (mass * motion.velocity.norm_squared() + turning) + mass * gravity * motion.position.z
    }
}

impl EquationOfMotion for FreeBody {
    type State = State;
    type Inputs = Loads;

    const STATE_NAMES: &'static [&'static str] = &[
        "x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "omega1", "omega2", "omega3",
    ];

    fn rate(&self, state: &State, loads: &Loads) -> State {
        let motion = motion(state);
        let BodyAcceleration { centre, alpha } = self.acceleration(&motion, loads);
        let turning = attitude_rate(&motion.attitude, &motion.omega);
        join(&motion.velocity, turning.as_ref(), &centre, &alpha)
    }

    fn jacobian(&self, state: &State, loads: &Loads, jacobian: &mut DMatrix<f64>) {
        let BodyMotion {
            attitude, omega, ..
        } = motion(state);
        let inertia = Matrix3::from_diagonal(&self.parameters.inertia);
        let mobility = Matrix3::from_diagonal(&self.parameters.inertia.map(f64::recip));
        let gyroscopic = (inertia * omega).cross_matrix() - omega.cross_matrix() * inertia;
        let points = self.loaded_points(loads);
        let moments = points.map(|(point, load)| point.moment_by_attitude(&attitude, &load));

        jacobian.fill(0.0);
        jacobian.fixed_view_mut::<3, 3>(0, 7).fill_with_identity();
        jacobian
            .fixed_view_mut::<4, 4>(3, 3)
            .copy_from(&attitude_rate_by_attitude(&omega));
        jacobian
            .fixed_view_mut::<4, 3>(3, 10)
            .copy_from(&attitude_rate_by_omega(&attitude));
        jacobian
            .fixed_view_mut::<3, 4>(10, 3)
            .copy_from(&(mobility * (moments[0] + moments[1])));
        jacobian
            .fixed_view_mut::<3, 3>(10, 10)
            .copy_from(&(mobility * gyroscopic));
    }

    fn output(&self, state: &State, loads: &Loads, output: usize) -> Option<f64> {
        let motion = motion(state);
        Some(match output {
            0..POSITION => self.parameters.markers[output / OUTPUTS_PER_MARKER].output(
                output % OUTPUTS_PER_MARKER,
                &motion,
                || self.acceleration(&motion, loads),
            ),
            POSITION..VELOCITY => motion.position[output - POSITION],
            VELOCITY..OMEGA => motion.velocity[output - VELOCITY],
            OMEGA..ENERGY => motion.omega[output - OMEGA],
            ENERGY => self.energy(&motion),
            _ => return None,
        })
    }

    fn settle(&self, state: &mut State) {
        let attitude = motion(state).attitude.normalize();
        state[3..7].copy_from_slice(real_first(&attitude).as_slice());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::equation::tests::assert_jacobian;

    #[test]
    fn the_jacobian_is_the_derivative_of_the_rate() {
        let body = FreeBody::new(BodyParameters {
            mass: 1.3,
            inertia: Vector3::new(0.17, 0.29, 0.23),
            gravity: 9.7,
            markers: [
                BodyPoint(Vector3::new(-0.4, 0.1, 0.23)),
                BodyPoint(Vector3::new(0.5, -0.3, 0.07)),
            ],
        });
        let state = state(&BodyMotion {
            position: Vector3::new(0.3, -0.7, 0.2),
            attitude: Quaternion::new(0.3, -0.8, 0.4, 0.33),
            velocity: Vector3::new(2.0, 0.9, -1.2),
            omega: Vector3::new(2.0, -3.0, 1.5),
        });
        let loads = [
            3.1, -1.7, 0.9, -2.0, 0.6, 4.4, 1.9, 2.7, -0.3, -1.1, 5.2, 0.8,
        ];
        assert_jacobian(&body, &state, &loads);
    }
}
