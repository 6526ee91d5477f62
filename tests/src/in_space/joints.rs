//! Joints of a reference as joints of a scene.

use linchpin_master::joint::composite::{Frame, Kind};
use linchpin_models::reference::{CompositeJoint, SpatialJoint};
use nalgebra::{Unit, UnitVector3, Vector3};

/// Joints that a scene can name, with awkward axes.
pub fn all() -> [CompositeJoint; 11] {
    let axis = unit(3.0, -1.0, 2.0);
    let axes = [unit(2.0, 1.0, 0.0), unit(-1.0, 2.0, 3.0)];
    [
        CompositeJoint::AtPoint,
        CompositeJoint::Universal(axes),
        CompositeJoint::Revolute(axis),
        CompositeJoint::Cylindrical(axis),
        CompositeJoint::Planar(axis),
        CompositeJoint::Inline(axis),
        CompositeJoint::InPlane(axis),
        CompositeJoint::Perpendicular(axes),
        CompositeJoint::Orientation,
        CompositeJoint::Translational(axis),
        CompositeJoint::Weld,
    ]
}

/// Unit vector along `(x, y, z)`.
pub fn unit(x: f64, y: f64, z: f64) -> UnitVector3<f64> {
    Unit::new_normalize(Vector3::new(x, y, z))
}

/// Name of the kind in a scene.
pub fn name(joint: &CompositeJoint) -> &'static str {
    match joint {
        CompositeJoint::Weld => "weld",
        CompositeJoint::AtPoint => "atpoint",
        CompositeJoint::Universal(_) => "universal",
        CompositeJoint::Revolute(_) => "revolute",
        CompositeJoint::Translational(_) => "translational",
        CompositeJoint::Cylindrical(_) => "cylindrical",
        CompositeJoint::Planar(_) => "planar",
        CompositeJoint::Inline(_) => "inline",
        CompositeJoint::InPlane(_) => "inplane",
        CompositeJoint::Orientation => "orientation",
        CompositeJoint::Perpendicular(_) => "perpendicular",
        CompositeJoint::Free => panic!("a free body has no joint"),
    }
}

/// The kind as the master knows it.
pub fn kind(joint: &CompositeJoint) -> Kind {
    match joint {
        CompositeJoint::Weld => Kind::Weld,
        CompositeJoint::AtPoint => Kind::AtPoint,
        CompositeJoint::Universal(_) => Kind::Universal,
        CompositeJoint::Revolute(_) => Kind::Revolute,
        CompositeJoint::Translational(_) => Kind::Translational,
        CompositeJoint::Cylindrical(_) => Kind::Cylindrical,
        CompositeJoint::Planar(_) => Kind::Planar,
        CompositeJoint::Inline(_) => Kind::Inline,
        CompositeJoint::InPlane(_) => Kind::InPlane,
        CompositeJoint::Orientation => Kind::Orientation,
        CompositeJoint::Perpendicular(_) => Kind::Perpendicular,
        CompositeJoint::Free => panic!("a free body has no joint"),
    }
}

/// Where the joint holds, seen from markers of the outer and the inner body at `markers` (m, from their centres of mass)
/// with the axes of their bodies.
///
/// The axis that the outer body holds is given in the axes of the inner one as they are where all coordinates of the
/// joint are 0, so it is turned back by the attitude.
pub fn frame(joint: &CompositeJoint, place: &SpatialJoint, markers: [Vector3<f64>; 2]) -> Frame {
    let [inner, outer] = match joint {
        CompositeJoint::Universal(axes) | CompositeJoint::Perpendicular(axes) => *axes,
        CompositeJoint::Revolute(axis)
        | CompositeJoint::Translational(axis)
        | CompositeJoint::Cylindrical(axis)
        | CompositeJoint::Planar(axis)
        | CompositeJoint::Inline(axis)
        | CompositeJoint::InPlane(axis) => [*axis; 2],
        _ => [Vector3::z_axis(); 2],
    };
    Frame {
        points: [
            place.outer_point - markers[0],
            place.inner_point - markers[1],
        ],
        axes: [(place.attitude.inverse() * outer).into_inner(), *inner],
        attitude: place.attitude,
    }
}
