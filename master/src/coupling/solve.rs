//! The linear solver of the coupling system.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::{Mat, Par};

use super::pattern::Pattern;

/// LU decomposition with partial pivoting of an `n x n` matrix, in memory that is kept from step to step.
pub struct LinearSolver {
    matrix: Mat<f64>,
    rhs: Mat<f64>,
    permutation: Vec<usize>,
    inverse: Vec<usize>,
    memory: MemBuffer,
}

/// No unique solution: elimination found no pivot in this column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SingularColumn(pub usize);

/// A pivot below this share of the largest entry of its column is rounding.
const PIVOT_ROUNDING: f64 = 1e-14;

impl LinearSolver {
    /// A solver for matrices of a pattern.
    pub fn new(pattern: &Pattern) -> Self {
        let n = pattern.size();
        let factor = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Default::default());
        let solve = solve::solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq);
        Self {
            matrix: Mat::zeros(n, n),
            rhs: Mat::zeros(n, 1),
            permutation: vec![0; n],
            inverse: vec![0; n],
            memory: MemBuffer::new(factor.or(solve)),
        }
    }

    /// Solves `matrix x = rhs` and writes `x` over `rhs`; `values` are the entries of the matrix.
    pub fn solve(
        &mut self,
        pattern: &Pattern,
        values: &[f64],
        rhs: &mut [f64],
    ) -> Result<(), SingularColumn> {
        let n = rhs.len();
        self.matrix.fill(0.0);
        let places = pattern.rows().iter().zip(pattern.columns());
        for ((&row, &column), value) in places.zip(values) {
            self.matrix[(row, column)] = *value;
        }
        for (row, value) in rhs.iter().enumerate() {
            self.rhs[(row, 0)] = *value;
        }
        let (_, permutation) = factor::lu_in_place(
            self.matrix.as_mut(),
            &mut self.permutation,
            &mut self.inverse,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        for column in 0..n {
            let own = &values[pattern.starts()[column]..pattern.starts()[column + 1]];
            let largest = own
                .iter()
                .fold(0.0, |largest: f64, value| largest.max(value.abs()));
            let pivot = self.matrix[(column, column)].abs();
            if pivot.is_nan() || pivot <= PIVOT_ROUNDING * largest {
                return Err(SingularColumn(column));
            }
        }
        solve::solve_in_place(
            self.matrix.as_ref(),
            self.matrix.as_ref(),
            permutation,
            self.rhs.as_mut(),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
        for (row, value) in rhs.iter_mut().enumerate() {
            *value = self.rhs[(row, 0)];
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solve<const N: usize>(matrix: [[f64; N]; N], rhs: &mut [f64]) -> Result<(), SingularColumn> {
        let pattern = Pattern::new(N, |visit| {
            (0..N).for_each(|column| (0..N).for_each(|row| visit(row, column)));
        });
        let places = pattern.rows().iter().zip(pattern.columns());
        let values: Vec<f64> = places.map(|(&row, &column)| matrix[row][column]).collect();
        LinearSolver::new(&pattern).solve(&pattern, &values, rhs)
    }

    #[test]
    fn solves_a_system_that_needs_pivoting() {
        let matrix = [[0.0, 2.0, 1.0], [1e-3, -1.0, 0.5], [4.0, 0.0, 3.0]];
        let x = [0.3, -2.0, 7.0];
        let mut rhs = matrix.map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum());
        solve(matrix, &mut rhs).unwrap();
        for (found, expected) in rhs.iter().zip(x) {
            assert!((found - expected).abs() < 1e-13);
        }
    }

    #[test]
    fn a_redundant_column_is_named() {
        let redundant = solve([[1.0, 2.0], [2.0, 4.0]], &mut [1.0, 2.0]);
        assert_eq!(redundant, Err(SingularColumn(1)));
        assert_eq!(solve([[0.0]], &mut [1.0]), Err(SingularColumn(0)));
    }
}
