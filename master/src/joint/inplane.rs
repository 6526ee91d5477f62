//! A point that stays in a plane.

use linchpin_proto::joint_load::{End, JointLaw, Law};
use nalgebra::Vector3;

use super::atpoint::distance_gradient;
use super::condition::Condition;
use super::motion::{Jet, MarkerGradient, Motion};

/// The inplane joint (S1 eqs. 37 to 45); in the plane of a planar scene it keeps a point on a straight line:
///
/// `g = (p_a - p_b) . e_b = 0` (m) with the points `p = r + T s` of both markers and the unit normal `e_b` fixed in marker b.
/// The multiplier (N) is the force on `a` at `p_a` along `e_b`; `b` gets the opposite one at the same point `p_a` (S1 eq. 39),
/// so forces and moments of the two bodies cancel at any opening.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InPlane {
    law: JointLaw,
    normal: Vector3<f64>,
}

impl InPlane {
    /// Keeps point `points[0]` of marker a in the plane through `points[1]` of marker b (m, in their axes) whose unit normal
    /// in the axes of b is `normal`.
    pub fn new(points: [Vector3<f64>; 2], normal: Vector3<f64>) -> Self {
        let law = Law::InPlane { normal };
        Self {
            law: JointLaw { law, points },
            normal,
        }
    }
}

impl Condition for InPlane {
    fn law(&self) -> Option<&JointLaw> {
        Some(&self.law)
    }

    fn factors(&self, motion: &Motion) -> [Jet; 2] {
        self.law.factors(motion)
    }

    fn factor_gradient(
        &self,
        motion: &Motion,
        end: End,
        [by, turned_by]: [&Jet; 2],
    ) -> MarkerGradient {
        let of_distance = distance_gradient(&self.law.points, motion, end, by);
        match end {
            End::A => of_distance,
            End::B => of_distance + motion[1].carried_gradient(&self.normal, turned_by),
        }
    }
}
