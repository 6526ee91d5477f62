//! Which entries the Jacobian has.

use std::ops::Range;

use super::unknowns::{Term, Unknowns};
use crate::layout::Layout;

/// Visits row and column of every term of the Jacobian, in the order in which they are assembled.
pub(super) fn visit_entries(
    layout: &Layout,
    unknowns: &Unknowns,
    variables: &[Vec<usize>],
    visit: &mut dyn FnMut(usize, usize),
) {
    let visit_row = |subsystem: usize, rows: Range<usize>, visit: &mut dyn FnMut(usize, usize)| {
        for input in layout.input_range(subsystem) {
            let driven = &layout.inputs[input];
            if !driven.is_perturbed {
                continue;
            }
            for raised in 0..unknowns.columns(input).len() {
                for row in rows.clone() {
                    let mut visit = |term: Term| visit(row, term.unknown);
                    unknowns.visit_terms(driven, &variables[input], raised, &mut visit);
                }
            }
        }
    };
    let mut first_row = 0;
    for joint in &layout.joints {
        let rows = first_row..first_row + joint.joint.len();
        for bound in &joint.ends {
            visit_row(bound.subsystem, rows.clone(), visit);
        }
        first_row = rows.end;
    }
    for exchanged in &layout.exchanged {
        let own = exchanged.first..exchanged.first + exchanged.size();
        for variable in own.clone() {
            unknowns
                .of(variable)
                .for_each(|unknown| visit(variable, unknown));
        }
        visit_row(exchanged.subsystem, own, visit);
    }
}
