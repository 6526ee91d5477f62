//! The rigid slider-crank mechanism with a translational clearance joint (Flores, Leine & Glocker 2010; S2 Sect. 4.1).
//!
//! Coordinates: angles of crank and rod from the x axis and of the slider, `q = (theta_1, theta_2, theta_3)` (rad). The
//! slider's centre of mass is the end of the rod. With `c = cos(theta_1 - theta_2)` and `s = sin(theta_1 - theta_2)`
//!
//! ```text
//!     | A    C c  0   |        A = J_1 + m_1 l_1^2/4 + (m_2 + m_3) l_1^2
//! M = | C c  B    0   |        B = J_2 + m_2 l_2^2/4 + m_3 l_2^2
//!     | 0    0    J_3 |        C = (m_2/2 + m_3) l_1 l_2
//!
//! f = ( -C s w_2^2 - (m_1/2 + m_2 + m_3) g l_1 cos(theta_1) + T,  C s w_1^2 - (m_2/2 + m_3) g l_2 cos(theta_2),  0 )
//! ```

use super::notch::{CORNERS, CornerLaw, Notch};
use crate::nonsmooth::matrix::{BorderedBand, Shape};
use crate::nonsmooth::system::{Contact, Instant, MechanicalSystem};

/// Lengths, masses and loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mechanism {
    /// Crank `l_1` and rod `l_2` (m).
    pub lengths: [f64; 2],
    /// Crank, rod, slider (kg).
    pub masses: [f64; 3],
    /// Moments of inertia about the centres of mass (kg m^2).
    pub inertias: [f64; 3],
    /// Acceleration of gravity along -y (m/s^2).
    pub gravity: f64,
    /// Constant torque on the crank (N m).
    pub torque: f64,
    /// Slider and notch.
    pub notch: Notch,
}

/// How the slider is guided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Guide {
    /// Corners that touch the walls of the notch.
    Clearance(CornerLaw),
    /// No clearance: `y = 0` with friction, and `theta_3 = 0`. For four corners that are closed all the time their own
    /// normal forces are not determined; these two are.
    Bilateral {
        /// Coulomb's coefficient of the force across.
        friction: f64,
    },
    /// Nothing.
    Free,
}

/// The mechanism as a system.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidSliderCrank {
    mechanism: Mechanism,
    guide: Guide,
    contacts: Vec<Contact>,
}

impl Guide {
    /// Laws of the corners, or of the two constraints; none.
    pub fn contacts(self) -> Vec<Contact> {
        match self {
            Self::Clearance(law) => vec![law.contact(); CORNERS],
            Self::Bilateral { friction } => vec![
                Contact {
                    friction,
                    tangents: 1,
                    ..Contact::CONSTRAINT
                },
                Contact::CONSTRAINT,
            ],
            Self::Free => Vec::new(),
        }
    }

    /// Gaps (m) of the corners in `notch`, or what the two constraints hold at 0 (m, rad), at a height (m) and an angle
    /// (rad) of the slider.
    pub fn gaps(self, notch: &Notch, height: f64, angle: f64, gaps: &mut [f64]) {
        match self {
            Self::Clearance(_) => gaps.copy_from_slice(&notch.gaps(height, angle)),
            Self::Bilateral { .. } => gaps.copy_from_slice(&[height, angle]),
            Self::Free => {}
        }
    }
}

impl Mechanism {
    /// S2 Table 1.
    pub fn table_1() -> Self {
        Self {
            lengths: [0.153, 0.306],
            masses: [0.038, 0.038, 0.076],
            inertias: [7.4e-5, 5.9e-4, 2.7e-6],
            gravity: 9.81,
            torque: 0.0,
            notch: Notch {
                half_length: 0.05,
                half_height: 0.025,
                clearance: 1e-3,
            },
        }
    }

    /// S2 Table 2.
    pub fn table_2() -> Self {
        let table_1 = Self::table_1();
        Self {
            torque: 1.0,
            notch: Notch {
                clearance: 5e-4,
                ..table_1.notch
            },
            ..table_1
        }
    }
}

impl RigidSliderCrank {
    /// A mechanism with a guide.
    pub fn new(mechanism: Mechanism, guide: Guide) -> Self {
        let contacts = guide.contacts();
        Self {
            mechanism,
            guide,
            contacts,
        }
    }

    /// Its data.
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// `(A, B, C)` of the mass matrix.
    fn inertia(&self) -> [f64; 3] {
        let [l1, l2] = self.mechanism.lengths;
        let [m1, m2, m3] = self.mechanism.masses;
        let [j1, j2, _] = self.mechanism.inertias;
        [
            j1 + (0.25 * m1 + m2 + m3) * l1 * l1,
            j2 + (0.25 * m2 + m3) * l2 * l2,
            (0.5 * m2 + m3) * l1 * l2,
        ]
    }

