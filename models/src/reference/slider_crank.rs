//! The slider-crank of S1 Sect. 4.3 with the crank's angle as its only coordinate.

use super::links::Link;
use super::ranges::{all_finite, finite};
use super::tip_line::TipLine;
use super::{ReferenceError, trajectory};
use crate::integrators::Ode;

/// Two links on hinges in the ground; the tip of link 1, the crank, slides along the axis of link 2.
///
/// With the angles `p1`, `p2` from the x axis, the length `l` of link 1, the slider's distance `s` from hinge 2 and
/// `d = p1 - p2`, the position of the tip gives
/// `p2' = k p1'`, `k = l cos d / s`, `s' = -l sin d p1'`, and once more derived
/// `p2'' = k p1'' + b`, `b = -l sin d p1' (p1' - 2 p2') / s`.
///
/// Virtual power leaves one equation, with the moments of inertia `A1`, `A2` about the hinges and the moments `Q1`,
/// `Q2` of the weights and the torque about them:
/// `(A1 + k^2 A2) p1'' = Q1 + k (Q2 - A2 b)`.
///
/// The contact is free of friction, so its force is `lambda n` on the tip of link 1 and `-lambda n` on link 2,
/// `n = (-sin p2, cos p2)`: the axis of link 2 turned by +90 degrees. This is S1 eq. (39) with link 1 as body i, link 2
/// as body j and `e_j = n`. It follows from Euler's equation of link 2 about its hinge, `A2 p2'' = Q2 - s lambda`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliderCrank {
    /// The crank and the link along whose axis its tip slides.
    pub links: [Link; 2],
    /// Where their hinges are (m).
    pub hinges: [[f64; 2]; 2],
    /// Acceleration of gravity in -y (m/s^2).
    pub gravity: f64,
    /// Constant torque on the crank (N m).
    pub torque: f64,
    /// Angle of the crank at the start (rad).
    pub angle: f64,
    /// Its rate (rad/s).
    pub rate: f64,
}

/// Motion of a slider-crank at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliderCrankMotion {
    /// Time since the start (s).
    pub t: f64,
    /// Angles of the links from the x axis (rad). That of link 2 points from its hinge to the tip of the crank and is
    /// continuous; it lies within a quarter turn of the crank's if hinge 2 is inside the circle of the tip, otherwise
    /// of the direction from hinge 2 to hinge 1 (between -pi and pi).
    pub angles: [f64; 2],
    /// Their rates (rad/s).
    pub rates: [f64; 2],
    /// Distance of the crank's tip from hinge 2 (m).
    pub slider: f64,
    /// Force `lambda` (N) on the crank in the direction `(-sin p2, cos p2)`.
    pub multiplier: f64,
    /// Forces (N) of the ground on the links in their hinges.
    pub hinge_forces: [[f64; 2]; 2],
    /// Kinetic energy and potential energy above y = 0 (J).
    pub energy: f64,
}

/// What turns the crank besides its weight and link 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Drive {
    /// Torque (N m).
    pub torque: f64,
    /// Moment of inertia that turns with the crank (kg m^2).
    pub inertia: f64,
}

/// Positions and rates of the mechanism at a crank angle and rate.
struct Kinematics {
    angles: [f64; 2],
    rates: [f64; 2],
    slider: f64,
    /// `k`.
    ratio: f64,
    /// `b`.
    bias: f64,
}

impl SliderCrank {
    /// The example of S1 Sect. 4.3.
    pub fn schweizer_lu() -> Self {
        let uniform = |m: f64, length: f64| Link {
            m,
            inertia: m * length * length / 12.0,
            length,
        };
        Self {
            links: [
                uniform(std::f64::consts::SQRT_2, std::f64::consts::SQRT_2),
                uniform(2.0, 2.0),
            ],
            hinges: [[0.0, 0.0], [1.0, 0.0]],
            gravity: 9.81,
            torque: 0.0,
            angle: std::f64::consts::FRAC_PI_4,
            rate: 0.0,
        }
    }

    /// The motion at `times` (s since the start), which must ascend from 0; Radau IIA with the tolerance 1e-12.
    ///
    /// # Errors
    /// [`ReferenceError`] if a parameter is out of its range, the times do not ascend, or the integration fails, as it
    /// does where the tip of the crank comes to hinge 2.
    pub fn motions(&self, times: &[f64]) -> Result<Vec<SliderCrankMotion>, ReferenceError> {
        self.check()?;
        let states = trajectory::states(self, &[self.angle, self.rate], times)?;
        let motions = times.iter().zip(states);
        Ok(motions
            .map(|(&t, state)| self.motion(t, state[0], state[1], self.drive()))
            .collect())
    }

