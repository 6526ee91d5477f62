//! Joints put together from the fundamental ones (S1 Sect. 3.2).
//!
//! | joint | in space | in the plane |
//! |---|---|---|
//! | atpoint | 3 atpoint | 2 atpoint |
//! | inplane | 1 inplane | 1 inplane |
//! | perpendicular | 1 perpendicular | 1 perpendicular |
//! | universal | 3 atpoint, 1 perpendicular | |
//! | revolute | 3 atpoint, 2 perpendicular | 2 atpoint |
//! | cylindrical | 2 inplane, 2 perpendicular | |
//! | planar | 1 inplane, 2 perpendicular | |
//! | inline | 2 inplane | 1 inplane |
//! | orientation | 3 perpendicular | 1 perpendicular |
//! | translational | 2 inplane, 3 perpendicular | 1 inplane, 1 perpendicular |
//! | weld | 3 atpoint, 3 perpendicular | 2 atpoint, 1 perpendicular |

use nalgebra::{Rotation2, UnitQuaternion, Vector3};

use super::{AtPoint, Condition, InPlane, Joint, Perpendicular, RigidLink};

/// Which joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Scalar markers keep together.
    RigidLink,
    /// Two points coincide.
    AtPoint,
    /// A point of a stays in a plane of b.
    InPlane,
    /// An axis of a and one of b stay at right angles.
    Perpendicular,
    /// Two points coincide and two axes stay at right angles.
    Universal,
    /// Two points and two axes coincide.
    Revolute,
    /// Two axes coincide; a turns about it and slides along it.
    Cylindrical,
    /// A point of a stays in a plane of b and its axis along the normal.
    Planar,
    /// A point of a stays on an axis of b.
    Inline,
    /// The attitude of a relative to b stays.
    Orientation,
    /// Attitude as in orientation; a point of a stays on an axis of b.
    Translational,
    /// Two points coincide and the attitude of a relative to b stays.
    Weld,
}

/// Where a joint in space holds: points (m) and axes in the axes of the two markers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Points of the joint.
    pub points: [Vector3<f64>; 2],
    /// Unit axes of the joint.
    pub axes: [Vector3<f64>; 2],
    /// Attitude of marker a in the axes of marker b that an orientation joint keeps.
    pub attitude: UnitQuaternion<f64>,
}

/// Where a joint in the plane holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanarFrame {
    /// Points of the joint (m), in the axes of the markers; third components are 0.
    pub points: [Vector3<f64>; 2],
    /// Unit axes; third components are 0.
    pub axes: [Vector3<f64>; 2],
    /// Angle of marker a minus that of marker b (rad) that an orientation joint keeps.
    pub angle: f64,
}

/// The link between scalar markers.
pub fn link() -> Joint {
    Joint::new(
        vec![("", Box::new(RigidLink) as Box<dyn Condition>)],
        Vec::new(),
    )
}

/// A joint between markers in space; `None` for [`Kind::RigidLink`], which holds scalar markers.
pub fn in_space(kind: Kind, frame: &Frame) -> Option<Joint> {
    let parts: &[Part] = match kind {
        Kind::RigidLink => return None,
        Kind::AtPoint => &[Part::AtPoint],
        Kind::InPlane => &[Part::InPlane],
        Kind::Perpendicular => &[Part::Perpendicular],
        Kind::Universal => &[Part::AtPoint, Part::Perpendicular],
        Kind::Revolute => &[Part::AtPoint, Part::Parallel],
        Kind::Cylindrical => &[Part::OnLine, Part::Parallel],
        Kind::Planar => &[Part::InPlane, Part::Parallel],
        Kind::Inline => &[Part::OnLine],
        Kind::Orientation => &[Part::Attitude],
        Kind::Translational => &[Part::OnLine, Part::Attitude],
        Kind::Weld => &[Part::AtPoint, Part::Attitude],
    };
    let mut rows = Vec::new();
    let mut aligned = Vec::new();
    for part in parts {
        part.add(frame, &mut rows, &mut aligned);
    }
    Some(Joint::new(name_apart(rows), aligned))
}

