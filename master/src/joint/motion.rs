//! Motion of a joint's markers, and vectors that they carry, with their time derivatives.

use linchpin_proto::joint_load::{Marker, Pose};
use nalgebra::Vector3;

use super::level::Level;

/// Motion of a marker. Vectors are in inertial axes; a marker in the plane moves in the first two of them and turns about
/// the third, a scalar marker moves along the first. What was not read is zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MarkerMotion {
    /// Position (m) and orientation.
    pub pose: Pose,
    /// m/s
    pub velocity: Vector3<f64>,
    /// Angular velocity, rad/s.
    pub omega: Vector3<f64>,
    /// m/s^2
    pub acceleration: Vector3<f64>,
    /// Angular acceleration, rad/s^2.
    pub alpha: Vector3<f64>,
}

/// A small change of a [`MarkerMotion`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MarkerChange {
    /// Of the position.
    pub position: Vector3<f64>,
    /// Rotation vector of the change of orientation, in inertial axes.
    pub rotation: Vector3<f64>,
    /// Of the velocity.
    pub velocity: Vector3<f64>,
    /// Of the angular velocity.
    pub omega: Vector3<f64>,
    /// Of the acceleration.
    pub acceleration: Vector3<f64>,
    /// Of the angular acceleration.
    pub alpha: Vector3<f64>,
}

/// Motion of the markers at ends a and b.
pub type Motion = [MarkerMotion; 2];

/// A vector with its first and second time derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet(pub [Vector3<f64>; 3]);

impl Default for MarkerMotion {
    /// At rest in the origin, parallel to the inertial axes.
    fn default() -> Self {
        let zero = Vector3::zeros();
        Self {
            pose: Pose::default(),
            velocity: zero,
            omega: zero,
            acceleration: zero,
            alpha: zero,
        }
    }
}

impl Marker for MarkerMotion {
    type Vector = Jet;

    fn constant(vector: Vector3<f64>) -> Jet {
        Jet::constant(vector)
    }

    /// `T s`, `omega x T s`, `alpha x T s + omega x (omega x T s)`.
    fn carried(&self, s: &Vector3<f64>) -> Jet {
        let carried = self.pose.carried(s);
        let rate = self.omega.cross(&carried);
        let second = self.alpha.cross(&carried) + self.omega.cross(&rate);
        Jet([carried, rate, second])
    }

    /// `r + T s` and its derivatives.
    fn point(&self, s: &Vector3<f64>) -> Jet {
        let Jet([carried, rate, second]) = self.carried(s);
        Jet([
            self.pose.position + carried,
            self.velocity + rate,
            self.acceleration + second,
        ])
    }
}

impl MarkerMotion {
    /// Change of [`Marker::carried`] under a small change of the motion.
    pub fn carried_change(&self, s: &Vector3<f64>, change: &MarkerChange) -> Jet {
        let Jet([carried, rate, _]) = self.carried(s);
        let moved = change.rotation.cross(&carried);
        let moved_rate = change.omega.cross(&carried) + self.omega.cross(&moved);
        let moved_second = change.alpha.cross(&carried)
            + self.alpha.cross(&moved)
            + change.omega.cross(&rate)
            + self.omega.cross(&moved_rate);
        Jet([moved, moved_rate, moved_second])
    }

    /// Change of [`Marker::point`] under a small change of the motion.
    pub fn point_change(&self, s: &Vector3<f64>, change: &MarkerChange) -> Jet {
        let Jet([carried, rate, second]) = self.carried_change(s, change);
        Jet([
            change.position + carried,
            change.velocity + rate,
            change.acceleration + second,
        ])
    }
}

impl Jet {
    /// A vector that does not change in time.
    pub fn constant(vector: Vector3<f64>) -> Self {
        Self([vector, Vector3::zeros(), Vector3::zeros()])
    }

    /// The scalar product `u . w`, its rate `u' . w + u . w'`, or `u'' . w + 2 u' . w' + u . w''`.
    pub fn dot(&self, other: &Self, level: Level) -> f64 {
        let (Self([u, u1, u2]), Self([w, w1, w2])) = (self, other);
        match level {
            Level::Position => u.dot(w),
            Level::Velocity => u1.dot(w) + u.dot(w1),
            Level::Acceleration => u2.dot(w) + 2.0 * u1.dot(w1) + u.dot(w2),
        }
    }
}

impl std::ops::Sub for Jet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|level| self.0[level] - other.0[level]))
    }
}

impl std::ops::Neg for Jet {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|vector| -vector))
    }
}
