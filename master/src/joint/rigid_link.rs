//! Two masses on one axis that keep together.

use super::{End, Joint, Level, Motion};

/// The massless rigid link between two scalar markers (S1 eq. 1):
///
/// `g = x_b - x_a = 0` (m), likewise on velocity and acceleration level. The multiplier `lambda` (N) pushes `a` by
/// `+lambda` and `b` by `-lambda` (S1 eqs. 4a, 4b), so a positive one pulls the two together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RigidLink;

impl Joint for RigidLink {
    fn rows(&self) -> &'static [&'static str] {
        &[""]
    }

    fn reads(&self) -> &'static [usize] {
        &[0]
    }

    fn condition(&self, _: usize, level: Level, motion: &Motion) -> f64 {
        motion[1][level as usize][0] - motion[0][level as usize][0]
    }

    fn gradient(&self, _: usize, level: Level, _: &Motion, end: End, of: Level, _: usize) -> f64 {
        match end {
            _ if level != of => 0.0,
            End::A => -1.0,
            End::B => 1.0,
        }
    }

    fn loads(&self) -> &'static [usize] {
        &[0]
    }

    fn load(&self, _: usize, end: End, _: usize) -> f64 {
        match end {
            End::A => 1.0,
            End::B => -1.0,
        }
    }
}