/// A joint between markers in the plane; `None` for kinds that need space.
pub fn in_plane(kind: Kind, frame: &PlanarFrame) -> Option<Joint> {
    let PlanarFrame {
        points,
        axes,
        angle,
    } = *frame;
    let hinge = || {
        let directions = [("x", Vector3::x()), ("y", Vector3::y())];
        directions.map(|(name, direction)| row(name, AtPoint::new(points, direction)))
    };
    let locked = turned(&Vector3::x(), angle);
    let lock = || {
        let axes = [Vector3::x(), turned(&Vector3::y(), angle)];
        row("perpendicular", Perpendicular::new(axes))
    };
    let rail = || {
        let normal = turned(&axes[1], std::f64::consts::FRAC_PI_2);
        row("inplane", InPlane::new(points, normal))
    };
    let aligned = vec![[Vector3::x(), locked]];
    let (rows, aligned) = match kind {
        Kind::AtPoint | Kind::Revolute => (hinge().into(), Vec::new()),
        Kind::InPlane => (vec![row("", InPlane::new(points, axes[1]))], Vec::new()),
        Kind::Perpendicular => (vec![row("", Perpendicular::new(axes))], Vec::new()),
        Kind::Inline => (vec![rail()], Vec::new()),
        Kind::Orientation => (vec![lock()], aligned),
        Kind::Translational => (vec![rail(), lock()], aligned),
        Kind::Weld => (hinge().into_iter().chain([lock()]).collect(), aligned),
        Kind::RigidLink | Kind::Universal | Kind::Cylindrical | Kind::Planar => return None,
    };
    Some(Joint::new(name_apart(rows), aligned))
}

type NamedRow = (&'static str, Box<dyn Condition>);

fn row(name: &'static str, condition: impl Condition + 'static) -> NamedRow {
    (name, Box::new(condition))
}

/// A single row needs no name.
fn name_apart(mut rows: Vec<NamedRow>) -> Vec<NamedRow> {
    if let [(name, _)] = &mut rows[..] {
        *name = "";
    }
    rows
}

fn turned(axis: &Vector3<f64>, angle: f64) -> Vector3<f64> {
    let turned = Rotation2::new(angle) * axis.xy();
    Vector3::new(turned.x, turned.y, 0.0)
}

/// Part of a joint in space.
#[derive(Debug, Clone, Copy)]
enum Part {
    /// Points coincide.
    AtPoint,
    /// Point of a in the plane through the point of b normal to its axis.
    InPlane,
    /// Point of a on the axis of b.
    OnLine,
    /// Axes at right angles.
    Perpendicular,
    /// Axes parallel.
    Parallel,
    /// Attitude fixed.
    Attitude,
}

impl Part {
    fn add(self, frame: &Frame, rows: &mut Vec<NamedRow>, aligned: &mut Vec<[Vector3<f64>; 2]>) {
        let Frame {
            points,
            axes,
            attitude,
        } = *frame;
        let across = across(&axes[1]);
        match self {
            Self::AtPoint => {
                let directions = [
                    ("x", Vector3::x()),
                    ("y", Vector3::y()),
                    ("z", Vector3::z()),
                ];
                rows.extend(
                    directions.map(|(name, direction)| row(name, AtPoint::new(points, direction))),
                );
            }
            Self::InPlane => rows.push(row("inplane", InPlane::new(points, axes[1]))),
            Self::OnLine => {
                let [first, second] = across;
                rows.push(row("inplane1", InPlane::new(points, first)));
                rows.push(row("inplane2", InPlane::new(points, second)));
            }
            Self::Perpendicular => rows.push(row("perpendicular", Perpendicular::new(axes))),
            Self::Parallel => {
                let [first, second] = across.map(|across| Perpendicular::new([axes[0], across]));
                rows.push(row("perpendicular1", first));
                rows.push(row("perpendicular2", second));
                aligned.push(axes);
            }
            Self::Attitude => {
                let own = [Vector3::x(), Vector3::y(), Vector3::z()];
                let kept = own.map(|axis| attitude * axis);
                let names = ["perpendicular1", "perpendicular2", "perpendicular3"];
                for (place, name) in names.into_iter().enumerate() {
                    let axes = [own[place], kept[(place + 1) % 3]];
                    rows.push(row(name, Perpendicular::new(axes)));
                    aligned.push([own[place], kept[place]]);
                }
            }
        }
    }
}

/// Two unit vectors that form a right-handed system with `axis`: first, second, axis.
fn across(axis: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let mut farthest = Vector3::zeros();
    farthest[axis.iamin()] = 1.0;
    let first = farthest.cross(axis).normalize();
    [first, axis.cross(&first)]
}
