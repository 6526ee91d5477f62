//! Where the coupling conditions are linearised.

use nalgebra::UnitQuaternion;

/// The values about which the system is linearised.
#[derive(Clone, Copy)]
pub struct Point<'a> {
    /// Coupling variables at the end of the step.
    pub w: &'a [f64],
    /// Coupling variables at the shares of the step at which loads are raised, without the last one, which is the end.
    pub inner: &'a [Vec<f64>],
    /// Coupling variables at the looks at the inside of the step: integrals of their curves, and values at instants.
    pub inside: &'a [Vec<f64>],
    /// `H w'` at the end of the step, looked at for variables that have it as an unknown.
    pub rates: &'a [f64],
    /// `H`
    pub step: f64,
    /// Attitudes to which rotation vectors are relative.
    pub attitudes: &'a [UnitQuaternion<f64>],
}

impl<'a> Point<'a> {
    /// A point where the only unknowns are the values at the end of the step.
    pub fn ends(w: &'a [f64], attitudes: &'a [UnitQuaternion<f64>]) -> Self {
        Self {
            w,
            inner: &[],
            inside: &[],
            rates: &[],
            step: 0.0,
            attitudes,
        }
    }

    /// Coupling variables at share number `share`.
    pub(super) fn at(&self, share: usize) -> &'a [f64] {
        self.inner.get(share).map_or(self.w, Vec::as_slice)
    }
}
