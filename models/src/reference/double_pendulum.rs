//! The double pendulum in minimal coordinates.

use super::ReferenceError;
use super::links::{GroundHinge, Link, LinkMotion, LinkedPendulum, check_links};
use crate::integrators::Ode;

/// Two links, the first on a hinge in the ground with a torsional spring and damper, the second on its tip.
///
/// With the angles `a`, `b` from the x axis and `s = length / 2`, Lagrange's equations of
/// `T = A a'^2 / 2 + B b'^2 / 2 + C cos(a - b) a' b'`,
/// `V = G sin a + K sin b + spring (a - rest)^2 / 2` are
///
/// ```text
/// A a'' + C cos(a - b) b'' = -C sin(a - b) b'^2 - G cos a - spring (a - rest) - damping a'
/// C cos(a - b) a'' + B b'' =  C sin(a - b) a'^2 - K cos b
/// ```
///
/// `A = J1 + m1 s1^2 + m2 l1^2`, `B = J2 + m2 s2^2`, `C = m2 l1 s2`, `G = (m1 s1 + m2 l1) g`, `K = m2 s2 g`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoublePendulum {
    /// The link on the ground and the link on its tip.
    pub links: [Link; 2],
    /// Spring and damper of the first link.
    pub hinge: GroundHinge,
    /// Acceleration of gravity in -y (m/s^2).
    pub gravity: f64,
    /// Angles at the start (rad).
    pub angles: [f64; 2],
    /// Rates at the start (rad/s).
    pub rates: [f64; 2],
}

impl DoublePendulum {
    /// The example of S1 Sect. 4.2.
    pub fn schweizer_lu() -> Self {
        let link = Link {
            m: 1.0,
            inertia: 1.0 / 12.0,
            length: 1.0,
        };
        Self {
            links: [link; 2],
            hinge: GroundHinge {
                spring: 500.0,
                damping: 50.0,
                rest_angle: std::f64::consts::FRAC_PI_4,
            },
            gravity: 9.81,
            angles: [std::f64::consts::FRAC_PI_4, -std::f64::consts::FRAC_PI_4],
            rates: [0.0; 2],
        }
    }

    /// The motion at `times` (s since the start), which must ascend from 0; Radau IIA with the tolerance 1e-12.
    ///
    /// # Errors
    /// [`ReferenceError`] if a parameter is out of its range, the times do not ascend, or the integration fails.
    pub fn motions(&self, times: &[f64]) -> Result<Vec<LinkMotion>, ReferenceError> {
        let start = [self.angles, self.rates].concat();
        let values = start.iter().copied();
        check_links(self.links.iter(), &self.hinge, self.gravity, values)?;
        LinkedPendulum::motions(self, &start, times)
    }

    fn constants(&self) -> Constants {
        let [first, second] = self.links;
        let [s1, s2] = [0.5 * first.length, 0.5 * second.length];
        Constants {
            inertia: [
                first.inertia + first.m * s1 * s1 + second.m * first.length * first.length,
                second.inertia + second.m * s2 * s2,
            ],
            coupling: second.m * first.length * s2,
            weight: [
                (first.m * s1 + second.m * first.length) * self.gravity,
                second.m * s2 * self.gravity,
            ],
        }
    }

    /// Angular accelerations.
    fn accelerations(&self, [a, b]: [f64; 2], [rate_a, rate_b]: [f64; 2]) -> [f64; 2] {
        let Constants {
            inertia,
            coupling,
            weight,
        } = self.constants();
        let (sin, cos) = (a - b).sin_cos();
        let on_first =
            -coupling * sin * rate_b * rate_b - weight[0] * a.cos() + self.hinge.moment(a, rate_a);
        let on_second = coupling * sin * rate_a * rate_a - weight[1] * b.cos();
        let mixed = coupling * cos;
        let determinant = inertia[0] * inertia[1] - mixed * mixed;
        [
            (inertia[1] * on_first - mixed * on_second) / determinant,
            (inertia[0] * on_second - mixed * on_first) / determinant,
        ]
    }

    /// Newton's law of the second link: what it lacks is the force on it, and its reaction acts on the first.
    fn force_on_first(&self, [a, b]: [f64; 2], rates: [f64; 2]) -> [f64; 2] {
        let [first, second] = self.links;
        let [alpha_a, alpha_b] = self.accelerations([a, b], rates);
        let (arm_a, arm_b) = (first.length, 0.5 * second.length);
        let centre = [
            -arm_a * (alpha_a * a.sin() + rates[0].powi(2) * a.cos())
                - arm_b * (alpha_b * b.sin() + rates[1].powi(2) * b.cos()),
            arm_a * (alpha_a * a.cos() - rates[0].powi(2) * a.sin())
                + arm_b * (alpha_b * b.cos() - rates[1].powi(2) * b.sin()),
        ];
        [
            -second.m * centre[0],
            -second.m * (centre[1] + self.gravity),
        ]
    }

    fn energy(&self, [a, b]: [f64; 2], [rate_a, rate_b]: [f64; 2]) -> f64 {
        let Constants {
            inertia,
            coupling,
            weight,
        } = self.constants();
        0.5 * (inertia[0] * rate_a * rate_a + inertia[1] * rate_b * rate_b)
            + coupling * (a - b).cos() * rate_a * rate_b
            + weight[0] * a.sin()
            + weight[1] * b.sin()
            + self.hinge.energy(a)
    }
}

/// Constants of the kinetic and the potential energy.
struct Constants {
    inertia: [f64; 2],
    coupling: f64,
    weight: [f64; 2],
}

impl Ode for DoublePendulum {
    fn derivative(&self, _: f64, y: &[f64], dy: &mut [f64]) {
        let (angles, rates) = ([y[0], y[1]], [y[2], y[3]]);
        let accelerations = self.accelerations(angles, rates);
        dy[..2].copy_from_slice(&rates);
        dy[2..].copy_from_slice(&accelerations);
    }
}

impl LinkedPendulum for DoublePendulum {
    fn motion(&self, t: f64, state: &[f64]) -> LinkMotion {
        let (angles, rates) = ([state[0], state[1]], [state[2], state[3]]);
        LinkMotion {
            t,
            angles: angles.to_vec(),
            rates: rates.to_vec(),
            hinge_forces: vec![self.force_on_first(angles, rates)],
            energy: self.energy(angles, rates),
        }
    }
}
