//! What a look-ahead is asked for.

use super::subsystem::Ahead;
use crate::results::Cause;
use crate::signal::Curves;
use crate::system::Perturbation;

/// A look-ahead: what it is asked for.
#[derive(Clone, Copy)]
pub(crate) struct Look<'a> {
    /// How far it goes.
    pub ahead: Ahead,
    /// Where it starts (s).
    pub t: f64,
    /// How long it is (s).
    pub length: f64,
    /// The curves of all coupling variables (S1 eq. 56).
    pub curves: &'a dyn Curves,
    /// Curves with the same values at its end that can be raised (S1 eq. 59).
    pub raised: &'a dyn Curves,
    /// The perturbed inputs.
    pub perturbed: &'a [Perturbation],
    /// What it is for.
    pub cause: Cause,
}
