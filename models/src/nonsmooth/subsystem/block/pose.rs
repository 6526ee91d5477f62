//! Where the block is at the start, and how it moves.
//!
//! With `c` the lowest corner and `d` the centre of the block from it, both in axes along and across the plane, and the
//! rate `w`: `d = -R(tilt) c`, and the velocity of the centre is that of the corner plus `w (-d_n, d_t)`.

use linchpin_worker::setup::SetupError;

use crate::nonsmooth::subsystem::keys::Parameters;
use crate::nonsmooth::systems::body_on_planes::{Plane, corners_of, turn};

/// How far a block that touches the plane is sunk into it, over its size: as far as rounding could lift it otherwise.
const ROUNDING: f64 = 1e-14;

/// The start as a scene gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Place of the centre along the plane (m).
    pub way: f64,
    /// Distance of the lowest corner from the plane (m).
    gap: f64,
    /// Angle against the plane (rad).
    tilt: f64,
    /// Velocity of the lowest corner along the plane and away from it (m/s).
    corner_velocity: [f64; 2],
    /// Angular velocity (rad/s).
    rate: f64,
}

impl Pose {
    /// From the parameters.
    pub fn of(parameters: &Parameters<'_>) -> Result<Self, SetupError> {
        Ok(Self {
            way: parameters.number("way0")?,
            gap: parameters.non_negative("gap0")?,
            tilt: parameters.number("tilt0")?,
            corner_velocity: [parameters.number("speed0")?, parameters.number("lift0")?],
            rate: parameters.number("rate0")?,
        })
    }

    /// The lowest corner in axes of the plane from the centre (m); of two that are as low, the one that the block turns
    /// about: the other one rises.
    fn lowest(&self, half: [f64; 2]) -> [f64; 2] {
        let ahead = self.tilt + 1e-9 * self.rate.signum();
        let height = |corner: &[f64; 2]| turn(ahead, *corner)[1];
        let [first, others @ ..] = corners_of(half);
        let lower = |one, other| {
            if height(&other) < height(&one) {
                other
            } else {
                one
            }
        };
        turn(self.tilt, others.into_iter().fold(first, lower))
    }

    /// Centre and angle, and their rates, in inertial axes.
    pub fn start(&self, half: [f64; 2], slope: f64) -> [[f64; 3]; 2] {
        let [along, up] = self.lowest(half);
        let sunk = if self.gap == 0.0 {
            ROUNDING * (half[0] + half[1])
        } else {
            0.0
        };
        let centre = [self.way, self.gap - up - sunk];
        let [speed, lift] = self.corner_velocity;
        let velocity = [speed + self.rate * up, lift - self.rate * along];
        let plane = Plane::rising(slope);
        let (t, n) = (plane.tangent(), plane.normal);
        let inertial = |[a, b]: [f64; 2]| [0, 1].map(|axis: usize| a * t[axis] + b * n[axis]);
        let ([x, y], [vx, vy]) = (inertial(centre), inertial(velocity));
        [[x, y, slope + self.tilt], [vx, vy, self.rate]]
    }
}
