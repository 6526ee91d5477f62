//! Two axes at right angles.

use linchpin_proto::joint_load::{End, JointLaw, Law};
use nalgebra::Vector3;

use super::condition::Condition;
use super::motion::{Jet, MarkerGradient, Motion};

/// The perpendicular joint (S1 eqs. 46 to 54); in a planar scene it fixes the angle between two bodies:
///
/// `g = e_a . e_b = 0` (1) with unit vectors fixed in both markers. The multiplier (N m) is the moment on `a` about
/// `e_a x e_b`; `b` gets the opposite one (S1 eq. 48). Positions are not read.
///
/// The condition also holds after a turn by a half: what keeps two axes parallel keeps them antiparallel as well. So a start
/// turned over is refused; see [`Joint::aligned`](super::Joint::aligned).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perpendicular {
    law: JointLaw,
    axes: [Vector3<f64>; 2],
}

impl Perpendicular {
    /// Between unit vectors in the axes of markers a and b.
    pub fn new(axes: [Vector3<f64>; 2]) -> Self {
        let law = Law::Perpendicular { axes };
        Self {
            law: JointLaw {
                law,
                points: [Vector3::zeros(); 2],
            },
            axes,
        }
    }
}

impl Condition for Perpendicular {
    fn law(&self) -> Option<&JointLaw> {
        Some(&self.law)
    }

    fn factors(&self, motion: &Motion) -> [Jet; 2] {
        self.law.factors(motion)
    }

    fn factor_gradient(&self, motion: &Motion, end: End, by: [&Jet; 2]) -> MarkerGradient {
        let own = end as usize;
        motion[own].carried_gradient(&self.axes[own], by[own])
    }
}
