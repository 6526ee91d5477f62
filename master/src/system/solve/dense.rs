//! Dense elimination.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{Mat, Par};

use super::pivot::{SingularColumn, share};
use crate::system::pattern::Pattern;

/// LU decomposition in place.
pub struct Dense {
    matrix: Mat<f64>,
    rhs: Mat<f64>,
    permutation: Vec<usize>,
    inverse: Vec<usize>,
    memory: MemBuffer,
    /// The least pivot of the last factors, as a share of its column.
    pub least_pivot: f64,
}

impl Dense {
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
            least_pivot: 1.0,
        }
    }

    pub fn solve(
        &mut self,
        pattern: &Pattern,
        values: &[f64],
        rhs: &mut [f64],
    ) -> Result<(), SingularColumn> {
        self.matrix.fill(0.0);
        let places = pattern.rows().iter().zip(pattern.columns());
        for ((&row, &column), value) in places.zip(values) {
            self.matrix[(row, column)] = *value;
        }
        factor::lu_in_place(
            self.matrix.as_mut(),
            &mut self.permutation,
            &mut self.inverse,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        self.least_pivot = 1.0;
        for column in 0..pattern.size() {
            let own = &values[pattern.entries_of(column)];
            let share = share(self.matrix[(column, column)], own).ok_or(SingularColumn(column))?;
            self.least_pivot = self.least_pivot.min(share);
        }
        self.substitute(rhs);
        Ok(())
    }

    /// Solves with the factors at hand.
    pub fn substitute(&mut self, rhs: &mut [f64]) {
        for (row, value) in rhs.iter().enumerate() {
            self.rhs[(row, 0)] = *value;
        }
        let n = self.permutation.len();
        solve::solve_in_place(
            self.matrix.as_ref(),
            self.matrix.as_ref(),
            PermRef::new_checked(&self.permutation, &self.inverse, n),
            self.rhs.as_mut(),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
        for (row, value) in rhs.iter_mut().enumerate() {
            *value = self.rhs[(row, 0)];
        }
    }
}