    /// Moments of mass of crank and rod about their first ends, with what they carry (kg m).
    fn moments_of_mass(&self) -> [f64; 2] {
        let [l1, l2] = self.mechanism.lengths;
        let [m1, m2, m3] = self.mechanism.masses;
        [(0.5 * m1 + m2 + m3) * l1, (0.5 * m2 + m3) * l2]
    }

    /// Centre of the slider.
    pub fn slider(&self, q: &[f64]) -> [f64; 2] {
        let [l1, l2] = self.mechanism.lengths;
        [
            l1 * q[0].cos() + l2 * q[1].cos(),
            l1 * q[0].sin() + l2 * q[1].sin(),
        ]
    }

    /// `d(x, y)/d(theta_1, theta_2)` of the slider: two rows.
    fn slider_by_angles(&self, q: &[f64]) -> [[f64; 2]; 2] {
        let [l1, l2] = self.mechanism.lengths;
        let ([s1, c1], [s2, c2]) = (sin_cos(q[0]), sin_cos(q[1]));
        [[-l1 * s1, -l2 * s2], [l1 * c1, l2 * c2]]
    }
}

fn sin_cos(angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [sin, cos]
}

impl MechanicalSystem for RigidSliderCrank {
    fn shape(&self) -> Shape {
        Shape::dense(3)
    }

    fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    fn mass(&self, q: &[f64], mass: &mut BorderedBand) {
        let [a, b, c] = self.inertia();
        mass.add(0, 0, a);
        mass.add_symmetric(0, 1, c * (q[0] - q[1]).cos());
        mass.add(1, 1, b);
        mass.add(2, 2, self.mechanism.inertias[2]);
    }

    fn force(&self, at: Instant<'_>, force: &mut [f64]) {
        let [_, _, c] = self.inertia();
        let [u1, u2] = self
            .moments_of_mass()
            .map(|moment| moment * self.mechanism.gravity);
        let (q, v) = (at.q, at.v);
        let gyroscopic = c * (q[0] - q[1]).sin();
        let torque = self.mechanism.torque + at.inputs.first().copied().unwrap_or(0.0);
        force[0] = -gyroscopic * v[1] * v[1] - u1 * q[0].cos() + torque;
        force[1] = gyroscopic * v[0] * v[0] - u2 * q[1].cos();
        force[2] = 0.0;
    }

    fn gaps(&self, q: &[f64], gaps: &mut [f64]) {
        let [_, y] = self.slider(q);
        self.guide.gaps(&self.mechanism.notch, y, q[2], gaps);
    }

    fn directions(&self, q: &[f64], rows: &mut [f64]) {
        let [[x1, x2], [y1, y2]] = self.slider_by_angles(q);
        match self.guide {
            Guide::Clearance(_) => {
                let notch = &self.mechanism.notch;
                let normal = notch.normal_by_angle(q[2]);
                let tangent = notch.tangent_by_angle(q[2]);
                let by_height = Notch::by_height();
                for (corner, rows) in rows.chunks_exact_mut(6).enumerate() {
                    let y = by_height[corner];
                    rows.copy_from_slice(&[
                        y * y1,
                        y * y2,
                        normal[corner],
                        x1,
                        x2,
                        tangent[corner],
                    ]);
                }
            }
            Guide::Bilateral { .. } => {
                rows.copy_from_slice(&[y1, y2, 0.0, x1, x2, 0.0, 0.0, 0.0, 1.0]);
            }
            Guide::Free => {}
        }
    }

    fn direction_rates(&self, q: &[f64], v: &[f64], rates: &mut [f64]) {
        let [l1, l2] = self.mechanism.lengths;
        let ([s1, c1], [s2, c2]) = (sin_cos(q[0]), sin_cos(q[1]));
        let squares = [v[0] * v[0], v[1] * v[1], v[2] * v[2]];
        let x = -l1 * c1 * squares[0] - l2 * c2 * squares[1];
        let y = -l1 * s1 * squares[0] - l2 * s2 * squares[1];
        match self.guide {
            Guide::Clearance(_) => {
                let notch = &self.mechanism.notch;
                let normal = notch.normal_by_angle_twice(q[2]);
                let tangent = notch.tangent_by_angle_twice(q[2]);
                let by_height = Notch::by_height();
                for (corner, rates) in rates.chunks_exact_mut(2).enumerate() {
                    rates[0] = by_height[corner] * y + normal[corner] * squares[2];
                    rates[1] = x + tangent[corner] * squares[2];
                }
            }
            Guide::Bilateral { .. } => rates.copy_from_slice(&[y, x, 0.0]),
            Guide::Free => {}
        }
    }

    fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        let [a, b, c] = self.inertia();
        let [u1, u2] = self.moments_of_mass();
        let coupling = c * (q[0] - q[1]).cos();
        let kinetic = 0.5 * (a * v[0] * v[0] + b * v[1] * v[1])
            + coupling * v[0] * v[1]
            + 0.5 * self.mechanism.inertias[2] * v[2] * v[2];
        kinetic + self.mechanism.gravity * (u1 * q[0].sin() + u2 * q[1].sin())
    }
}