    pub(super) fn check(&self) -> Result<(), ReferenceError> {
        for link in &self.links {
            link.check()?;
        }
        all_finite("hinges", self.hinges.as_flattened())?;
        finite("gravity", self.gravity)?;
        finite("torque", self.torque)?;
        finite("angle", self.angle)?;
        finite("rate", self.rate)
    }

    fn drive(&self) -> Drive {
        Drive {
            torque: self.torque,
            inertia: 0.0,
        }
    }

    fn kinematics(&self, angle: f64, rate: f64) -> Kinematics {
        let [first, second] = self.hinges;
        let between = [second[0] - first[0], second[1] - first[1]];
        let length = self.links[0].length;
        let line = TipLine::new(between, length, angle);
        let (sin, cos) = (angle - line.angle).sin_cos();
        let ratio = length * cos / line.distance;
        let rates = [rate, ratio * rate];
        Kinematics {
            angles: [angle, line.angle],
            rates,
            slider: line.distance,
            ratio,
            bias: -length * sin * rate * (rate - 2.0 * rates[1]) / line.distance,
        }
    }

    /// `A1` or `A2`.
    fn inertia(&self, link: usize) -> f64 {
        let Link { m, inertia, length } = self.links[link];
        inertia + 0.25 * m * length * length
    }

    /// Moment of the weight of a link about its hinge.
    fn weight(&self, link: usize, angle: f64) -> f64 {
        let Link { m, length, .. } = self.links[link];
        -0.5 * m * self.gravity * length * angle.cos()
    }

    /// Angular accelerations of both links.
    fn accelerations(&self, at: &Kinematics, drive: Drive) -> [f64; 2] {
        let [first, second] = [self.inertia(0) + drive.inertia, self.inertia(1)];
        let on_first = drive.torque + self.weight(0, at.angles[0]);
        let on_second = self.weight(1, at.angles[1]) - second * at.bias;
        let alpha = (on_first + at.ratio * on_second) / (first + at.ratio * at.ratio * second);
        [alpha, at.ratio * alpha + at.bias]
    }

    pub(super) fn crank_acceleration(&self, angle: f64, rate: f64, drive: Drive) -> f64 {
        self.accelerations(&self.kinematics(angle, rate), drive)[0]
    }

    pub(super) fn motion(&self, t: f64, angle: f64, rate: f64, drive: Drive) -> SliderCrankMotion {
        let at = self.kinematics(angle, rate);
        let alphas = self.accelerations(&at, drive);
        let lack = self.weight(1, at.angles[1]) - self.inertia(1) * alphas[1];
        let multiplier = lack / at.slider;
        let (sin, cos) = at.angles[1].sin_cos();
        let contact = [-multiplier * sin, multiplier * cos];
        let hinge_force = |link: usize, sign: f64| {
            let [x, y] = self.needed_force(link, at.angles[link], at.rates[link], alphas[link]);
            [x - sign * contact[0], y - sign * contact[1]]
        };
        SliderCrankMotion {
            t,
            angles: at.angles,
            rates: at.rates,
            slider: at.slider,
            multiplier,
            hinge_forces: [hinge_force(0, 1.0), hinge_force(1, -1.0)],
            energy: self.energy(0, &at) + self.energy(1, &at),
        }
    }

    /// Newton's law of a link: the force that it needs besides its weight.
    fn needed_force(&self, link: usize, angle: f64, rate: f64, alpha: f64) -> [f64; 2] {
        let Link { m, length, .. } = self.links[link];
        let (sin, cos) = angle.sin_cos();
        let (across, inward) = (0.5 * length * alpha, 0.5 * length * rate * rate);
        [
            m * (-across * sin - inward * cos),
            m * (across * cos - inward * sin + self.gravity),
        ]
    }

    fn energy(&self, link: usize, at: &Kinematics) -> f64 {
        let Link { m, length, .. } = self.links[link];
        let height = self.hinges[link][1] + 0.5 * length * at.angles[link].sin();
        0.5 * self.inertia(link) * at.rates[link].powi(2) + m * self.gravity * height
    }
}

impl Ode for SliderCrank {
    fn derivative(&self, _: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = self.crank_acceleration(y[0], y[1], self.drive());
    }
}
