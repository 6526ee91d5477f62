//! Solutions where conditions are redundant.

use super::dense::Dense;
use super::pivot::SingularColumn;
use crate::layout::Border;
use crate::system::pattern::Pattern;
use std::ops::Range;

/// Solves `A x = b` of a singular matrix as
///
/// ```text
/// [ R A C   U ] [ y ]   [ R b ]
/// [  V^T    0 ] [ z ] = [  0  ] ,   x = C y
/// ```
///
/// with the singular vectors `U`, `V` of singular value 0 that the mechanism had at the start, for each unknown of a multiplier anew. The matrix is
/// regular as long as those of the present step are not at right angles to them. So of all multipliers that do the same those are found that have
/// no part in `V`: of least norm at the start, and where the directions of loads do not turn for good. What does nothing of them is the same
/// function of time in every step, so that the order of the method is kept.
pub struct Bordered {
    pattern: Pattern,
    values: Vec<f64>,
    rhs: Vec<f64>,
    /// `R` and `C` of the rows and columns of `A`.
    scales: [Vec<f64>; 2],
    dense: Dense,
}

impl Bordered {
    /// For matrices of a pattern whose unknowns belong to the multipliers as `unknowns` tells, multiplier by multiplier.
    pub fn new(pattern: &Pattern, border: &Border, unknowns: &[Range<usize>]) -> Self {
        let n = pattern.size();
        let mut scales = [vec![1.0; n], vec![1.0; n]];
        for (row, own) in unknowns.iter().enumerate() {
            for unknown in own.clone() {
                scales[0][unknown] = border.rows[row];
                scales[1][unknown] = border.columns[row];
            }
        }
        let each = unknowns.first().map_or(0, Range::len);
        let size = n + border.len() * each;
        let mut terms = Vec::new();
        let base = pattern.rows().iter().zip(pattern.columns());
        terms.extend(base.map(|(&row, &column)| (row, column, 0.0)));
        for number in 0..border.len() {
            for (row, own) in unknowns.iter().enumerate() {
                for (place, unknown) in own.clone().enumerate() {
                    let edge = n + number * each + place;
                    terms.push((unknown, edge, border.left[number][row]));
                    terms.push((edge, unknown, border.right[number][row]));
                }
            }
        }
        let pattern = Pattern::new(size, |visit| {
            terms
                .iter()
                .for_each(|&(row, column, _)| visit(row, column));
        });
        let mut values = vec![0.0; pattern.entries()];
        for (slot, (_, _, value)) in terms.iter().enumerate() {
            values[pattern.entry(slot)] = *value;
        }
        Self {
            dense: Dense::new(&pattern),
            rhs: vec![0.0; size],
            values,
            pattern,
            scales,
        }
    }

    pub fn solve(
        &mut self,
        pattern: &Pattern,
        values: &[f64],
        rhs: &mut [f64],
    ) -> Result<(), SingularColumn> {
        let [rows, columns] = &self.scales;
        let places = pattern.rows().iter().zip(pattern.columns());
        for (slot, ((&row, &column), value)) in places.zip(values).enumerate() {
            self.values[self.pattern.entry(slot)] = rows[row] * value * columns[column];
        }
        self.take(rhs);
        self.dense
            .solve(&self.pattern, &self.values, &mut self.rhs)?;
        self.give(rhs);
        Ok(())
    }

    /// Solves with the factors at hand.
    pub fn substitute(&mut self, rhs: &mut [f64]) {
        self.take(rhs);
        self.dense.substitute(&mut self.rhs);
        self.give(rhs);
    }

    /// The least pivot of the last factors, as a share of its column.
    pub fn least_pivot(&self) -> f64 {
        self.dense.least_pivot
    }

    fn take(&mut self, rhs: &[f64]) {
        self.rhs.fill(0.0);
        for ((own, value), scale) in self.rhs.iter_mut().zip(rhs).zip(&self.scales[0]) {
            *own = scale * value;
        }
    }

    fn give(&self, solution: &mut [f64]) {
        for ((value, own), scale) in solution.iter_mut().zip(&self.rhs).zip(&self.scales[1]) {
            *value = scale * own;
        }
    }
}
