//! Three masses in a row (S2 Sect. 2.8, eq. 91, Fig. 14): springs, a constant acceleration, and at the last mass a
//! stiff spring (a) or a constraint `q_3 = 0` (b).

use crate::nonsmooth::matrix::{BorderedBand, Shape};
use crate::nonsmooth::system::{Contact, Instant, MechanicalSystem};

/// What holds the last mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// A spring of this stiffness `k_0` (N/m) to the wall.
    Spring(f64),
    /// The constraint `q_3 = 0`; its multiplier is the force on the mass along `q_3`.
    Constraint,
}

/// Masses, springs, end. Inputs, if there are any, are forces on the masses (N).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Masses {
    /// `m_1` to `m_3` (kg).
    pub masses: [f64; 3],
    /// `k_1` (wall to the first mass), `k_2`, `k_3` (N/m).
    pub springs: [f64; 3],
    /// Acceleration along all coordinates (m/s^2).
    pub gravity: f64,
    /// Behind the last mass.
    pub end: End,
}

impl Masses {
    /// The data of S2: unit masses and springs, 9.81 m/s^2.
    pub fn of_paper(end: End) -> Self {
        Self {
            masses: [1.0; 3],
            springs: [1.0; 3],
            gravity: 9.81,
            end,
        }
    }

    fn end_spring(&self) -> f64 {
        match self.end {
            End::Spring(stiffness) => stiffness,
            End::Constraint => 0.0,
        }
    }

    /// Diagonal and upper neighbours of the stiffness matrix.
    fn stiffness(&self) -> ([f64; 3], [f64; 2]) {
        let [k1, k2, k3] = self.springs;
        ([k1 + k2, k2 + k3, k3 + self.end_spring()], [-k2, -k3])
    }
}

impl MechanicalSystem for Masses {
    fn shape(&self) -> Shape {
        Shape::dense(3)
    }

    fn contacts(&self) -> &[Contact] {
        match self.end {
            End::Spring(_) => &[],
            End::Constraint => const { &[Contact::CONSTRAINT] },
        }
    }

    fn mass(&self, _q: &[f64], mass: &mut BorderedBand) {
        for (i, &m) in self.masses.iter().enumerate() {
            mass.add(i, i, m);
        }
    }

    fn force(&self, at: Instant<'_>, force: &mut [f64]) {
        let (diagonal, neighbours) = self.stiffness();
        for i in 0..3 {
            force[i] = self.masses[i] * self.gravity - diagonal[i] * at.q[i];
            force[i] += at.inputs.get(i).copied().unwrap_or(0.0);
        }
        for (i, k) in neighbours.into_iter().enumerate() {
            force[i] -= k * at.q[i + 1];
            force[i + 1] -= k * at.q[i];
        }
    }

    fn tangents(
        &self,
        _at: Instant<'_>,
        stiffness: &mut BorderedBand,
        _damping: &mut BorderedBand,
    ) -> bool {
        let (diagonal, neighbours) = self.stiffness();
        for (i, k) in diagonal.into_iter().enumerate() {
            stiffness.add(i, i, k);
        }
        for (i, k) in neighbours.into_iter().enumerate() {
            stiffness.add_symmetric(i, i + 1, k);
        }
        true
    }

    fn gaps(&self, q: &[f64], gaps: &mut [f64]) {
        gaps.fill(q[2]);
    }

    fn directions(&self, _q: &[f64], rows: &mut [f64]) {
        rows.copy_from_slice(&[0.0, 0.0, 1.0]);
    }

    fn direction_rates(&self, _q: &[f64], _v: &[f64], rates: &mut [f64]) {
        rates.fill(0.0);
    }

    fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        let [k1, k2, k3] = self.springs;
        let kinetic = (0..3).map(|i| self.masses[i] * v[i] * v[i]).sum::<f64>();
        let lengths = [
            (k1, q[0]),
            (k2, q[1] - q[0]),
            (k3, q[2] - q[1]),
            (self.end_spring(), q[2]),
        ];
        let springs = lengths
            .into_iter()
            .map(|(k, length)| k * length * length)
            .sum::<f64>();
        let weight = (0..3)
            .map(|i| self.masses[i] * self.gravity * q[i])
            .sum::<f64>();
        0.5 * (kinetic + springs) - weight
    }
}
