//! Conditions of the joints that follow from others at the start.

use nalgebra::{DMatrix, SVD};

use crate::layout::{Border, Layout};
use crate::results::Redundancy;
use crate::system::pattern::Pattern;

/// Singular values below this share of the largest are none: accelerations are linear in loads, so that columns are known to rounding.
const RANK: f64 = 1e-9;

/// The part of a multiplier in those that do nothing together from which on its joint is named.
const NAMED: f64 = 0.05;

/// Which conditions on acceleration level follow from others; none if a load does nothing at all. `values` are the entries of their derivatives
/// with respect to the multipliers and exchanged variables.
pub(super) fn find(layout: &Layout, pattern: &Pattern, values: &[f64]) -> Border {
    let rows = layout.rows.len();
    let mut matrix = DMatrix::zeros(rows, rows);
    for ((&row, &column), value) in { pattern.rows().iter() }.zip(pattern.columns()).zip(values) {
        if row < rows && column < rows {
            matrix[(row, column)] = *value;
        }
    }
    let mut border = Border::default();
    for mut row in matrix.row_iter_mut() {
        let scale = inverse_size(row.amax());
        row *= scale;
        border.rows.push(scale);
    }
    for mut column in matrix.column_iter_mut() {
        let scale = inverse_size(column.amax());
        column *= scale;
        border.columns.push(scale);
    }
    if rows == 0 || matrix.column_iter().any(|column| column.amax() == 0.0) {
        return border;
    }
    let SVD {
        u: Some(left),
        v_t: Some(right),
        singular_values: sizes,
    } = SVD::new(matrix, true, true)
    else {
        return border;
    };
    for place in (0..rows).filter(|&place| sizes[place] <= RANK * sizes[0]) {
        border
            .left
            .push(left.column(place).iter().copied().collect());
        border
            .right
            .push(right.row(place).iter().copied().collect());
    }
    border
}

/// What is told of it.
pub(super) fn told(layout: &Layout) -> Redundancy {
    let border = &layout.border;
    let mut joints = Vec::new();
    for (row, _) in layout.rows.iter().enumerate() {
        let name = &layout.joint_of(row).name;
        let has_part = border.right.iter().any(|own| own[row].abs() > NAMED);
        if has_part && !joints.contains(name) {
            joints.push(name.clone());
        }
    }
    joints.sort();
    Redundancy {
        conditions: border.len(),
        joints,
    }
}

/// The power of two next to the inverse of a size; 1 of nothing.
fn inverse_size(size: f64) -> f64 {
    let power = (-size.log2().round()).exp2();
    if power.is_normal() { power } else { 1.0 }
}
