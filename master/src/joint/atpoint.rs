//! Two points that coincide.

use super::{End, Joint, Level, Motion};

/// The atpoint joint, a ball joint in space and a hinge in the plane (S1 eqs. 28 to 36):
///
/// `g = r_a - r_b = 0` (m), the positions of the two markers in the inertial frame, likewise on velocity and acceleration
/// level: the rates of the marker points, which contain the rotation of their bodies. The multipliers (N) are the
/// components of the force on `a` in the inertial frame; `b` gets the opposite one (S1 eq. 30). Both act at the marker
/// points, so their moments about the centres of mass are the workers' part. No orientation is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AtPoint {
    /// Two rows.
    InPlane,
    /// Three rows.
    InSpace,
}

/// Components of a point.
const COMPONENTS: [usize; 3] = [0, 1, 2];

impl AtPoint {
    fn dimension(self) -> usize {
        match self {
            Self::InPlane => 2,
            Self::InSpace => 3,
        }
    }
}

impl Joint for AtPoint {
    fn rows(&self) -> &'static [&'static str] {
        &["x", "y", "z"][..self.dimension()]
    }

    fn reads(&self) -> &'static [usize] {
        &COMPONENTS[..self.dimension()]
    }

    fn condition(&self, row: usize, level: Level, motion: &Motion) -> f64 {
        motion[0][level as usize][row] - motion[1][level as usize][row]
    }

    fn gradient(
        &self,
        row: usize,
        level: Level,
        _: &Motion,
        end: End,
        of: Level,
        component: usize,
    ) -> f64 {
        if level == of && row == component {
            self.load(row, end, component)
        } else {
            0.0
        }
    }

    fn loads(&self) -> &'static [usize] {
        self.reads()
    }

    fn load(&self, row: usize, end: End, component: usize) -> f64 {
        match end {
            _ if row != component => 0.0,
            End::A => 1.0,
            End::B => -1.0,
        }
    }
}
