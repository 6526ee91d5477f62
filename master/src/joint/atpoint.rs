//! Two points that coincide, component by component.

use linchpin_proto::joint_load::{End, JointLaw, Law};
use nalgebra::Vector3;

use super::condition::Condition;
use super::motion::{Jet, MarkerGradient, Motion};

/// One component of the atpoint joint (S1 eqs. 28 to 36), which is a ball joint in space and a hinge in the plane:
///
/// `g = (p_a - p_b) . d = 0` (m) with the points `p = r + T s` of both markers and a fixed direction `d` of the inertial
/// frame; on the other levels the rates of the points, which contain the rotation of their bodies. The multiplier (N) is the
/// component along `d` of the force on `a` at `p_a`; `b` gets the opposite one at `p_b` (S1 eq. 30). Where the points are the
/// markers themselves, no orientation is read and the load is a force of fixed direction.
///
/// While the joint is open, the two forces act at two points and form a couple; it is as small as the opening.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtPoint {
    law: JointLaw,
}

impl AtPoint {
    /// Between points `points` of both markers (m, in their axes), along the unit vector `direction` in inertial axes.
    pub fn new(points: [Vector3<f64>; 2], direction: Vector3<f64>) -> Self {
        let law = Law::AtPoint { direction };
        Self {
            law: JointLaw { law, points },
        }
    }
}

impl Condition for AtPoint {
    fn law(&self) -> Option<&JointLaw> {
        Some(&self.law)
    }

    fn factors(&self, motion: &Motion) -> [Jet; 2] {
        self.law.factors(motion)
    }

    fn factor_gradient(&self, motion: &Motion, end: End, [by, _]: [&Jet; 2]) -> MarkerGradient {
        distance_gradient(&self.law.points, motion, end, by)
    }
}

/// Derivatives of `by` times `p_a - p_b` with respect to the motion at one end.
pub(super) fn distance_gradient(
    points: &[Vector3<f64>; 2],
    motion: &Motion,
    end: End,
    by: &Jet,
) -> MarkerGradient {
    let by = match end {
        End::A => *by,
        End::B => -*by,
    };
    motion[end as usize].point_gradient(&points[end as usize], &by)
}
