//! Two masses on one axis that keep together.

use linchpin_proto::joint_load::{End, JointLaw, Marker};
use nalgebra::Vector3;

use super::condition::Condition;
use super::motion::{Jet, MarkerChange, Motion};

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

    fn factor_changes(&self, motion: &Motion, end: End, change: &MarkerChange) -> [Jet; 2] {
        let moved = motion[end as usize].point_change(&Vector3::zeros(), change);
        let moved = match end {
            End::A => -moved,
            End::B => moved,
        };
        [moved, Jet::constant(Vector3::zeros())]
    }
}

fn axis() -> Jet {
    Jet::constant(Vector3::x())
}
