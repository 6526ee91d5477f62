//! Pivots that are none.

/// No unique solution: elimination found no pivot in this column, because the matrix has an empty column or this one depends
/// on those eliminated before it. The dense elimination goes from the first column to the last, the sparse one in an order
/// that keeps its factors sparse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SingularColumn(pub usize);

/// A pivot below this share of the largest entry of its column is rounding.
const PIVOT_ROUNDING: f64 = 1e-14;

/// A pivot as a share of the largest entry of its column in the matrix, which is `column`; `None` if it is zero up to rounding, or not a number.
pub(super) fn share(pivot: f64, column: &[f64]) -> Option<f64> {
    let largest = column
        .iter()
        .fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let share = pivot.abs() / largest;
    (share > PIVOT_ROUNDING).then_some(share)
}
