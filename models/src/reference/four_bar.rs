//! The planar four-bar linkage with the crank's angle as its only coordinate.

mod closure;
mod forces;

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::ranges::{all_finite, finite, not_negative, positive};
use super::tip_line::TipLine;
use super::{ReferenceError, trajectory};
use crate::integrators::Ode;
use closure::Closure;

/// A rigid bar in the plane between two hinges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bar {
    /// Mass (kg), positive.
    pub m: f64,
    /// Moment of inertia about the centre of mass (kg m^2), not negative.
    pub inertia: f64,
    /// From its first hinge to its second one (m), positive.
    pub length: f64,
    /// Centre of mass (m) from the first hinge: along the bar, and across it to the left.
    pub centre: [f64; 2],
}

/// Side of the line from the rocker's hinge in the frame to the tip of the crank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Left, looking at the tip of the crank.
    Left,
    /// Right, looking at the tip of the crank.
    Right,
}

/// A frame that moves by `amplitude sin(2 pi frequency t)` in x.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shake {
    /// Amplitude (m).
    pub amplitude: f64,
    /// Frequency (Hz).
    pub frequency: f64,
}

/// Crank, coupler and rocker in a loop with a frame, without friction.
///
/// The crank's first hinge and the rocker's first hinge are in the frame; the coupler leads from the tip of the crank
/// to that of the rocker. With the crank's angle `p` from the x axis, each bar's angle and centre of mass follow from
/// the closed loop; virtual power leaves
///
/// ```text
/// p'' sum_i (m_i v_i^2 + J_i k_i^2) = torque + sum_i m_i (g - a_i) v_i - J_i b_i k_i
/// ```
///
/// with the velocity `v_i` of the centre and the rate `k_i` of the angle per unit of `p'`, the accelerations `a_i`,
/// `b_i` at a constant `p'`, all relative to the frame, and `g = (-x'', -gravity)` for the frame's acceleration `x''`.
/// The forces in the hinges are what Newton's and Euler's laws of the bars lack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourBar {
    /// Crank, coupler, rocker.
    pub bars: [Bar; 3],
    /// First hinges of crank and rocker (m) in the frame.
    pub frame_hinges: [[f64; 2]; 2],
    /// Where the hinge between coupler and rocker is.
    pub side: Side,
    /// Motion of the frame.
    pub shake: Shake,
    /// Acceleration of gravity in -y (m/s^2).
    pub gravity: f64,
    /// Constant torque of the frame on the crank (N m).
    pub torque: f64,
    /// Angle of the crank at the start (rad).
    pub angle: f64,
    /// Its rate (rad/s).
    pub rate: f64,
}

/// Motion of a four-bar linkage at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourBarMotion {
    /// Time since the start (s).
    pub t: f64,
    /// Angles of crank, coupler and rocker from the x axis (rad), continuous; those of coupler and rocker start between
    /// -pi and pi.
    pub angles: [f64; 3],
    /// Their rates (rad/s).
    pub rates: [f64; 3],
    /// Position of the frame in x (m).
    pub frame_position: f64,
    /// Its velocity (m/s).
    pub frame_velocity: f64,
    /// Forces (N) in the hinges frame-crank, crank-coupler, coupler-rocker, rocker-frame: of the former on the latter.
    pub hinge_forces: [[f64; 2]; 4],
    /// Kinetic energy and potential energy above y = 0 (J), seen from outside of the frame.
    pub energy: f64,
}

