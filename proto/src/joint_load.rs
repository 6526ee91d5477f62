//! The conditions of joints, and the load that a multiplier puts on the markers at the ends of its joint.
//!
//! `r`: position of a marker (m), `T`: rotation from its axes to inertial ones, `p = r + T s` with the joint's point `s`
//! in the axes of the marker, `e = T axis`. Each law is one scalar condition `g` (S1 Sect. 3.2):
//!
//! | law | condition | load on a: force, moment about marker a | load on b |
//! |---|---|---|---|
//! | atpoint, eqs. (29), (30) | `(p_a - p_b) . d` | `d`, `T_a s_a x d` | `-d`, `-T_b s_b x d` |
//! | inplane, eqs. (38), (39) | `(p_a - p_b) . e_b` | `e_b`, `T_a s_a x e_b` | `-e_b`, `-(p_a - r_b) x e_b` |
//! | perpendicular, eqs. (47), (48) | `e_a . e_b` | 0, `e_a x e_b` | 0, `e_b x e_a` |
//!
//! All per unit of the multiplier, in inertial axes: the derivative of `g` with respect to a translation and a rotation of
//! the marker. So the ideal joint does no work, and forces and moments of the two ends cancel.

mod condition;
mod message;

pub use condition::Marker;
pub use message::JointLoadError;

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

/// Position and orientation of a marker.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Position (m), in inertial axes.
    pub position: Vector3<f64>,
    /// From the marker's axes to inertial ones.
    pub rotation: Matrix3<f64>,
}

/// A small change of a [`Pose`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Displacement {
    /// Of the position (m).
    pub position: Vector3<f64>,
    /// Rotation vector in inertial axes (rad).
    pub rotation: Vector3<f64>,
}

/// Force (N) and moment about the marker (N m), in inertial axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench {
    /// Force.
    pub force: Vector3<f64>,
    /// Moment.
    pub moment: Vector3<f64>,
}

/// One of the two markers of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The first one.
    A,
    /// The second one.
    B,
}

/// What a condition says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// The points of both markers have the same component along a fixed direction.
    AtPoint {
        /// Unit vector in inertial axes.
        direction: Vector3<f64>,
    },
    /// The point of marker a lies in a plane through that of marker b.
    InPlane {
        /// Unit normal of the plane in the axes of marker b.
        normal: Vector3<f64>,
    },
    /// Two axes are at right angles.
    Perpendicular {
        /// Unit vectors in the axes of markers a and b.
        axes: [Vector3<f64>; 2],
    },
}

/// The law of one multiplier between two markers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointLaw {
    /// Which condition.
    pub law: Law,
    /// Point of the joint in the axes of markers a and b (m).
    pub points: [Vector3<f64>; 2],
}

/// What something depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Reads {
    /// The position of a marker.
    pub position: bool,
    /// Its orientation.
    pub rotation: bool,
}

/// What a load consists of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Acts {
    /// It has a force.
    pub force: bool,
    /// It has a moment about the marker.
    pub moment: bool,
}

impl Pose {
    /// A marker in the plane; the angle (rad) turns about the third axis.
    pub fn planar(x: f64, y: f64, angle: f64) -> Self {
        Self {
            position: Vector3::new(x, y, 0.0),
            rotation: Rotation3::from_axis_angle(&Vector3::z_axis(), angle).into_inner(),
        }
    }

    /// A marker in space; the quaternion `(w, x, y, z)` turns from its axes to inertial ones, its length does not count.
    pub fn spatial(position: Vector3<f64>, [w, x, y, z]: [f64; 4]) -> Self {
        let attitude = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        Self {
            position,
            rotation: attitude.to_rotation_matrix().into_inner(),
        }
    }

    /// The same marker after a further turn by a rotation vector in inertial axes.
    pub fn turned(&self, rotation: &Vector3<f64>) -> Self {
        Self {
            position: self.position,
            rotation: Rotation3::new(*rotation).into_inner() * self.rotation,
        }
    }
}

impl Default for Pose {
    /// At the origin, parallel to the inertial axes.
    fn default() -> Self {
        Self {
            position: Vector3::zeros(),
            rotation: Matrix3::identity(),
        }
    }
}

impl Wrench {
    /// Component 0, 1, 2 of the force or 3, 4, 5 of the moment.
    ///
    /// # Panics
    /// If there is no such component.
    pub fn component(&self, component: usize) -> f64 {
        match component {
            0..3 => self.force[component],
            _ => self.moment[component - 3],
        }
    }
}

impl End {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::A, Self::B];

    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::A => Self::B,
            Self::B => Self::A,
        }
    }
}

