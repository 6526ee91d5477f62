//! Joints in space as successive turns and slides.

use nalgebra::{Unit, UnitQuaternion, UnitVector3, Vector3};

use super::ReferenceError;
use super::ranges::all_finite;

/// One coordinate of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Freedom {
    /// A turn by the coordinate (rad) about this axis.
    Turn(UnitVector3<f64>),
    /// A slide by the coordinate (m) along this axis.
    Slide(UnitVector3<f64>),
}

/// The joint between a body and the one before it, or the ground.
///
/// The frame of the inner body is carried to `inner_point`, moved by one freedom after the other, each along an axis of
/// the frame as the freedoms before it have turned it, and turned by `attitude`: it is then that of the outer body at
/// its `outer_point`.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialJoint {
    /// Point of the joint in the inner body, from its centre of mass, in its axes (m); on the ground from the origin.
    pub inner_point: Vector3<f64>,
    /// Point of the joint in the outer body, from its centre of mass, in its axes (m).
    pub outer_point: Vector3<f64>,
    /// From inside to outside.
    pub freedoms: Vec<Freedom>,
    /// From the axes of the outer body to those of the inner one, where all coordinates are 0.
    pub attitude: UnitQuaternion<f64>,
}

/// A joint of S1 Sect. 3.2 with body i outside and body j inside; axes are given in the axes of the inner body.
///
/// Where all attitudes are free they are three turns about axes at right angles, whose rates become infinite where the
/// second is a quarter turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CompositeJoint {
    /// No freedom.
    Weld,
    /// All attitudes about a common point.
    AtPoint,
    /// A common point and an axis of each body, at right angles to each other: the first one stays in the inner body,
    /// the second in the outer one. They must be at right angles.
    Universal([UnitVector3<f64>; 2]),
    /// A common axis, no slide.
    Revolute(UnitVector3<f64>),
    /// A slide along this axis.
    Translational(UnitVector3<f64>),
    /// A turn about and a slide along this axis.
    Cylindrical(UnitVector3<f64>),
    /// Slides in the plane with this normal and a turn about it.
    Planar(UnitVector3<f64>),
    /// A point of the outer body on a line in the inner one; all attitudes.
    Inline(UnitVector3<f64>),
    /// A point of the outer body in a plane, told by its normal, in the inner one; all attitudes.
    InPlane(UnitVector3<f64>),
    /// No turn; all positions.
    Orientation,
    /// An axis of each body, at right angles to each other as in [`CompositeJoint::Universal`]; all positions.
    Perpendicular([UnitVector3<f64>; 2]),
    /// All positions and attitudes.
    Free,
}

impl SpatialJoint {
    pub(super) fn check(&self) -> Result<(), ReferenceError> {
        all_finite("inner_point", self.inner_point.as_slice())?;
        all_finite("outer_point", self.outer_point.as_slice())?;
        all_finite("attitude", self.attitude.coords.as_slice())?;
        for freedom in &self.freedoms {
            let (Freedom::Turn(axis) | Freedom::Slide(axis)) = freedom;
            all_finite("freedoms", axis.as_slice())?;
        }
        Ok(())
    }
}

impl CompositeJoint {
    /// The freedoms that the joint leaves: slides, then turns.
    pub fn freedoms(&self) -> Vec<Freedom> {
        let slides = |axes: &[UnitVector3<f64>]| axes.iter().copied().map(Freedom::Slide).collect();
        let turns = |axes: &[UnitVector3<f64>]| axes.iter().copied().map(Freedom::Turn).collect();
        let all = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
        let (slides, turns): (Vec<_>, Vec<_>) = match self {
            Self::Weld => (vec![], vec![]),
            Self::AtPoint => (vec![], turns(&all)),
            Self::Universal(axes) => (vec![], turns(axes)),
            Self::Revolute(axis) => (vec![], turns(&[*axis])),
            Self::Translational(axis) => (slides(&[*axis]), vec![]),
            Self::Cylindrical(axis) => (slides(&[*axis]), turns(&[*axis])),
            Self::Planar(normal) => (slides(&in_plane(normal)), turns(&[*normal])),
            Self::Inline(axis) => (slides(&[*axis]), turns(&all)),
            Self::InPlane(normal) => (slides(&in_plane(normal)), turns(&all)),
            Self::Orientation => (slides(&all), vec![]),
            Self::Perpendicular(axes) => (slides(&all), turns(axes)),
            Self::Free => (slides(&all), turns(&all)),
        };
        [slides, turns].concat()
    }
}

/// Two axes at right angles to each other and to this one.
fn in_plane(normal: &UnitVector3<f64>) -> [UnitVector3<f64>; 2] {
    let least = Vector3::ith_axis(normal.map(f64::abs).imin());
    let first = Unit::new_normalize(normal.cross(&least));
    [first, Unit::new_normalize(normal.cross(&first))]
}
