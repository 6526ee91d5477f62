//! Factors of a matrix with a border and a band.

use super::band::BandFactors;
use super::{BorderedBand, Shape, dense, dot};

/// A matrix has no inverse: its pivot in this row, counted within its border or its band, is 0 or not finite.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is singular (pivot of row {row})")]
pub struct Singular {
    /// Row of the pivot.
    pub row: usize,
}

/// Factors by block elimination of the band: `A = L_A U_A`, then the Schur complement `B - R A^-1 C` of the border.
#[derive(Debug, Clone)]
pub struct Factors {
    shape: Shape,
    band: BandFactors,
    /// `R`, `border` rows of `banded` numbers.
    right: Vec<f64>,
    /// `A^-1 C`, `border` rows (its columns) of `banded` numbers.
    eliminated: Vec<f64>,
    complement: Vec<f64>,
    pivots: Vec<usize>,
}

impl Factors {
    /// Room for factors of matrices of this structure.
    pub fn new(shape: Shape) -> Self {
        Self {
            shape,
            band: BandFactors::new(shape.banded, shape.half_bandwidth),
            right: vec![0.0; shape.border * shape.banded],
            eliminated: vec![0.0; shape.border * shape.banded],
            complement: vec![0.0; shape.border * shape.border],
            pivots: vec![0; shape.border],
        }
    }

    /// Factors a matrix.
    ///
    /// # Errors
    /// [`Singular`].
    pub fn factor(&mut self, matrix: &BorderedBand) -> Result<(), Singular> {
        let Shape { border, banded, .. } = self.shape;
        let order = self.shape.order();
        if banded > 0 {
            self.band.factor(&matrix.band)?;
            for column in 0..border {
                let eliminated = &mut self.eliminated[column * banded..][..banded];
                for (row, value) in eliminated.iter_mut().enumerate() {
                    *value = matrix.left[row * border + column];
                }
                self.band.solve(eliminated);
            }
        }
        for row in 0..border {
            let (head, tail) = matrix.top[row * order..][..order].split_at(border);
            self.right[row * banded..][..banded].copy_from_slice(tail);
            for (column, &value) in head.iter().enumerate() {
                let eliminated = &self.eliminated[column * banded..][..banded];
                self.complement[row * border + column] = value - dot(tail, eliminated);
            }
        }
        dense::factor(border, &mut self.complement, &mut self.pivots)
    }

    /// Solves; `b` becomes the solution.
    pub fn solve(&self, b: &mut [f64]) {
        let Shape { border, banded, .. } = self.shape;
        let (head, tail) = b.split_at_mut(border);
        if banded > 0 {
            self.band.solve(tail);
            for (row, value) in head.iter_mut().enumerate() {
                *value -= dot(&self.right[row * banded..][..banded], tail);
            }
        }
        dense::solve(border, &self.complement, &self.pivots, head);
        if banded > 0 {
            for (column, &value) in head.iter().enumerate() {
                super::add_scaled(-value, &self.eliminated[column * banded..][..banded], tail);
            }
        }
    }
}
