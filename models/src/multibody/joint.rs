//! Joints inside a composition.
//!
//! Conditions of the kinds; `p`: the joint's point, `e`: its axis, fixed in both bodies unless told otherwise:
//!
//! | kind | plane | space |
//! |---|---|---|
//! | revolute | p_a = p_b | p_a = p_b, e_a = e_b |
//! | prismatic | p_a - p_b along e, no turn | the same |
//! | inline | p_a - p_b along e, which b holds | the same |
//! | weld | p_a = p_b, no turn | the same |
//! | spherical | | p_a = p_b |
//! | universal | | p_a = p_b, the axis of a at right angles to that of b |

use std::f64::consts::TAU;

use linchpin_proto::joint_load::{JointLaw, Law};
use linchpin_worker::setup::SetupError;
use nalgebra::Vector3;

use super::body::{self, Body};
use super::condition::{Condition, Drive};
use super::dimension::Dimension;
use super::entries::{Entries, Entry};
use super::error::CompositionError;
use super::kinematics::{BodyMotion, Orientation};
use super::motion::{Coordinate, Course};

/// What a joint leaves free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// A turn about an axis.
    Revolute,
    /// A translation along an axis.
    Prismatic,
    /// A translation along an axis of b, and all turns.
    Inline,
    /// Nothing.
    Weld,
    /// All turns.
    Spherical,
    /// Turns about an axis of a and an axis of b.
    Universal,
}

const PLANAR_KINDS: [(&str, JointKind); 4] = [
    ("revolute", JointKind::Revolute),
    ("prismatic", JointKind::Prismatic),
    ("inline", JointKind::Inline),
    ("weld", JointKind::Weld),
];
const SPATIAL_KINDS: [(&str, JointKind); 6] = [
    ("revolute", JointKind::Revolute),
    ("prismatic", JointKind::Prismatic),
    ("inline", JointKind::Inline),
    ("weld", JointKind::Weld),
    ("spherical", JointKind::Spherical),
    ("universal", JointKind::Universal),
];

/// One joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Its place among the parameters.
    pub place: String,
    /// What it leaves free.
    pub kind: JointKind,
    /// Places of bodies a and b.
    pub bodies: [usize; 2],
    /// The joint's point in the axes of a and b, from their centres of mass (m).
    pub points: [Vector3<f64>; 2],
    /// The joint's axes, of a in the axes of a and of b in those of b. One direction at the start, but for a universal
    /// joint.
    pub axes: [Vector3<f64>; 2],
    /// Unit vectors in the axes of a and b that are one direction at right angles to the axis of a at the start.
    across: [Vector3<f64>; 2],
    dimension: Dimension,
}

impl JointKind {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        let named = SPATIAL_KINDS.iter().find(|(_, kind)| *kind == self);
        named.map_or("", |(name, _)| name)
    }
}

/// All joints of a composition, in the order of their names.
///
/// # Errors
/// [`SetupError`]: a body that is not there, a value that is missing or out of its range.
pub fn read(
    entries: &Entries<'_>,
    bodies: &[Body],
    dimension: Dimension,
) -> Result<Vec<Joint>, SetupError> {
    let joints = entries.of("joint");
    joints
        .map(|entry| Joint::read(&entry, bodies, dimension))
        .collect()
}

impl Joint {
    fn read(entry: &Entry<'_>, bodies: &[Body], dimension: Dimension) -> Result<Self, SetupError> {
        let kinds: &[_] = match dimension {
            Dimension::Plane => &PLANAR_KINDS,
            Dimension::Space => &SPATIAL_KINDS,
        };
        let kind = entry.choice("kind", kinds)?;
        let pair = body::pair(entry, bodies)?;
        let mut allowed = vec!["kind", "a", "b", "point", "point_a", "point_b"];
        allowed.extend(axis_keys(kind, dimension));
        entry.allow_only(&allowed)?;
        let starts = pair.map(|place| &bodies[place].start);
        let [axis, second] = read_axes(entry, kind, dimension)?;
        let across = perpendicular(&axis);
        Ok(Self {
            name: entry.name.to_owned(),
            place: entry.place(),
            kind,
            bodies: pair,
            points: read_points(entry, starts)?,
            axes: [
                starts[0].local_vector(&axis),
                starts[1].local_vector(&second),
            ],
            across: starts.map(|start| start.local_vector(&across)),
            dimension,
        })
    }

