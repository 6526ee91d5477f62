//! The curves of all coupling variables over one macro step.

use linchpin_proto::v1::Signal;
use nalgebra::UnitQuaternion;

use super::{Curve, History, SharePolynomial};

/// Curves over a step from `tau = 0` to its length.
pub trait Curves {
    /// Length of the step in s.
    fn length(&self) -> f64;

    /// Attitudes to which rotation vectors are relative.
    fn attitudes(&self) -> &[UnitQuaternion<f64>];

    /// Value of one variable at `tau`.
    fn value(&self, variable: usize, tau: f64) -> f64;

    /// The signal of `sum_i factor_i variable_i`, all of one kind.
    fn signal(&self, combination: &[(usize, f64)], signal: &mut Signal);

    /// Shape number `shape` of a variable: that of one of the unknowns that its curve is made of.
    fn shape(&self, variable: usize, shape: usize) -> SharePolynomial;

    /// The share of the step at `tau`; a step of no length is at its end.
    fn share(&self, tau: f64) -> f64 {
        match self.length() {
            0.0 => 1.0,
            length => tau / length,
        }
    }
}

/// The Lagrange polynomials through past values, and the end value if the curve has it as a node. The one unknown of each
/// variable is its end value.
#[derive(Clone, Copy)]
pub struct Lagrange<'a> {
    /// Past values.
    pub history: &'a History,
    /// Which polynomials.
    pub curve: Curve<'a>,
    /// Length of the step.
    pub length: f64,
}

impl Curves for Lagrange<'_> {
    fn length(&self) -> f64 {
        self.length
    }

    fn attitudes(&self) -> &[UnitQuaternion<f64>] {
        self.history.attitudes()
    }

    fn value(&self, variable: usize, tau: f64) -> f64 {
        self.history.value(variable, self.curve, self.length, tau)
    }

    fn signal(&self, combination: &[(usize, f64)], signal: &mut Signal) {
        self.history
            .signal(combination, self.curve, self.length, signal);
    }

    fn shape(&self, variable: usize, _shape: usize) -> SharePolynomial {
        self.history.end_shape(variable, self.length)
    }
}