impl JointLaw {
    /// What the load on the marker at `end` depends on of the marker at `of`.
    pub fn load_reads(&self, end: End, of: End) -> Reads {
        let is_offset = |end: End| self.points[end as usize] != Vector3::zeros();
        let (position, rotation) = match (self.law, end, of) {
            (Law::AtPoint { .. }, ..) => (false, end == of && is_offset(of)),
            (Law::InPlane { .. }, End::A, End::A) => (false, is_offset(End::A)),
            (Law::InPlane { .. }, End::A, End::B) => (false, true),
            (Law::InPlane { .. }, End::B, End::A) => (true, is_offset(End::A)),
            (Law::InPlane { .. }, End::B, End::B) => (true, true),
            (Law::Perpendicular { .. }, ..) => (false, true),
        };
        Reads { position, rotation }
    }

    /// Whether the load on the marker at `end` has a force and a moment; otherwise they are zero.
    pub fn acts_by(&self, end: End) -> Acts {
        let is_offset = self.points[end as usize] != Vector3::zeros();
        match self.law {
            Law::AtPoint { .. } => Acts {
                force: true,
                moment: is_offset,
            },
            Law::InPlane { .. } => Acts {
                force: true,
                moment: end == End::B || is_offset,
            },
            Law::Perpendicular { .. } => Acts {
                force: false,
                moment: true,
            },
        }
    }

    /// What the condition depends on of the marker at `of`.
    pub fn condition_reads(&self, of: End) -> Reads {
        let is_offset = self.points[of as usize] != Vector3::zeros();
        let (position, rotation) = match (self.law, of) {
            (Law::AtPoint { .. }, _) | (Law::InPlane { .. }, End::A) => (true, is_offset),
            (Law::InPlane { .. }, End::B) => (true, true),
            (Law::Perpendicular { .. }, _) => (false, true),
        };
        Reads { position, rotation }
    }

    /// Load on the marker at `end` for a multiplier of 1. Of `poses` (a, b) only what [`JointLaw::load_reads`] tells
    /// counts.
    pub fn unit_wrench(&self, end: End, poses: &[Pose; 2]) -> Wrench {
        let Arms { force, arm } = self.arms(end, poses);
        self.wrench(force, arm.cross(&force))
    }

    /// Change of [`JointLaw::unit_wrench`] under small displacements of both markers.
    pub fn unit_wrench_change(
        &self,
        end: End,
        poses: &[Pose; 2],
        moved: &[Displacement; 2],
    ) -> Wrench {
        let Arms { force, arm } = self.arms(end, poses);
        let [rotated_a, rotated_b] = moved.map(|moved| moved.rotation);
        let own = moved[end as usize].rotation;
        let (force_change, arm_change) = match (self.law, end) {
            (Law::AtPoint { .. }, _) => (Vector3::zeros(), own.cross(&arm)),
            (Law::InPlane { .. }, End::A) => (rotated_b.cross(&force), own.cross(&arm)),
            (Law::InPlane { .. }, End::B) => {
                let point = poses[0].carried(&self.points[0]);
                let moved_point = moved[0].position + rotated_a.cross(&point);
                (rotated_b.cross(&force), moved_point - moved[1].position)
            }
            (Law::Perpendicular { .. }, _) => {
                let other = moved[end.other() as usize].rotation;
                (other.cross(&force), own.cross(&arm))
            }
        };
        let moment = arm_change.cross(&force) + arm.cross(&force_change);
        self.wrench(force_change, moment)
    }

    /// The perpendicular law has no force: the one that its moment is made of is an axis.
    fn wrench(&self, force: Vector3<f64>, moment: Vector3<f64>) -> Wrench {
        let force = match self.law {
            Law::AtPoint { .. } | Law::InPlane { .. } => force,
            Law::Perpendicular { .. } => Vector3::zeros(),
        };
        Wrench { force, moment }
    }

    /// The two factors of the moment `arm x force`; of the perpendicular law they are the own axis and the other one.
    fn arms(&self, end: End, poses: &[Pose; 2]) -> Arms {
        let [a, b] = poses;
        let sign = match end {
            End::A => 1.0,
            End::B => -1.0,
        };
        let own_arm = poses[end as usize].carried(&self.points[end as usize]);
        match (self.law, end) {
            (Law::AtPoint { direction }, _) => Arms {
                force: sign * direction,
                arm: own_arm,
            },
            (Law::InPlane { normal }, End::A) => Arms {
                force: b.carried(&normal),
                arm: own_arm,
            },
            (Law::InPlane { normal }, End::B) => Arms {
                force: -b.carried(&normal),
                arm: a.point(&self.points[0]) - b.position,
            },
            (Law::Perpendicular { axes }, _) => {
                let axis = |end: End| poses[end as usize].carried(&axes[end as usize]);
                Arms {
                    force: axis(end.other()),
                    arm: axis(end),
                }
            }
        }
    }
}

struct Arms {
    force: Vector3<f64>,
    arm: Vector3<f64>,
}

#[cfg(test)]
mod tests;
