//! Pivots that are none.

/// No unique solution: elimination found no pivot in this column, because the matrix has an empty column or this one depends
/// on those eliminated before it. The dense elimination goes from the first column to the last, the sparse one in an order
/// that keeps its factors sparse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SingularColumn(pub usize);

/// A pivot below this share of the largest entry of its column is rounding.
const PIVOT_ROUNDING: f64 = 1e-14;

/// Whether a pivot is zero up to rounding, or not a number; `column` are the entries of its column in the matrix.
pub(super) fn is_rounding(pivot: f64, column: &[f64]) -> bool {
    let largest = column
        .iter()
        .fold(0.0, |largest: f64, value| largest.max(value.abs()));
    pivot.is_nan() || pivot.abs() <= PIVOT_ROUNDING * largest
}
