//! The linear solver of the coupling system: dense when it is small or full, sparse otherwise, bordered where conditions are redundant.

mod bordered;
mod dense;
mod pivot;
mod sparse;
#[cfg(test)]
mod tests;

use bordered::Bordered;
use dense::Dense;
pub use pivot::SingularColumn;
use sparse::Sparse;

use super::pattern::Pattern;
use crate::layout::Border;
use std::ops::Range;

/// LU decomposition with partial pivoting of a square matrix with a fixed pattern, in memory that is kept from step to step.
/// It runs on one thread, so the bits of the solution depend on nothing but the numbers.
pub struct LinearSolver {
    elimination: Elimination,
}

enum Elimination {
    Dense(Dense),
    Sparse(Box<Sparse>),
    Bordered(Box<Bordered>),
}

/// One multiplication of the sparse elimination takes as long as so many of the dense one: measured with full factors, 5 at
/// 30 variables and 25 at 500 (bench `chain`).
const COST_OF_SPARSE: usize = 20;

impl LinearSolver {
    /// The solver for matrices of a pattern that is likely to be the faster one, from the number of multiplications: for a
    /// chain of planar hinges the sparse one from about 20 bodies on, for bodies that all meet in one the dense one for
    /// any number.
    pub fn new(pattern: &Pattern) -> Self {
        let mut sparse = Sparse::new(pattern);
        match sparse.multiplications(pattern) {
            Some(multiplications)
                if COST_OF_SPARSE * multiplications < pattern.size().pow(3) / 3 =>
            {
                Self {
                    elimination: Elimination::Sparse(Box::new(sparse)),
                }
            }
            _ => Self::dense(pattern),
        }
    }

    /// The solver for matrices of a pattern with redundant conditions, if there is a border; `unknowns` are those of each multiplier.
    pub fn bordered(pattern: &Pattern, border: &Border, unknowns: &[Range<usize>]) -> Self {
        match border.is_empty() {
            true => Self::new(pattern),
            false => Self {
                elimination: Elimination::Bordered(Box::new(Bordered::new(
                    pattern, border, unknowns,
                ))),
            },
        }
    }

    /// A solver that treats the matrix as full: about n^3 / 3 multiplications for each solution.
    pub fn dense(pattern: &Pattern) -> Self {
        Self {
            elimination: Elimination::Dense(Dense::new(pattern)),
        }
    }

    /// A solver that works on the entries of the pattern and their fill only; the order of the columns is found here, once.
    pub fn sparse(pattern: &Pattern) -> Self {
        Self {
            elimination: Elimination::Sparse(Box::new(Sparse::new(pattern))),
        }
    }

    /// Whether the elimination is the sparse one.
    pub fn is_sparse(&self) -> bool {
        matches!(self.elimination, Elimination::Sparse(_))
    }

    /// Solves `matrix x = rhs` and writes `x` over `rhs`; `values` are the entries of the matrix in the order of `pattern`,
    /// which is the one that the solver was made for.
    ///
    /// # Errors
    /// [`SingularColumn`] if there is no unique solution; `rhs` is then as it was.
    pub fn solve(
        &mut self,
        pattern: &Pattern,
        values: &[f64],
        rhs: &mut [f64],
    ) -> Result<(), SingularColumn> {
        match &mut self.elimination {
            Elimination::Dense(dense) => dense.solve(pattern, values, rhs),
            Elimination::Sparse(sparse) => sparse.solve(pattern, values, rhs),
            Elimination::Bordered(own) => own.solve(pattern, values, rhs),
        }
    }

    /// The least pivot of the last factors, as a share of the largest entry of its column: how far the matrix is from a singular one. 1 before the
    /// first solution.
    pub fn least_pivot(&self) -> f64 {
        match &self.elimination {
            Elimination::Dense(dense) => dense.least_pivot,
            Elimination::Sparse(sparse) => sparse.least_pivot,
            Elimination::Bordered(own) => own.least_pivot(),
        }
    }

    /// Solves with the factors of the last matrix that [`LinearSolver::solve`] solved with success, and writes the solution over
    /// `rhs`.
    pub fn solve_again(&mut self, rhs: &mut [f64]) {
        match &mut self.elimination {
            Elimination::Dense(dense) => dense.substitute(rhs),
            Elimination::Sparse(sparse) => sparse.substitute(rhs),
            Elimination::Bordered(own) => own.substitute(rhs),
        }
    }
}
