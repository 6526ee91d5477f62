//! Loops of connected signals without delay.
//!
//! Where connected outputs depend on connected inputs at once, `w - y(w) = 0` is an algebraic loop. Its matrix is `I - A` with
//! `A = dy/dw`: the signals are determined unless 1 is an eigenvalue of `A`, for a single loop: unless the product of the gains
//! around it is 1.

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{DMatrix, DVector};

use crate::system::pattern::Pattern;

/// Eigenvalues of `I - A` below this are taken for 0: `A` is made of finite differences.
const ROUNDING: f64 = 1e-7;

/// Balancing squares the gains, which must not overflow.
const LARGEST_GAIN: f64 = 1e100;

/// The conditions `w - y(w) = 0` of the exchanged variables, linearised, with the multipliers held.
pub(super) struct SignalBlock {
    matrix: DMatrix<f64>,
    rhs: DVector<f64>,
}

impl SignalBlock {
    /// The part of a system behind its first `rows` rows and columns.
    pub(super) fn of((pattern, values, rhs): (&Pattern, &[f64], &[f64]), rows: usize) -> Self {
        let size = rhs.len() - rows;
        let mut matrix = DMatrix::zeros(size, size);
        let places = pattern.rows().iter().zip(pattern.columns());
        for ((&row, &column), value) in places.zip(values) {
            if row >= rows && column >= rows {
                matrix[(row - rows, column - rows)] = *value;
            }
        }
        Self {
            matrix,
            rhs: DVector::from_column_slice(&rhs[rows..]),
        }
    }

    /// The change of the exchanged variables that meets their conditions; `None` if the matrix has no inverse.
    pub(super) fn solution(&self) -> Option<DVector<f64>> {
        self.matrix.clone().lu().solve(&self.rhs)
    }

    /// The variable with the largest part in a loop that leaves the variables undetermined, if there is one.
    ///
    /// With the singular vectors `u`, `v` of the smallest singular value `s`, an eigenvalue near 0 is `s / (u v)`, and
    /// `u_i v_i` is the part that variable `i` takes in it. The eigenvalues do not depend on the units of the signals; the
    /// singular values do, so the matrix is cut to its loops and balanced before.
    pub(super) fn undetermined(&self) -> Option<usize> {
        if self.matrix.is_empty() {
            return None;
        }
        let svd = loops_of(&self.matrix).svd(true, true);
        let (u, v) = (svd.u?, svd.v_t?);
        let (last, smallest) = svd.singular_values.argmin();
        let parts: Vec<f64> = (0..self.matrix.nrows())
            .map(|signal| u[(signal, last)] * v[(last, signal)])
            .collect();
        let eigenvalue_limit = ROUNDING * parts.iter().sum::<f64>().abs();
        let largest = |a: &usize, b: &usize| parts[*a].abs().total_cmp(&parts[*b].abs());
        (0..parts.len())
            .max_by(largest)
            .filter(|_| smallest <= eigenvalue_limit)
    }
}

/// `I - A` without the entries of `A` that belong to no loop, which do not change the eigenvalues, balanced.
fn loops_of(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let size = matrix.nrows();
    let mut gains = DMatrix::identity(size, size) - matrix;
    let reaches = reachable(&gains);
    for ((row, column), is_reached) in (0..size)
        .flat_map(|row| (0..size).map(move |column| (row, column)))
        .zip(&reaches)
    {
        if !(*is_reached && reaches[column * size + row]) {
            gains[(row, column)] = 0.0;
        }
    }
    if gains.amax() < LARGEST_GAIN {
        balance_parlett_reinsch(&mut gains);
    }
    DMatrix::identity(size, size) - gains
}

/// For each row and column, row by row, whether the first depends on the second, however many signals lie between.
fn reachable(gains: &DMatrix<f64>) -> Vec<bool> {
    let size = gains.nrows();
    let mut reaches: Vec<bool> = (0..size * size)
        .map(|place| gains[(place / size, place % size)] != 0.0)
        .collect();
    for through in 0..size {
        for row in 0..size {
            if reaches[row * size + through] {
                for column in 0..size {
                    reaches[row * size + column] |= reaches[through * size + column];
                }
            }
        }
    }
    reaches
}

#[cfg(test)]
mod tests {
    use super::*;

    fn undetermined<const N: usize>(gains: [[f64; N]; N]) -> Option<usize> {
        let matrix = DMatrix::from_fn(N, N, |i, j| f64::from(u8::from(i == j)) - gains[i][j]);
        let rhs = DVector::zeros(N);
        SignalBlock { matrix, rhs }.undetermined()
    }

    #[test]
    fn a_chain_is_determined_whatever_its_gains() {
        for gain in [1.0, -3.0, 1e12, 1e-12] {
            let chain = [[0.0, 0.0, 0.0], [gain, 0.0, 0.0], [7.0, gain, 0.0]];
            assert_eq!(undetermined(chain), None, "{gain}");
        }
    }

    #[test]
    fn a_loop_is_determined_unless_its_gain_is_one() {
        for unit in [1.0, 1e6, 1e-9] {
            let closed = |gain: f64| [[0.0, unit], [gain / unit, 0.0]];
            for gain in [-1.0, 0.999, 1.001, -40.0, 1e5] {
                assert_eq!(undetermined(closed(gain)), None, "{gain} {unit}");
            }
            assert!(undetermined(closed(1.0)).is_some(), "{unit}");
            assert!(undetermined(closed(1.0 + 1e-10)).is_some(), "{unit}");
        }
    }

    /// The loop is that of signals 1 and 2; signal 0 drives it and signal 3 listens, both with larger gains.
    #[test]
    fn the_variable_that_is_named_belongs_to_the_loop() {
        let gains = [
            [0.0, 0.0, 0.0, 0.0],
            [50.0, 0.0, 2.0, 0.0],
            [0.0, 0.5, 0.0, 0.0],
            [0.0, 0.0, 80.0, 0.0],
        ];
        assert!(matches!(undetermined(gains), Some(1 | 2)));
    }

    #[test]
    fn a_change_that_meets_the_conditions() {
        let pattern = Pattern::new(3, |visit| {
            (0..3).for_each(|column| (0..3).for_each(|row| visit(row, column)));
        });
        // Column by column; the first row and column belong to a multiplier.
        let values = [9.0, 5.0, 4.0, 3.0, 1.0, -2.0, 6.0, 3.0, 1.0];
        let block = SignalBlock::of((&pattern, &values, &[8.0, 1.0, 12.0]), 1);
        let solution = block.solution().unwrap();
        // w1 + 3 w2 = 1, -2 w1 + w2 = 12
        assert!((solution[0] + 5.0).abs() < 1e-14 && (solution[1] - 2.0).abs() < 1e-14);
    }
}
