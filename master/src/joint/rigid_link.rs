//! Two masses on one axis that keep together.

use super::{End, Joint, Level, Motion};

/// The massless rigid link between two scalar markers (S1 eq. 1):
///
/// `g = x_b - x_a = 0` (m), likewise on velocity and acceleration level. The multiplier `lambda` (N) pushes `a` by
/// `+lambda` and `b` by `-lambda` (S1 eqs. 4a, 4b), so a positive one pulls the two together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RigidLink;

impl Joint for RigidLink {
    fn condition(&self, level: Level, motion: &Motion) -> f64 {
        motion[1][level as usize] - motion[0][level as usize]
    }

    fn gradient(&self, level: Level, _: &Motion, end: End, of: Level) -> f64 {
        match end {
            _ if level != of => 0.0,
            End::A => -1.0,
            End::B => 1.0,
        }
    }

    fn load(&self, end: End) -> f64 {
        match end {
            End::A => 1.0,
            End::B => -1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradients_are_the_differences_of_the_condition() {
        let motion = [[0.3, -2.0, 5.0], [0.7, 4.0, -1.0]];
        for level in Level::ALL {
            for end in End::BOTH {
                for of in Level::ALL {
                    let mut moved = motion;
                    moved[end as usize][of as usize] += 0.5;
                    let difference =
                        RigidLink.condition(level, &moved) - RigidLink.condition(level, &motion);
                    let gradient = RigidLink.gradient(level, &motion, end, of);
                    assert!((difference - 0.5 * gradient).abs() < 1e-15);
                }
            }
        }
    }

    #[test]
    fn action_equals_reaction_and_an_ideal_link_does_no_work() {
        assert_eq!(RigidLink.load(End::A) + RigidLink.load(End::B), 0.0);
        let common = [[0.0, 3.0, 0.0], [0.0, 3.0, 0.0]];
        assert_eq!(RigidLink.condition(Level::Velocity, &common), 0.0);
        let power: f64 = End::BOTH.iter().map(|&end| RigidLink.load(end) * 3.0).sum();
        assert_eq!(power, 0.0);
    }
}
