//! Momentum and energy of a rigid body in space.

use nalgebra::Vector3;

use super::ReferenceError;
use super::ranges::not_negative;
pub use crate::mechanics::spatial::BodyMotion;
use crate::mechanics::spatial::{to_body, to_space};

/// Mass and moments of inertia of a body whose axes are its principal ones through the centre of mass.
///
/// Sums over bodies that act on nothing but each other stay as they are: [`RigidBody::momentum`],
/// [`RigidBody::angular_momentum`] about one point, and, in ideal joints, the sum of both energies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody {
    /// Mass (kg), not negative.
    pub m: f64,
    /// Principal moments of inertia about the centre of mass (kg m^2), not negative.
    pub moments: Vector3<f64>,
}

impl RigidBody {
    pub(super) fn check(&self) -> Result<(), ReferenceError> {
        not_negative("m", self.m)?;
        for &moment in self.moments.iter() {
            not_negative("moments", moment)?;
        }
        Ok(())
    }

    /// `m v` (kg m/s), in space.
    pub fn momentum(&self, motion: &BodyMotion) -> Vector3<f64> {
        self.m * motion.velocity
    }

    /// `(r - p) x m v + T J omega` (kg m^2/s), in space, about the point `p` (m) that rests in space; `T` turns from
    /// the body's axes to those of space.
    pub fn angular_momentum(&self, motion: &BodyMotion, about: &Vector3<f64>) -> Vector3<f64> {
        let spin = self.moments.component_mul(&motion.omega);
        (motion.position - about).cross(&self.momentum(motion)) + to_space(&motion.attitude, &spin)
    }

    /// `(m v v + omega J omega) / 2` (J).
    pub fn kinetic_energy(&self, motion: &BodyMotion) -> f64 {
        let spin = self.moments.component_mul(&motion.omega);
        0.5 * (self.m * motion.velocity.norm_squared() + motion.omega.dot(&spin))
    }

    /// `-m g r` (J), 0 at the origin, in uniform gravity of the acceleration `gravity` (m/s^2, in space).
    pub fn potential_energy(&self, motion: &BodyMotion, gravity: &Vector3<f64>) -> f64 {
        -self.m * gravity.dot(&motion.position)
    }

    /// `T J T^-1 v`, in space.
    pub(super) fn inertia_times(&self, motion: &BodyMotion, v: &Vector3<f64>) -> Vector3<f64> {
        let scaled = self.moments.component_mul(&to_body(&motion.attitude, v));
        to_space(&motion.attitude, &scaled)
    }
}
