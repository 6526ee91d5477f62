//! Coupling variables at one instant.

use linchpin_proto::v1::Signal;
use nalgebra::UnitQuaternion;

use super::{Curves, SharePolynomial, combine};

/// Constant curves over a step of no length; the one shape of a variable is 1.
#[derive(Clone, Copy)]
pub struct Held<'a> {
    /// Values of all variables.
    pub values: &'a [f64],
    /// Attitudes to which rotation vectors are relative.
    pub attitudes: &'a [UnitQuaternion<f64>],
}

impl Curves for Held<'_> {
    fn length(&self) -> f64 {
        0.0
    }

    fn attitudes(&self) -> &[UnitQuaternion<f64>] {
        self.attitudes
    }

    fn value(&self, variable: usize, _tau: f64) -> f64 {
        self.values[variable]
    }

    fn signal(&self, combination: &[(usize, f64)], signal: &mut Signal) {
        signal.set_constant(combine(combination, self.values));
    }

    fn shape(&self, _variable: usize, _shape: usize) -> SharePolynomial {
        SharePolynomial::power(0)
    }
}
