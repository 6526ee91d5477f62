//! The load that a multiplier of a joint puts on the markers at its ends.
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

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use crate::v1;

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

/// A message that is no joint load.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JointLoadError {
    /// No law, or one that is not known.
    #[error("law {found} is unknown; known are 1 (atpoint), 2 (inplane) and 3 (perpendicular)")]
    Law {
        /// The number in the message.
        found: i32,
    },
    /// Neither end.
    #[error("end {found} is unknown; known are 1 (a) and 2 (b)")]
    End {
        /// The number in the message.
        found: i32,
    },
    /// Not three finite numbers.
    #[error("{field} must be three finite numbers")]
    Vector {
        /// Which field.
        field: &'static str,
    },
    /// Not of length 1.
    #[error("{field} has the length {length}; it must be a unit vector")]
    NotUnit {
        /// Which field.
        field: &'static str,
        /// Its length.
        length: f64,
    },
}

impl JointLoadError {
    /// Field of the message.
    pub fn field(&self) -> &'static str {
        match self {
            Self::Law { .. } => "law",
            Self::End { .. } => "end",
            Self::Vector { field } | Self::NotUnit { field, .. } => field,
        }
    }
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
    /// A law from the message of a load, with the end that it acts on.
    ///
    /// # Errors
    /// [`JointLoadError`]: unknown law or end, axes that are no unit vectors, numbers that are not finite.
    pub fn from_message(message: &v1::JointLoad) -> Result<(Self, End), JointLoadError> {
        let law = match message.law() {
            v1::JointLaw::Atpoint => Law::AtPoint {
                direction: unit("axis_a", &message.axis_a)?,
            },
            v1::JointLaw::Inplane => Law::InPlane {
                normal: unit("axis_b", &message.axis_b)?,
            },
            v1::JointLaw::Perpendicular => Law::Perpendicular {
                axes: [
                    unit("axis_a", &message.axis_a)?,
                    unit("axis_b", &message.axis_b)?,
                ],
            },
            v1::JointLaw::Unspecified => return Err(JointLoadError::Law { found: message.law }),
        };
        let end = match message.end() {
            v1::JointEnd::A => End::A,
            v1::JointEnd::B => End::B,
            v1::JointEnd::Unspecified => return Err(JointLoadError::End { found: message.end }),
        };
        let points = [
            vector("point_a", &message.point_a)?,
            vector("point_b", &message.point_b)?,
        ];
        Ok((Self { law, points }, end))
    }

    /// The message of the load on marker `marker` at `end`; the places of signals are left to the caller.
    pub fn to_message(&self, marker: &str, end: End) -> v1::JointLoad {
        let list = |vector: &Vector3<f64>| vector.as_slice().to_vec();
        let (law, axis_a, axis_b) = match &self.law {
            Law::AtPoint { direction } => (v1::JointLaw::Atpoint, list(direction), Vec::new()),
            Law::InPlane { normal } => (v1::JointLaw::Inplane, Vec::new(), list(normal)),
            Law::Perpendicular { axes: [a, b] } => (v1::JointLaw::Perpendicular, list(a), list(b)),
        };
        v1::JointLoad {
            marker: marker.to_owned(),
            law: law.into(),
            end: match end {
                End::A => v1::JointEnd::A,
                End::B => v1::JointEnd::B,
            }
            .into(),
            point_a: list(&self.points[0]),
            point_b: list(&self.points[1]),
            axis_a,
            axis_b,
            ..v1::JointLoad::default()
        }
    }

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
        match self.law {
            Law::AtPoint { .. } | Law::InPlane { .. } => Wrench {
                force,
                moment: arm.cross(&force),
            },
            Law::Perpendicular { .. } => Wrench {
                force: Vector3::zeros(),
                moment: arm.cross(&force),
            },
        }
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
                let point = poses[0].rotation * self.points[0];
                let moved_point = moved[0].position + rotated_a.cross(&point);
                (rotated_b.cross(&force), moved_point - moved[1].position)
            }
            (Law::Perpendicular { .. }, _) => {
                let other = moved[end.other() as usize].rotation;
                (other.cross(&force), own.cross(&arm))
            }
        };
        let moment = arm_change.cross(&force) + arm.cross(&force_change);
        match self.law {
            Law::AtPoint { .. } | Law::InPlane { .. } => Wrench {
                force: force_change,
                moment,
            },
            Law::Perpendicular { .. } => Wrench {
                force: Vector3::zeros(),
                moment,
            },
        }
    }

    /// The two factors of the moment `arm x force`; of the perpendicular law they are the own axis and the other one.
    fn arms(&self, end: End, poses: &[Pose; 2]) -> Arms {
        let [a, b] = poses;
        let sign = match end {
            End::A => 1.0,
            End::B => -1.0,
        };
        let own_arm = poses[end as usize].rotation * self.points[end as usize];
        match (self.law, end) {
            (Law::AtPoint { direction }, _) => Arms {
                force: sign * direction,
                arm: own_arm,
            },
            (Law::InPlane { normal }, End::A) => Arms {
                force: b.rotation * normal,
                arm: own_arm,
            },
            (Law::InPlane { normal }, End::B) => Arms {
                force: -(b.rotation * normal),
                arm: a.position + a.rotation * self.points[0] - b.position,
            },
            (Law::Perpendicular { axes }, _) => {
                let axis = |end: End| poses[end as usize].rotation * axes[end as usize];
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

fn vector(field: &'static str, values: &[f64]) -> Result<Vector3<f64>, JointLoadError> {
    match *values {
        [x, y, z] if values.iter().all(|value| value.is_finite()) => Ok(Vector3::new(x, y, z)),
        _ => Err(JointLoadError::Vector { field }),
    }
}

/// Lengths off 1 by less than this are rounding.
const UNIT_ROUNDING: f64 = 1e-9;

fn unit(field: &'static str, values: &[f64]) -> Result<Vector3<f64>, JointLoadError> {
    let vector = vector(field, values)?;
    let length = vector.norm();
    if (length - 1.0).abs() > UNIT_ROUNDING {
        return Err(JointLoadError::NotUnit { field, length });
    }
    Ok(vector)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laws() -> [JointLaw; 3] {
        let unit = |x: f64, y: f64, z: f64| Vector3::new(x, y, z).normalize();
        let points = [Vector3::new(0.3, -0.2, 0.5), Vector3::new(-0.1, 0.4, 0.7)];
        let laws = [
            Law::AtPoint {
                direction: unit(1.0, 2.0, -0.5),
            },
            Law::InPlane {
                normal: unit(0.3, -1.0, 0.8),
            },
            Law::Perpendicular {
                axes: [unit(1.0, 0.2, 0.1), unit(-0.4, 0.5, 1.0)],
            },
        ];
        laws.map(|law| JointLaw { law, points })
    }

    fn poses() -> [Pose; 2] {
        [
            Pose::spatial(Vector3::new(1.0, -2.0, 0.4), [0.3, 0.5, -0.2, 0.7]),
            Pose::spatial(Vector3::new(0.2, 0.6, -1.3), [-0.6, 0.1, 0.4, 0.2]),
        ]
    }

    /// The conditions once more, straight from S1.
    fn condition(law: &JointLaw, [a, b]: &[Pose; 2]) -> f64 {
        let point = |pose: &Pose, point: Vector3<f64>| pose.position + pose.rotation * point;
        let distance = point(a, law.points[0]) - point(b, law.points[1]);
        match law.law {
            Law::AtPoint { direction } => distance.dot(&direction),
            Law::InPlane { normal } => distance.dot(&(b.rotation * normal)),
            Law::Perpendicular { axes } => (a.rotation * axes[0]).dot(&(b.rotation * axes[1])),
        }
    }

    fn moved(poses: &[Pose; 2], by: &[Displacement; 2], scale: f64) -> [Pose; 2] {
        std::array::from_fn(|end| Pose {
            position: poses[end].position + scale * by[end].position,
            rotation: poses[end].turned(&(scale * by[end].rotation)).rotation,
        })
    }

    fn displacement() -> [Displacement; 2] {
        let vector = Vector3::new;
        [
            Displacement {
                position: vector(0.7, -0.3, 0.2),
                rotation: vector(-0.5, 0.1, 0.9),
            },
            Displacement {
                position: vector(-0.2, 0.8, 0.4),
                rotation: vector(0.6, 0.3, -0.4),
            },
        ]
    }

    #[test]
    fn loads_are_gradients_of_the_conditions() {
        for law in laws() {
            let step = 1e-6;
            let at = |scale| condition(&law, &moved(&poses(), &displacement(), scale));
            let difference = (at(step) - at(-step)) / (2.0 * step);
            let powers = End::BOTH.map(|end| {
                let wrench = law.unit_wrench(end, &poses());
                let moved = displacement()[end as usize];
                wrench.force.dot(&moved.position) + wrench.moment.dot(&moved.rotation)
            });
            let missing = difference - powers[0] - powers[1];
            assert!(missing.abs() < 1e-8, "{law:?}: {missing}");
        }
    }

    #[test]
    fn forces_and_moments_of_the_ends_cancel() {
        for law in laws() {
            let [a, b] = End::BOTH.map(|end| law.unit_wrench(end, &poses()));
            assert!((a.force + b.force).norm() < 1e-14);
            let about_origin =
                |wrench: &Wrench, pose: &Pose| wrench.moment + pose.position.cross(&wrench.force);
            let [pose_a, pose_b] = poses();
            let sum = about_origin(&a, &pose_a) + about_origin(&b, &pose_b);
            let [p_a, p_b] = [(&pose_a, 0), (&pose_b, 1)]
                .map(|(pose, end)| pose.position + pose.rotation * law.points[end]);
            // Where the points are apart, the forces of the atpoint law form a couple.
            let couple = match law.law {
                Law::AtPoint { .. } => (p_a - p_b).cross(&a.force),
                _ => Vector3::zeros(),
            };
            assert!((sum - couple).norm() < 1e-14, "{law:?}: {sum}");
        }
    }

    #[test]
    fn changes_of_loads_are_their_differences() {
        for law in laws() {
            for end in End::BOTH {
                let step = 1e-6;
                let at = |scale| law.unit_wrench(end, &moved(&poses(), &displacement(), scale));
                let (low, high) = (at(-step), at(step));
                let change = law.unit_wrench_change(end, &poses(), &displacement());
                let force = (high.force - low.force) / (2.0 * step) - change.force;
                let moment = (high.moment - low.moment) / (2.0 * step) - change.moment;
                assert!(
                    force.norm() < 1e-8 && moment.norm() < 1e-8,
                    "{law:?} {end:?}"
                );
            }
        }
    }

    #[test]
    fn loads_depend_on_what_they_say() {
        for law in laws() {
            for end in End::BOTH {
                for of in End::BOTH {
                    let only = |position: bool, rotation: bool| {
                        let mut by = [Displacement {
                            position: Vector3::zeros(),
                            rotation: Vector3::zeros(),
                        }; 2];
                        let own = displacement()[of as usize];
                        by[of as usize] = Displacement {
                            position: if position {
                                own.position
                            } else {
                                Vector3::zeros()
                            },
                            rotation: if rotation {
                                own.rotation
                            } else {
                                Vector3::zeros()
                            },
                        };
                        let change = law.unit_wrench_change(end, &poses(), &by);
                        change.force.norm() + change.moment.norm() > 1e-9
                    };
                    let reads = law.load_reads(end, of);
                    assert_eq!(reads.position, only(true, false), "{law:?} {end:?} {of:?}");
                    assert_eq!(reads.rotation, only(false, true), "{law:?} {end:?} {of:?}");
                }
                let wrench = law.unit_wrench(end, &poses());
                let acts = law.acts_by(end);
                assert_eq!(acts.force, wrench.force.norm() > 0.0);
                assert_eq!(acts.moment, wrench.moment.norm() > 0.0);
            }
        }
    }

    #[test]
    fn messages_come_back_and_mistakes_are_named() {
        for law in laws() {
            let message = law.to_message("tip", End::B);
            assert_eq!(JointLaw::from_message(&message), Ok((law, End::B)));
        }
        let mistake = |change: fn(&mut v1::JointLoad)| {
            let mut message = laws()[2].to_message("tip", End::A);
            change(&mut message);
            JointLaw::from_message(&message).unwrap_err().to_string()
        };
        assert!(mistake(|load| load.law = 7).contains("law 7"));
        assert!(mistake(|load| load.end = 0).contains("end 0"));
        assert!(mistake(|load| load.point_b.clear()).contains("point_b"));
        assert!(mistake(|load| load.axis_a = vec![f64::NAN, 0.0, 0.0]).contains("axis_a"));
        assert!(mistake(|load| load.axis_b = vec![2.0, 0.0, 0.0]).contains("length 2"));
    }
}