    /// Refuses a joint of another kind.
    pub fn require(
        &self,
        entry: &Entry<'_>,
        kinds: &[JointKind],
        allowed: &'static str,
    ) -> Result<(), SetupError> {
        if kinds.contains(&self.kind) {
            return Ok(());
        }
        let error = CompositionError::WrongJoint {
            field: entry.field("joint"),
            joint: self.name.clone(),
            kind: self.kind.name(),
            allowed,
        };
        Err(error.into())
    }

    /// Angle or displacement at the start.
    pub fn start_coordinate(&self, bodies: &[Body]) -> f64 {
        let motions = self.bodies.map(|place| &bodies[place].start);
        match (self.kind, self.dimension) {
            (JointKind::Revolute, Dimension::Space) => 0.0,
            _ => self.coordinate(motions, 0.0).value,
        }
    }

    /// Of a revolute joint the angle of b from a about the axis (in space it is `angle`), of a prismatic one the
    /// displacement of b from a along the axis; with its rate.
    pub fn coordinate(&self, [a, b]: [&BodyMotion; 2], angle: f64) -> Coordinate {
        let axis = a.arm(&self.axes[0]);
        let turning = b.twist.angular - a.twist.angular;
        let mut coordinate = Coordinate {
            value: angle,
            rate: turning.dot(&axis),
            acceleration: 0.0,
        };
        if self.kind == JointKind::Prismatic {
            let along = b.point(&self.points[1]) - a.point(&self.points[0]);
            let moving = b.velocity(&self.points[1]) - a.velocity(&self.points[0]);
            coordinate.value = along.dot(&axis);
            coordinate.rate = moving.dot(&axis) + along.dot(&a.twist.angular.cross(&axis));
        } else if let Orientation::Angle(angle) = a.orientation.to(&b.orientation) {
            coordinate.value = angle;
        }
        coordinate
    }

    /// The angle of a revolute joint in space, next to `near`: orientations do not tell full turns apart.
    pub fn angle_near(&self, [a, b]: [&BodyMotion; 2], near: f64) -> f64 {
        let axis = a.arm(&self.axes[0]);
        let [from, to] = [a.arm(&self.across[0]), b.arm(&self.across[1])];
        let angle = axis.dot(&from.cross(&to)).atan2(from.dot(&to));
        angle + TAU * ((near - angle) / TAU).round()
    }

    /// The conditions of the joint, without that of a prescribed motion.
    pub fn conditions(&self, bodies: &[Body]) -> Vec<Condition> {
        let starts = self.bodies.map(|place| &bodies[place].start);
        let [a, b] = self.axes;
        let across = self.across[1];
        let laws = match self.kind {
            JointKind::Revolute if self.dimension == Dimension::Plane => self.at_point(),
            JointKind::Revolute => {
                let mut laws = self.at_point();
                laws.push(perpendicular_law(a, across));
                laws.push(perpendicular_law(a, b.cross(&across)));
                laws
            }
            JointKind::Spherical => self.at_point(),
            JointKind::Universal => {
                let mut laws = self.at_point();
                laws.push(perpendicular_law(a, b));
                laws
            }
            JointKind::Weld => [self.at_point(), self.no_turn(starts)].concat(),
            JointKind::Prismatic => [self.in_line(), self.no_turn(starts)].concat(),
            JointKind::Inline => self.in_line(),
        };
        let conditions = laws.into_iter().map(|law| self.condition(law, Drive::None));
        conditions.collect()
    }

    /// The condition of a prescribed angle or displacement.
    pub fn driven(&self, course: Course, bodies: &[Body]) -> Condition {
        let start = self.start_coordinate(bodies);
        if self.kind == JointKind::Prismatic {
            let along = Law::InPlane {
                normal: self.axes[1],
            };
            return self.condition(along, Drive::Shift { course, sign: 1.0 });
        }
        // Its derivative with respect to the angle is 1 at the start and wherever the condition holds.
        let law = Law::Perpendicular {
            axes: [self.axes[0].cross(&self.across[0]), self.across[1]],
        };
        let axis = self.axes[0];
        self.condition(
            law,
            Drive::Turn {
                course,
                start,
                axis,
            },
        )
    }

