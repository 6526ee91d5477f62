//! The woodpecker toy (Glocker 1995; Pfeiffer & Glocker 1996; Leine, Glocker & van Campen 2001 and 2003): a bird on a
//! spring at a sleeve that slides down a pole, jams, and is freed by the stroke of the beak.
//!
//! Coordinates: height of the sleeve, angles of sleeve and bird, `q = (y, phi_M, phi_S)` (m, rad, rad), linear for
//! small angles. Contacts: beak (1), lower edge (2) and upper edge (3) of the sleeve, all against the pole. Inputs, as
//! many as there are: force upwards on the middle of the sleeve (N), moments on sleeve and bird (N m).
//!
//! ```text
//!     | m_S + m_M   m_S l_M           m_S l_G         |        f_1 = -(m_S + m_M) g
//! M = | .           J_M + m_S l_M^2   m_S l_M l_G     |        f_2 = -c (phi_M - phi_S) - m_S g l_M
//!     | .           .                 J_S + m_S l_G^2 |        f_3 = -c (phi_S - phi_M) - m_S g l_G
//!
//! g_N1 = l_M + l_G - l_S - r_0 - h_S phi_S,   g_N2 = r_M - r_0 + h_M phi_M,   g_N3 = r_M - r_0 - h_M phi_M
//! g_T1' = y' + l_M phi_M' + (l_G - l_S) phi_S',   g_T2' = g_T3' = y' + r_M phi_M'
//! ```

use super::notch::CornerLaw;
use crate::nonsmooth::matrix::{BorderedBand, Shape};
use crate::nonsmooth::system::{Contact, Instant, MechanicalSystem};

/// Contacts.
const CONTACTS: usize = 3;

/// Masses, lengths, spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Toy {
    /// Sleeve `m_M`, bird `m_S` (kg).
    pub masses: [f64; 2],
    /// Moments of inertia `J_M`, `J_S` about the centres of mass (kg m^2).
    pub inertias: [f64; 2],
    /// Stiffness `c` of the spring between sleeve and bird (N m/rad).
    pub spring: f64,
    /// Acceleration of gravity (m/s^2).
    pub gravity: f64,
    /// Radius `r_0` of the pole (m).
    pub pole_radius: f64,
    /// Inner radius `r_M` and half height `h_M` of the sleeve (m).
    pub sleeve: [f64; 2],
    /// From the middle of the sleeve to the spring `l_M`, from there to the centre of mass of the bird `l_G` (m).
    pub arms: [f64; 2],
    /// Place of the beak from the centre of mass of the bird: towards the pole `l_S`, above it `h_S` (m).
    pub beak: [f64; 2],
    /// Laws of beak, lower edge, upper edge.
    pub laws: [CornerLaw; CONTACTS],
}

/// The toy as a system.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Woodpecker {
    toy: Toy,
    contacts: [Contact; CONTACTS],
}

impl Toy {
    /// The data of Glocker 1995.
    pub fn of_glocker() -> Self {
        let law = |normal_restitution| CornerLaw {
            normal_restitution,
            tangential_restitution: 0.0,
            friction: 0.3,
        };
        Self {
            masses: [3e-4, 4.5e-3],
            inertias: [5e-9, 7e-7],
            spring: 5.6e-3,
            gravity: 9.81,
            pole_radius: 2.5e-3,
            sleeve: [3.1e-3, 5.8e-3],
            arms: [0.01, 0.015],
            beak: [0.0201, 0.02],
            laws: [law(0.5), law(0.0), law(0.0)],
        }
    }

    /// `M`.
    fn inertia(&self) -> [[f64; 3]; 3] {
        let [sleeve, bird] = self.masses;
        let [l_m, l_g] = self.arms;
        let arms = [1.0, l_m, l_g];
        let own = [sleeve, self.inertias[0], self.inertias[1]];
        std::array::from_fn(|i| {
            std::array::from_fn(|j| bird * arms[i] * arms[j] + if i == j { own[i] } else { 0.0 })
        })
    }

    /// Weights along the coordinates (N, N m).
    fn weights(&self) -> [f64; 3] {
        let [sleeve, bird] = self.masses;
        let [l_m, l_g] = self.arms;
        [sleeve + bird, bird * l_m, bird * l_g].map(|mass| mass * self.gravity)
    }
}

impl Woodpecker {
    /// A toy.
    pub fn new(toy: Toy) -> Self {
        Self {
            toy,
            contacts: toy.laws.map(|law| law.contact()),
        }
    }
}

impl MechanicalSystem for Woodpecker {
    fn shape(&self) -> Shape {
        Shape::dense(3)
    }

    fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    fn mass(&self, _q: &[f64], mass: &mut BorderedBand) {
        for (i, row) in self.toy.inertia().into_iter().enumerate() {
            for (j, value) in row.into_iter().enumerate() {
                mass.add(i, j, value);
            }
        }
    }

    fn force(&self, at: Instant<'_>, force: &mut [f64]) {
        let torque = self.toy.spring * (at.q[1] - at.q[2]);
        let [w1, w2, w3] = self.toy.weights();
        force.copy_from_slice(&[-w1, -torque - w2, torque - w3]);
        for (force, input) in force.iter_mut().zip(at.inputs) {
            *force += input;
        }
    }

    fn tangents(
        &self,
        _at: Instant<'_>,
        stiffness: &mut BorderedBand,
        _damping: &mut BorderedBand,
    ) -> bool {
        stiffness.add(1, 1, self.toy.spring);
        stiffness.add(2, 2, self.toy.spring);
        stiffness.add_symmetric(1, 2, -self.toy.spring);
        true
    }

    fn gaps(&self, q: &[f64], gaps: &mut [f64]) {
        let Toy {
            pole_radius,
            sleeve: [radius, half_height],
            arms: [l_m, l_g],
            beak: [l_s, h_s],
            ..
        } = self.toy;
        let play = radius - pole_radius;
        gaps.copy_from_slice(&[
            l_m + l_g - l_s - pole_radius - h_s * q[2],
            play + half_height * q[1],
            play - half_height * q[1],
        ]);
    }

    fn directions(&self, _q: &[f64], rows: &mut [f64]) {
        let Toy {
            sleeve: [radius, half_height],
            arms: [l_m, l_g],
            beak: [l_s, h_s],
            ..
        } = self.toy;
        let all = [
            [0.0, 0.0, -h_s],
            [1.0, l_m, l_g - l_s],
            [0.0, half_height, 0.0],
            [1.0, radius, 0.0],
            [0.0, -half_height, 0.0],
            [1.0, radius, 0.0],
        ];
        for (row, values) in rows.chunks_exact_mut(3).zip(all) {
            row.copy_from_slice(&values);
        }
    }

    fn direction_rates(&self, _q: &[f64], _v: &[f64], rates: &mut [f64]) {
        rates.fill(0.0);
    }

    fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        let inertia = self.toy.inertia();
        let kinetic: f64 = (0..3)
            .map(|i| v[i] * (0..3).map(|j| inertia[i][j] * v[j]).sum::<f64>())
            .sum();
        let weights = self.toy.weights();
        let height: f64 = weights.iter().zip(q).map(|(w, q)| w * q).sum();
        let twist = q[1] - q[2];
        0.5 * (kinetic + self.toy.spring * twist * twist) + height
    }
}
