//! Motion of rigid bodies, told by their centres of mass in inertial axes.

use linchpin_proto::joint_load::{Displacement, Pose, Wrench};
use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

use crate::mechanics::spatial::real_first;

/// How a body is turned. An angle tells full turns apart, a quaternion does not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Orientation {
    /// In the plane (rad).
    Angle(f64),
    /// In space: quaternion from the body's axes to inertial ones; its length does not count.
    Attitude(Quaternion<f64>),
}

impl Orientation {
    /// From `angle`, or `w, x, y, z`.
    pub fn from_parts(parts: &[f64]) -> Self {
        match *parts {
            [w, x, y, z] => Self::Attitude(Quaternion::new(w, x, y, z)),
            _ => Self::Angle(parts.first().copied().unwrap_or_default()),
        }
    }

    /// Writes `angle`, or `w, x, y, z`.
    pub fn put(&self, parts: &mut [f64]) {
        match self {
            Self::Angle(angle) => parts[0] = *angle,
            Self::Attitude(attitude) => parts.copy_from_slice(real_first(attitude).as_slice()),
        }
    }

    /// Rotation from the body's axes to inertial ones.
    pub fn rotation(&self) -> Matrix3<f64> {
        match *self {
            Self::Angle(angle) => {
                Rotation3::from_axis_angle(&Vector3::z_axis(), angle).into_inner()
            }
            Self::Attitude(attitude) => UnitQuaternion::from_quaternion(attitude)
                .to_rotation_matrix()
                .into_inner(),
        }
    }

    /// This turn after a turn `inner` that is given in the axes of this one.
    pub fn then(&self, inner: &Self) -> Self {
        match (self, inner) {
            (Self::Attitude(outer), Self::Attitude(inner)) => Self::Attitude(outer * inner),
            (Self::Angle(outer), Self::Angle(inner)) => Self::Angle(outer + inner),
            _ => *self,
        }
    }

    /// The turn that leads from this one to `other`, in the axes of this one.
    pub fn to(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Attitude(own), Self::Attitude(other)) => Self::Attitude(own.conjugate() * other),
            (Self::Angle(own), Self::Angle(other)) => Self::Angle(other - own),
            _ => *other,
        }
    }

    /// A turn by `angle` about a unit vector, of the same kind as this one; in the plane about the third axis.
    pub fn about(&self, axis: &Vector3<f64>, angle: f64) -> Self {
        match self {
            Self::Angle(_) => Self::Angle(angle * axis.z.signum()),
            Self::Attitude(_) => {
                let axis = Unit::new_unchecked(*axis);
                Self::Attitude(UnitQuaternion::from_axis_angle(&axis, angle).into_inner())
            }
        }
    }

    /// This turn followed by a small one in inertial axes, at unit length.
    pub fn displaced(&self, turn: &Vector3<f64>) -> Self {
        match self {
            Self::Angle(angle) => Self::Angle(angle + turn.z),
            Self::Attitude(attitude) => {
                let turn = UnitQuaternion::from_scaled_axis(*turn).into_inner();
                Self::Attitude((turn * attitude).normalize())
            }
        }
    }

    /// The same turn by a quaternion of length 1.
    pub fn settled(&self) -> Self {
        match self {
            Self::Angle(angle) => Self::Angle(*angle),
            Self::Attitude(attitude) => Self::Attitude(attitude.normalize()),
        }
    }
}

/// Velocity of a point and angular velocity, or their rates, or small displacements; in inertial axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// Of the point.
    pub linear: Vector3<f64>,
    /// Of the body.
    pub angular: Vector3<f64>,
}

impl Twist {
    /// At rest.
    pub const ZERO: Self = Self {
        linear: Vector3::new(0.0, 0.0, 0.0),
        angular: Vector3::new(0.0, 0.0, 0.0),
    };

    /// `self + factor other`.
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        Self {
            linear: self.linear + factor * other.linear,
            angular: self.angular + factor * other.angular,
        }
    }

    /// Velocity at the point `arm` away: `v + omega x arm`.
    pub fn shifted(&self, arm: &Vector3<f64>) -> Self {
        Self {
            linear: self.linear + self.angular.cross(arm),
            angular: self.angular,
        }
    }

    /// Acceleration at the point `arm` away on a body with the angular velocity `omega`; this is the acceleration of the
    /// body's own point: `a + alpha x arm + omega x (omega x arm)`.
    pub fn accelerated(&self, arm: &Vector3<f64>, omega: &Vector3<f64>) -> Self {
        let mut shifted = self.shifted(arm);
        shifted.linear += omega.cross(&omega.cross(arm));
        shifted
    }

    /// Power of a load at the same point.
    pub fn power(&self, wrench: &Wrench) -> f64 {
        self.linear.dot(&wrench.force) + self.angular.dot(&wrench.moment)
    }

    /// As a small displacement.
    pub fn displacement(&self) -> Displacement {
        Displacement {
            position: self.linear,
            rotation: self.angular,
        }
    }
}

/// A load at a point, moved to a point from which it is `arm` away.
pub fn moved_load(load: &Wrench, arm: &Vector3<f64>) -> Wrench {
    Wrench {
        force: load.force,
        moment: load.moment + arm.cross(&load.force),
    }
}

/// Adds a load to another one at the same point.
pub fn add_load(sum: &mut Wrench, factor: f64, load: &Wrench) {
    sum.force += factor * load.force;
    sum.moment += factor * load.moment;
}

/// No load.
pub const NO_LOAD: Wrench = Wrench {
    force: Vector3::new(0.0, 0.0, 0.0),
    moment: Vector3::new(0.0, 0.0, 0.0),
};

/// Where a body is and how it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion {
    /// How it is turned.
    pub orientation: Orientation,
    /// Pose of the centre of mass; the rotation is that of the orientation.
    pub pose: Pose,
    /// Velocity of the centre of mass and angular velocity.
    pub twist: Twist,
}

impl BodyMotion {
    /// From the centre of mass to a point of the body that is given in its axes.
    pub fn arm(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.pose.rotation * point
    }

    /// Position of a point that is given in the body's axes.
    pub fn point(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.pose.position + self.arm(point)
    }

    /// Velocity of a point that is given in the body's axes.
    pub fn velocity(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.twist.shifted(&self.arm(point)).linear
    }

    /// In the body's axes: a point that is given in inertial ones.
    pub fn local_point(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.local_vector(&(point - self.pose.position))
    }

    /// In the body's axes: a vector that is given in inertial ones.
    pub fn local_vector(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        self.pose.rotation.transpose() * vector
    }

    /// The body after a small displacement.
    pub fn displaced(&self, by: &Twist) -> Self {
        let orientation = self.orientation.displaced(&by.angular);
        Self {
            orientation,
            pose: Pose {
                position: self.pose.position + by.linear,
                rotation: orientation.rotation(),
            },
            twist: self.twist,
        }
    }
}

/// The motion of all bodies at one instant.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Kinematics {
    /// The ground, then the bodies.
    pub bodies: Vec<BodyMotion>,
    /// In space the angles of the revolute joints, with full turns (rad), by the place of the joint; 0 for others.
    pub angles: Vec<f64>,
}
