//! Two masses on one axis that keep together.

use linchpin_proto::joint_load::{End, JointLaw, Marker};
use nalgebra::Vector3;

use super::condition::Condition;
use super::motion::{Jet, MarkerGradient, Motion};

/// The massless rigid link between two scalar markers (S1 eq. 1):
///
/// `g = x_b - x_a = 0` (m), likewise on velocity and acceleration level. The multiplier `lambda` (N) pushes `a` by
/// `+lambda` and `b` by `-lambda` (S1 eqs. 4a, 4b), so a positive one pulls the two together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RigidLink;

impl Condition for RigidLink {
    fn law(&self) -> Option<&JointLaw> {
        None
    }

    fn factors(&self, [a, b]: &Motion) -> [Jet; 2] {
        let origin = Vector3::zeros();
        [b.point(&origin) - a.point(&origin), axis()]
    }

    fn factor_gradient(&self, motion: &Motion, end: End, [by, _]: [&Jet; 2]) -> MarkerGradient {
        let by = match end {
            End::A => -*by,
            End::B => *by,
        };
        motion[end as usize].point_gradient(&Vector3::zeros(), &by)
    }
}

fn axis() -> Jet {
    Jet::constant(Vector3::x())
}
