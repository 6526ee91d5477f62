//! Laws of contact as projections.

use crate::nonsmooth::matrix::dot;

/// What holds in one row, for its force `x` and its relative velocity `xi`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// `xi = 0`.
    Equality,
    /// `0 <= xi`, `0 <= x`, `xi x = 0` (S2 eqs. 1, 11).
    Normal,
    /// Coulomb friction in one direction: `|x| <= R`; `xi != 0` only with `x = -R sign(xi)`, where `R = mu |x_normal|`
    /// (S2 eqs. 2, 12, 13).
    Friction {
        /// Row of the normal force.
        normal: usize,
        /// Coefficient of friction `mu`.
        coefficient: f64,
    },
    /// Coulomb friction in the plane of this row and the next one, which is [`Law::Second`].
    Disc {
        /// Row of the normal force.
        normal: usize,
        /// Coefficient of friction `mu`.
        coefficient: f64,
    },
    /// The second row of a [`Law::Disc`].
    Second,
    /// Sliding in a known direction: `x = factor |x_normal|`.
    Sliding {
        /// Row of the normal force.
        normal: usize,
        /// `-mu` times the component of the direction of sliding in this row.
        factor: f64,
    },
}

/// `xi = free + delassus x` with a law for each row.
#[derive(Debug, Clone, Default)]
pub struct Problem {
    /// Laws of the rows.
    pub laws: Vec<Law>,
    /// Relative velocities without forces, `F`.
    pub free: Vec<f64>,
    /// `G`, row by row; its diagonal is positive.
    pub delassus: Vec<f64>,
}

impl Problem {
    /// Takes memory for this many rows.
    pub fn reserve(&mut self, rows: usize) {
        self.laws.reserve(rows);
        self.free.reserve(rows);
        self.delassus.reserve(rows * rows);
    }

    /// Rows.
    pub fn len(&self) -> usize {
        self.laws.len()
    }

    /// Whether nothing is to be solved.
    pub fn is_empty(&self) -> bool {
        self.laws.is_empty()
    }

    /// Empties it; its memory is kept.
    pub fn clear(&mut self) {
        self.laws.clear();
        self.free.clear();
        self.delassus.clear();
    }

    /// A row of `G`.
    pub fn row(&self, row: usize) -> &[f64] {
        &self.delassus[row * self.len()..][..self.len()]
    }

    /// `G_kk`.
    pub fn diagonal(&self, row: usize) -> f64 {
        self.delassus[row * (self.len() + 1)]
    }

    /// `xi` of a row under the forces `x`.
    pub fn velocity(&self, row: usize, x: &[f64]) -> f64 {
        self.free[row] + dot(self.row(row), x)
    }

    /// The size of the velocities that balance each other: largest of `|F_k| + sum |G_kj x_j|`.
    pub fn scale(&self, x: &[f64]) -> f64 {
        let size = |row: usize| {
            let forces = self.row(row).iter().zip(x);
            self.free[row].abs() + forces.map(|(g, x)| (g * x).abs()).sum::<f64>()
        };
        (0..self.len()).map(size).fold(0.0, f64::max)
    }

    /// How far `x` is from the laws (m/s): largest of `|x_k - prox(x_k - r_k xi_k)| / r_k` with `r_k = 1/G_kk`
    /// (S2 eqs. 42, 51).
    pub fn residual(&self, x: &[f64]) -> f64 {
        let mut largest: f64 = 0.0;
        for row in 0..self.len() {
            let weight = 1.0 / self.diagonal(row);
            let [first, second] = self.defect(row, weight, x);
            largest = largest.max(first.abs().max(second.abs()) / weight);
        }
        // A comparison drops what is not a number.
        if x.iter().all(|x| x.is_finite()) {
            largest
        } else {
            f64::NAN
        }
    }

    /// `x - prox(x - r xi)` of a row, and of the row behind it for a [`Law::Disc`].
    pub fn defect(&self, row: usize, weight: f64, x: &[f64]) -> [f64; 2] {
        let own = x[row];
        let step = |row: usize| weight * self.velocity(row, x);
        match self.laws[row] {
            Law::Equality => [step(row), 0.0],
            Law::Normal => [own - (own - step(row)).max(0.0), 0.0],
            Law::Friction {
                normal,
                coefficient,
            } => {
                let radius = coefficient * x[normal].abs();
                [own - (own - step(row)).max(-radius).min(radius), 0.0]
            }
            Law::Disc {
                normal,
                coefficient,
            } => {
                let radius = coefficient * x[normal].abs();
                let target = [own - step(row), x[row + 1] - step(row + 1)];
                let [first, second] = onto_disc(radius, target);
                [own - first, x[row + 1] - second]
            }
            Law::Second => [0.0, 0.0],
            Law::Sliding { normal, factor } => [own - factor * x[normal].abs(), 0.0],
        }
    }

    /// Whether the forces `x` press a contact that jams: sliding as it does without forces, it would make so much
    /// friction that its normal force closes its gap further, `G_NN + G_NT lambda_T / lambda_N <= 0` (Painleve). Then
    /// friction stops it at once, by an impact without collision: its force is that of a jump of the velocities within
    /// the step.
    pub fn jams(&self, x: &[f64]) -> bool {
        let jams = |normal: usize, coupling: f64| {
            matches!(self.laws[normal], Law::Normal)
                && x[normal] > 0.0
                && self.diagonal(normal) + coupling <= 0.0
        };
        self.laws.iter().enumerate().any(|(row, law)| match *law {
            Law::Friction {
                normal,
                coefficient,
            } => {
                let factor = -coefficient * self.free[row].signum();
                jams(normal, factor * self.row(normal)[row])
            }
            Law::Disc {
                normal,
                coefficient,
            } => {
                let (free, couplings) = (&self.free[row..], &self.row(normal)[row..]);
                let speed = free[0].hypot(free[1]);
                let along = (couplings[0] * free[0] + couplings[1] * free[1]) / speed;
                jams(normal, -coefficient * along)
            }
            Law::Sliding { normal, factor } => jams(normal, factor * self.row(normal)[row]),
            Law::Equality | Law::Normal | Law::Second => false,
        })
    }
}

/// The point of a disc about 0 that is nearest to `target` (S2 eq. 7).
pub fn onto_disc(radius: f64, target: [f64; 2]) -> [f64; 2] {
    let size = target[0].hypot(target[1]);
    if size <= radius {
        target
    } else {
        target.map(|component| component * radius / size)
    }
}
