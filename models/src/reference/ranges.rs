//! The rules of numbers that references are built from.

use super::ReferenceError;

pub(super) fn positive(field: &'static str, value: f64) -> Result<(), ReferenceError> {
    let allowed = "a finite number greater than 0";
    rule(field, value, allowed, value > 0.0)
}

pub(super) fn not_negative(field: &'static str, value: f64) -> Result<(), ReferenceError> {
    rule(field, value, "a finite number, 0 or greater", value >= 0.0)
}

pub(super) fn finite(field: &'static str, value: f64) -> Result<(), ReferenceError> {
    rule(field, value, "a finite number", true)
}

pub(super) fn all_finite(field: &'static str, values: &[f64]) -> Result<(), ReferenceError> {
    values.iter().try_for_each(|&value| finite(field, value))
}

fn rule(
    field: &'static str,
    value: f64,
    allowed: &'static str,
    is_allowed: bool,
) -> Result<(), ReferenceError> {
    if is_allowed && value.is_finite() {
        return Ok(());
    }
    Err(ReferenceError::OutOfRange {
        field,
        value,
        allowed,
    })
}
