//! Motion in the plane and in space.
//!
//! Both are computed with vectors of three components: in the plane the third component of every position and force is
//! 0, and every angular velocity and moment points along the third axis. They differ in how the state of a body is kept.

use linchpin_proto::joint_load::{Pose, Wrench};
use nalgebra::{Matrix3, Quaternion, Vector3};

use super::kinematics::{BodyMotion, Orientation, Twist};
use crate::mechanics::markers::{Form, PLANAR, SPATIAL};
use crate::mechanics::spatial::real_first;

/// In the plane or in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// A body has the coordinates `x, y, angle`.
    Plane,
    /// A body has the coordinates `x, y, z` and a unit quaternion `w, x, y, z`.
    Space,
}

impl Dimension {
    /// Number of components of a vector in a scene.
    pub const fn components(self) -> usize {
        match self {
            Self::Plane => 2,
            Self::Space => 3,
        }
    }

    /// Coordinates of a free body.
    pub const fn coordinates(self) -> usize {
        match self {
            Self::Plane => 3,
            Self::Space => 7,
        }
    }

    /// Speeds of a free body: velocity of the centre of mass and angular velocity, in inertial axes.
    pub const fn speeds(self) -> usize {
        match self {
            Self::Plane => 3,
            Self::Space => 6,
        }
    }

    /// Names of what belongs to a marker.
    pub const fn form(self) -> &'static Form {
        match self {
            Self::Plane => &PLANAR,
            Self::Space => &SPATIAL,
        }
    }

    /// Components of a load.
    pub const fn load_components(self) -> usize {
        self.speeds()
    }

    /// Unit vectors along which a point can move.
    pub fn directions(self) -> &'static [Vector3<f64>] {
        const DIRECTIONS: [Vector3<f64>; 3] = [
            Vector3::new(1.0, 0.0, 0.0),
            Vector3::new(0.0, 1.0, 0.0),
            Vector3::new(0.0, 0.0, 1.0),
        ];
        &DIRECTIONS[..self.components()]
    }

    /// No turn.
    pub fn unturned(self) -> Orientation {
        match self {
            Self::Plane => Orientation::Angle(0.0),
            Self::Space => Orientation::Attitude(Quaternion::identity()),
        }
    }

    /// The ground: at rest at the origin.
    pub fn ground(self) -> BodyMotion {
        BodyMotion {
            orientation: self.unturned(),
            pose: Pose::default(),
            twist: Twist::ZERO,
        }
    }

    /// Motion of a free body from its coordinates and speeds.
    pub fn motion(self, coordinates: &[f64], speeds: &[f64]) -> BodyMotion {
        let (position, orientation) = match self {
            Self::Plane => (
                Vector3::new(coordinates[0], coordinates[1], 0.0),
                Orientation::Angle(coordinates[2]),
            ),
            Self::Space => (
                Vector3::from_column_slice(&coordinates[..3]),
                Orientation::from_parts(&coordinates[3..7]),
            ),
        };
        BodyMotion {
            orientation,
            pose: Pose {
                position,
                rotation: orientation.rotation(),
            },
            twist: self.twist(speeds),
        }
    }

    /// Twist from speeds, or its rate from their rates.
    pub fn twist(self, speeds: &[f64]) -> Twist {
        match self {
            Self::Plane => Twist {
                linear: Vector3::new(speeds[0], speeds[1], 0.0),
                angular: Vector3::new(0.0, 0.0, speeds[2]),
            },
            Self::Space => Twist {
                linear: Vector3::from_column_slice(&speeds[..3]),
                angular: Vector3::from_column_slice(&speeds[3..6]),
            },
        }
    }

    /// Writes the speeds of a twist.
    pub fn put_twist(self, twist: &Twist, speeds: &mut [f64]) {
        let Twist { linear, angular } = twist;
        match self {
            Self::Plane => speeds.copy_from_slice(&[linear.x, linear.y, angular.z]),
            Self::Space => {
                speeds[..3].copy_from_slice(linear.as_slice());
                speeds[3..].copy_from_slice(angular.as_slice());
            }
        }
    }

    /// One component of a twist, in the order of the speeds.
    pub fn component(self, twist: &Twist, component: usize) -> f64 {
        match (self, component) {
            (Self::Plane, 2) => twist.angular.z,
            (_, 0..3) => twist.linear[component],
            _ => twist.angular[component - 3],
        }
    }

    /// Writes the coordinates of a motion.
    pub fn put_position(self, motion: &BodyMotion, coordinates: &mut [f64]) {
        let position = motion.pose.position;
        coordinates[..self.components()].copy_from_slice(&position.as_slice()[..self.components()]);
        motion
            .orientation
            .put(&mut coordinates[self.components()..]);
    }

    /// Writes the rates of the coordinates.
    pub fn put_position_rate(self, motion: &BodyMotion, rates: &mut [f64]) {
        let Twist { linear, angular } = motion.twist;
        rates[..self.components()].copy_from_slice(&linear.as_slice()[..self.components()]);
        let rest = &mut rates[self.components()..];
        match motion.orientation {
            Orientation::Angle(_) => rest[0] = angular.z,
            Orientation::Attitude(attitude) => {
                let rate = Quaternion::from_imag(0.5 * angular) * attitude;
                rest.copy_from_slice(real_first(&rate).as_slice());
            }
        }
    }

    /// Load at a marker from its inputs.
    pub fn load(self, inputs: &[f64]) -> Wrench {
        let Twist { linear, angular } = self.twist(inputs);
        Wrench {
            force: linear,
            moment: angular,
        }
    }

    /// Inertia in the body's axes. In the plane only the turn about the third axis counts.
    pub fn inertia(self, moments: &[f64]) -> Matrix3<f64> {
        match *moments {
            [a, b, c] => Matrix3::from_diagonal(&Vector3::new(a, b, c)),
            _ => Matrix3::identity() * moments.first().copied().unwrap_or_default(),
        }
    }
}
