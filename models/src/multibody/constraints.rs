//! Reactions of conditions, from the Schur complement `S = J M^-1 J^T` of `[M J^T; J 0]`.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::body::Body;
use super::condition::Row;
use super::kinematics::{BodyMotion, Twist};

/// A condition whose part that the ones before do not imply is smaller than this, relative to its own size, is redundant.
const INDEPENDENT: f64 = 1e-6;

/// Conditions at one instant with the bodies' response to a unit multiplier of each.
#[derive(Debug)]
pub struct Constraints {
    rows: Vec<Row>,
    /// `M^-1 J^T`: twists of bodies a and b.
    responses: Vec<[Twist; 2]>,
}

/// Factors of `S`.
#[derive(Debug)]
pub struct Factors(Cholesky<f64, Dyn>);

impl Constraints {
    /// Of rows at these motions.
    pub fn new(bodies: &[Body], motions: &[BodyMotion], rows: Vec<Row>) -> Self {
        let response = |row: &Row| {
            [0, 1].map(|end| {
                let place = row.bodies[end];
                bodies[place].response(&motions[place], &row.loads[end])
            })
        };
        Self {
            responses: rows.iter().map(response).collect(),
            rows,
        }
    }

    /// The rows.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The factors of `S`; `None` if rows depend on each other.
    pub fn factors(&self) -> Option<Factors> {
        Cholesky::new(self.complement()).map(Factors)
    }

    /// Adds `factor M^-1 J^T multipliers` to the twists of all bodies.
    pub fn add_responses(&self, factor: f64, multipliers: &DVector<f64>, twists: &mut [Twist]) {
        for ((row, response), multiplier) in self.rows.iter().zip(&self.responses).zip(multipliers)
        {
            for (place, response) in row.bodies.into_iter().zip(response) {
                twists[place] = twists[place].plus(factor * multiplier, response);
            }
        }
    }

    /// The first row that the rows before it imply, by Cholesky's decomposition row by row.
    pub fn first_redundant(&self) -> Option<usize> {
        let complement = self.complement();
        let n = self.rows.len();
        let mut factor = DMatrix::<f64>::zeros(n, n);
        for i in 0..n {
            for j in 0..i {
                let sum = (0..j).map(|k| factor[(i, k)] * factor[(j, k)]).sum::<f64>();
                factor[(i, j)] = (complement[(i, j)] - sum) / factor[(j, j)];
            }
            let sum = (0..i).map(|k| factor[(i, k)].powi(2)).sum::<f64>();
            let left = complement[(i, i)] - sum;
            if left <= INDEPENDENT * INDEPENDENT * complement[(i, i)] {
                return Some(i);
            }
            factor[(i, i)] = left.sqrt();
        }
        None
    }

    fn complement(&self) -> DMatrix<f64> {
        let n = self.rows.len();
        let mut complement = DMatrix::zeros(n, n);
        for i in 0..n {
            for j in 0..=i {
                let value = self.product(i, j);
                complement[(i, j)] = value;
                complement[(j, i)] = value;
            }
        }
        complement
    }

    /// `J_i M^-1 J_j^T`.
    fn product(&self, i: usize, j: usize) -> f64 {
        let mut product = 0.0;
        for (place, load) in self.rows[i].bodies.into_iter().zip(&self.rows[i].loads) {
            let responses = self.rows[j].bodies.into_iter().zip(&self.responses[j]);
            for (_, response) in responses.filter(|(other, _)| *other == place) {
                product += response.power(load);
            }
        }
        product
    }
}

impl Factors {
    /// The multipliers of `S multipliers = right`.
    pub fn solve(&self, right: DVector<f64>) -> DVector<f64> {
        self.0.solve(&right)
    }
}