impl FourBar {
    /// The motion at `times` (s since the start), which must ascend from 0; Radau IIA with the tolerance 1e-12.
    ///
    /// # Errors
    /// [`ReferenceError`] if a parameter is out of its range, the loop cannot be closed at the start, the times do not
    /// ascend, or the integration fails, as it does where coupler and rocker come to lie in one line.
    pub fn motions(&self, times: &[f64]) -> Result<Vec<FourBarMotion>, ReferenceError> {
        self.check()?;
        let states = trajectory::states(self, &[self.angle, self.rate], times)?;
        let start = Closure::new(self, self.angle, self.rate).angles;
        let turns = start.map(|angle| TAU * (angle / TAU).round());
        let motions = times.iter().zip(states);
        Ok(motions
            .map(|(&t, state)| {
                let mut motion = self.motion(t, state[0], state[1]);
                for bar in [1, 2] {
                    motion.angles[bar] -= turns[bar];
                }
                motion
            })
            .collect())
    }

    fn check(&self) -> Result<(), ReferenceError> {
        for (place, bar) in self.bars.iter().enumerate() {
            bar.check().map_err(|error| error.in_body(place))?;
        }
        all_finite("frame_hinges", self.frame_hinges.as_flattened())?;
        finite("amplitude", self.shake.amplitude)?;
        finite("frequency", self.shake.frequency)?;
        finite("gravity", self.gravity)?;
        finite("torque", self.torque)?;
        finite("angle", self.angle)?;
        finite("rate", self.rate)?;
        let [a, b, c] = self.bars.map(|bar| bar.length);
        let distance = TipLine::new(self.between_frame_hinges(), a, self.angle).distance;
        if (b - c).abs() < distance && distance < b + c {
            return Ok(());
        }
        Err(ReferenceError::OpenLoop {
            distance,
            least: (b - c).abs(),
            most: b + c,
        })
    }

    fn between_frame_hinges(&self) -> [f64; 2] {
        let [crank, rocker] = self.frame_hinges;
        [rocker[0] - crank[0], rocker[1] - crank[1]]
    }

    /// First hinge of a bar, in the frame.
    fn first_hinge(&self, bar: usize, at: &Closure) -> Vector2<f64> {
        let [crank, rocker] = self.frame_hinges.map(Vector2::from);
        match bar {
            0 => crank,
            1 => crank + at.arm(0, [self.bars[0].length, 0.0]).arm,
            _ => rocker,
        }
    }

    fn motion(&self, t: f64, angle: f64, rate: f64) -> FourBarMotion {
        let at = Closure::new(self, angle, rate);
        let frame_velocity = self.shake.velocity(t);
        FourBarMotion {
            t,
            angles: at.angles,
            rates: at.rates,
            frame_position: self.shake.position(t),
            frame_velocity,
            hinge_forces: self.hinge_forces(t, &at),
            energy: self.energy(&at, frame_velocity),
        }
    }

    fn energy(&self, at: &Closure, frame_velocity: f64) -> f64 {
        let frame = Vector2::new(frame_velocity, 0.0);
        let centres = self.centres(at);
        let bars = self.bars.iter().enumerate();
        let energies = bars.map(|(i, bar)| {
            let velocity = frame + centres[i].partial * at.rates[0];
            let turning = bar.inertia * at.rates[i].powi(2);
            let height = self.first_hinge(i, at).y + at.arm(i, bar.centre).arm.y;
            0.5 * (bar.m * velocity.norm_squared() + turning) + bar.m * self.gravity * height
        });
        energies.sum()
    }
}

impl Bar {
    fn check(&self) -> Result<(), ReferenceError> {
        positive("m", self.m)?;
        not_negative("inertia", self.inertia)?;
        positive("length", self.length)?;
        all_finite("centre", &self.centre)
    }
}

impl Shake {
    fn position(&self, t: f64) -> f64 {
        self.amplitude * (TAU * self.frequency * t).sin()
    }

    fn velocity(&self, t: f64) -> f64 {
        let omega = TAU * self.frequency;
        self.amplitude * omega * (omega * t).cos()
    }

    fn acceleration(&self, t: f64) -> f64 {
        -(TAU * self.frequency).powi(2) * self.position(t)
    }
}

impl Ode for FourBar {
    fn derivative(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = self.crank_acceleration(t, &Closure::new(self, y[0], y[1]));
    }
}
