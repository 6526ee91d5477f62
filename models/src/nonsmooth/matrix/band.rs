//! Banded systems, in place.

use super::Singular;

/// Factors of a matrix with `half` diagonals on each side: `P A = L U` with exchanges of neighbouring rows, so that `U`
/// has `2 half` diagonals above its main one (LAPACK's dgbtf2; Golub & Van Loan, Sect. 4.3.5).
#[derive(Debug, Clone)]
pub struct BandFactors {
    order: usize,
    half: usize,
    /// `order` rows of `3 half + 1` numbers: column `j` of row `i` at `j - i + half`.
    rows: Vec<f64>,
    pivots: Vec<usize>,
}

impl BandFactors {
    pub fn new(order: usize, half: usize) -> Self {
        Self {
            order,
            half,
            rows: vec![0.0; order * (3 * half + 1)],
            pivots: vec![0; order],
        }
    }

    fn width(&self) -> usize {
        3 * self.half + 1
    }

    /// Factors the matrix whose rows have `2 half + 1` numbers each, as [`super::BorderedBand`] keeps them.
    pub fn factor(&mut self, band: &[f64]) -> Result<(), Singular> {
        let (half, width) = (self.half, self.width());
        let narrow = 2 * half + 1;
        for (row, given) in self
            .rows
            .chunks_exact_mut(width)
            .zip(band.chunks_exact(narrow))
        {
            row[..narrow].copy_from_slice(given);
            row[narrow..].fill(0.0);
        }
        for column in 0..self.order {
            let below = (column + half + 1).min(self.order);
            let at = |row: usize| row * width + column + half - row;
            let pivot = (column..below)
                .max_by(|&i, &j| self.rows[at(i)].abs().total_cmp(&self.rows[at(j)].abs()))
                .unwrap_or(column);
            self.pivots[column] = pivot;
            let end = (column + 2 * half + 1).min(self.order);
            if pivot != column {
                for j in column..end {
                    self.rows.swap(
                        column * width + j + half - column,
                        pivot * width + j + half - pivot,
                    );
                }
            }
            let diagonal = self.rows[at(column)];
            if diagonal == 0.0 || !diagonal.is_finite() {
                return Err(Singular { row: column });
            }
            for row in column + 1..below {
                self.eliminate(row, column, end, diagonal);
            }
        }
        Ok(())
    }

    fn eliminate(&mut self, row: usize, column: usize, end: usize, diagonal: f64) {
        let (half, width) = (self.half, self.width());
        let (above, below) = self.rows.split_at_mut(row * width);
        let pivot_row = &above[column * width + half..][..end - column];
        let own = &mut below[column + half - row..][..end - column];
        let factor = own[0] / diagonal;
        own[0] = factor;
        if factor != 0.0 {
            for (own, pivot) in own[1..].iter_mut().zip(&pivot_row[1..]) {
                *own -= factor * pivot;
            }
        }
    }

    /// Solves; `b` becomes the solution.
    pub fn solve(&self, b: &mut [f64]) {
        let (half, width) = (self.half, self.width());
        for column in 0..self.order {
            b.swap(column, self.pivots[column]);
            let (done, rest) = b.split_at_mut(column + 1);
            let value = done[column];
            if value != 0.0 {
                for (below, b) in rest.iter_mut().take(half).enumerate() {
                    let row = column + 1 + below;
                    *b -= self.rows[row * width + column + half - row] * value;
                }
            }
        }
        for row in (0..self.order).rev() {
            let own = &self.rows[row * width + half..];
            let end = (row + 2 * half + 1).min(self.order);
            let sum = super::dot(&own[1..end - row], &b[row + 1..end]);
            b[row] = (b[row] - sum) / own[0];
        }
    }
}
