//! Least-norm solutions of small linear systems that may be singular: `x = pinv(A) b`.

use crate::nonsmooth::matrix::{dense_factor, dot};

/// A pivot below this share of the largest means dependent rows.
const DEPENDENT: f64 = 1e-11;
/// Singular values below this share of the largest count as 0: rounding of a Delassus matrix is some units of 1e-16.
const RANK: f64 = 1e-11;
/// Sweeps of rotations; ten are usual.
const MOST_SWEEPS: usize = 60;

/// Room for the singular value decomposition by one-sided Jacobi rotations (Golub & Van Loan, Sect. 8.6.4).
#[derive(Debug, Clone, Default)]
pub struct LeastNorm {
    /// Columns of `A`, then of `U S`.
    columns: Vec<f64>,
    /// Columns of `V`.
    right: Vec<f64>,
    solution: Vec<f64>,
}

impl LeastNorm {
    /// Takes memory for this many unknowns.
    pub fn reserve(&mut self, n: usize) {
        self.columns.reserve(n * n);
        self.right.reserve(n * n);
        self.solution.reserve(n);
    }

    /// Solves `A x = b` with `A` row by row in the sense of least squares and least norm; `b` becomes `x`.
    pub fn solve(&mut self, n: usize, a: &[f64], b: &mut [f64]) {
        self.columns.clear();
        self.columns.resize(n * n, 0.0);
        self.right.clear();
        self.right.resize(n * n, 0.0);
        for column in 0..n {
            for row in 0..n {
                self.columns[column * n + row] = a[row * n + column];
            }
            self.right[column * n + column] = 1.0;
        }
        for _ in 0..MOST_SWEEPS {
            if !self.sweep(n) {
                break;
            }
        }
        self.apply(n, b);
    }

    /// Makes every pair of columns orthogonal; whether anything was to be done.
    fn sweep(&mut self, n: usize) -> bool {
        let mut is_changed = false;
        for p in 0..n {
            for q in p + 1..n {
                let [first, second] = pair(&mut self.columns, n, p, q);
                let (pp, qq, pq) = (dot(first, first), dot(second, second), dot(first, second));
                if pq.abs() <= f64::EPSILON * (pp * qq).sqrt() {
                    continue;
                }
                is_changed = true;
                let zeta = (qq - pp) / (2.0 * pq);
                let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
                let sine = cosine * tangent;
                rotate(first, second, cosine, sine);
                let [first, second] = pair(&mut self.right, n, p, q);
                rotate(first, second, cosine, sine);
            }
        }
        is_changed
    }

    fn apply(&mut self, n: usize, b: &mut [f64]) {
        let norms = |columns: &[f64], k: usize| dot(&columns[k * n..][..n], &columns[k * n..][..n]);
        let largest = (0..n).map(|k| norms(&self.columns, k)).fold(0.0, f64::max);
        self.solution.clear();
        self.solution.resize(n, 0.0);
        for k in 0..n {
            let squared = norms(&self.columns, k);
            if squared > RANK * RANK * largest {
                let share = dot(&self.columns[k * n..][..n], b) / squared;
                crate::nonsmooth::matrix::add_scaled(
                    share,
                    &self.right[k * n..][..n],
                    &mut self.solution,
                );
            }
        }
        b.copy_from_slice(&self.solution);
    }
}

/// Factors a matrix in place; whether it has full rank, so that [`LeastNorm`] is not needed.
pub fn is_regular(n: usize, matrix: &mut [f64], pivots: &mut [usize]) -> bool {
    if dense_factor(n, matrix, pivots).is_err() {
        return false;
    }
    let pivots = || (0..n).map(|k| matrix[k * (n + 1)].abs());
    let smallest = pivots().fold(f64::INFINITY, f64::min);
    smallest > DEPENDENT * pivots().fold(0.0, f64::max)
}

fn pair(columns: &mut [f64], n: usize, p: usize, q: usize) -> [&mut [f64]; 2] {
    let (head, tail) = columns.split_at_mut(q * n);
    [&mut head[p * n..][..n], &mut tail[..n]]
}

fn rotate(first: &mut [f64], second: &mut [f64], cosine: f64, sine: f64) {
    for (a, b) in first.iter_mut().zip(second) {
        (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_singular_system_gets_its_solution_of_least_norm() {
        // Rows 2 and 3 are the same; b is in the range.
        let a = [3.0, 1.0, -0.7, 1.0, 2.0, 0.4, 1.0, 2.0, 0.4];
        let mut b = [1.3, 0.9, 0.9];
        LeastNorm::default().solve(3, &a, &mut b);
        for row in a.chunks_exact(3).zip([1.3, 0.9, 0.9]) {
            assert!((dot(row.0, &b) - row.1).abs() < 1e-14, "{b:?}");
        }
        // Null space: cross product of the two independent rows; least norm is orthogonal to it.
        let null = [1.0 * 0.4 + 0.7 * 2.0, -0.7 - 3.0 * 0.4, 3.0 * 2.0 - 1.0];
        assert!(dot(&null, &b).abs() < 1e-13, "{b:?}");
    }
}