    fn at_point(&self) -> Vec<Law> {
        let directions = self.dimension.directions().iter();
        let laws = directions.map(|&direction| Law::AtPoint { direction });
        laws.collect()
    }

    /// The joint's point on a stays on the axis of b.
    fn in_line(&self) -> Vec<Law> {
        let across = self.across[1];
        let normals = match self.dimension {
            Dimension::Plane => vec![across],
            Dimension::Space => vec![across, self.axes[1].cross(&across)],
        };
        let laws = normals.into_iter().map(|normal| Law::InPlane { normal });
        laws.collect()
    }

    fn no_turn(&self, starts: [&BodyMotion; 2]) -> Vec<Law> {
        let pairs: &[[usize; 2]] = match self.dimension {
            Dimension::Plane => &[[0, 1]],
            Dimension::Space => &[[0, 1], [1, 2], [2, 0]],
        };
        let units = [Vector3::x(), Vector3::y(), Vector3::z()];
        let laws = pairs.iter().map(|[own, other]| {
            let own = starts[0].local_vector(&units[*own]);
            perpendicular_law(own, starts[1].local_vector(&units[*other]))
        });
        laws.collect()
    }

    fn condition(&self, law: Law, drive: Drive) -> Condition {
        let points = match law {
            Law::Perpendicular { .. } => [Vector3::zeros(); 2],
            Law::AtPoint { .. } | Law::InPlane { .. } => self.points,
        };
        Condition {
            place: self.place.clone(),
            bodies: self.bodies,
            law: JointLaw { law, points },
            drive,
        }
    }
}

fn perpendicular_law(a: Vector3<f64>, b: Vector3<f64>) -> Law {
    Law::Perpendicular { axes: [a, b] }
}

/// A unit vector at right angles to a unit vector; in the plane if that lies in the plane.
fn perpendicular(axis: &Vector3<f64>) -> Vector3<f64> {
    let other = if axis.z.abs() < 0.7 {
        Vector3::z()
    } else {
        Vector3::x()
    };
    other.cross(axis).normalize()
}

fn axis_keys(kind: JointKind, dimension: Dimension) -> &'static [&'static str] {
    match (kind, dimension) {
        (JointKind::Prismatic | JointKind::Inline, _) | (JointKind::Revolute, Dimension::Space) => {
            &["axis"]
        }
        (JointKind::Universal, _) => &["axis", "second_axis"],
        _ => &[],
    }
}

/// The axes of a and b in inertial axes at the start. Joints without an axis get the third one, about which the plane
/// turns.
fn read_axes(
    entry: &Entry<'_>,
    kind: JointKind,
    dimension: Dimension,
) -> Result<[Vector3<f64>; 2], SetupError> {
    if axis_keys(kind, dimension).is_empty() {
        return Ok([Vector3::z(); 2]);
    }
    let axis = entry.direction("axis")?;
    if kind != JointKind::Universal {
        return Ok([axis; 2]);
    }
    let second = entry.direction("second_axis")?;
    let cosine = axis.dot(&second);
    if cosine.abs() > 1e-9 {
        let error = CompositionError::NotPerpendicular {
            field: entry.field("second_axis"),
            degrees: cosine.acos().to_degrees(),
        };
        return Err(error.into());
    }
    Ok([axis, second])
}

/// The joint's point in the axes of a and b.
fn read_points(
    entry: &Entry<'_>,
    starts: [&BodyMotion; 2],
) -> Result<[Vector3<f64>; 2], SetupError> {
    match ["point", "point_a", "point_b"].map(|key| entry.has(key)) {
        [true, false, false] => {
            let point = entry.vector("point")?;
            Ok(starts.map(|start| start.local_point(&point)))
        }
        [false, true, true] => Ok([entry.vector("point_a")?, entry.vector("point_b")?]),
        _ => {
            let field = entry.place();
            Err(CompositionError::Point { field }.into())
        }
    }
}
