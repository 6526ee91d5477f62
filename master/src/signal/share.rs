//! Polynomials of the share `s = tau / H` of a macro step.

use serde::{Deserialize, Serialize};

const TERMS: usize = 5;

/// `c_0 + c_1 s + c_2 s^2 + ...`
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SharePolynomial([f64; TERMS]);

impl SharePolynomial {
    /// Number of coefficients: the highest degree is one less.
    pub const TERMS: usize = TERMS;

    /// The polynomial of these coefficients.
    pub fn new(coefficients: [f64; TERMS]) -> Self {
        Self(coefficients)
    }

    /// `s^power`
    pub fn power(power: usize) -> Self {
        let mut coefficients = [0.0; TERMS];
        coefficients[power] = 1.0;
        Self(coefficients)
    }

    /// `c_0, c_1, ...`
    pub fn coefficients(&self) -> &[f64; TERMS] {
        &self.0
    }

    /// The polynomial of the lowest degree with the roots `roots` that is 1 at `node`.
    pub fn with_roots(roots: impl IntoIterator<Item = f64>, node: f64) -> Self {
        let mut product = Self::power(0);
        for root in roots {
            let scale = 1.0 / (node - root);
            let mut next = [0.0; TERMS];
            for (power, coefficient) in product.0.iter().enumerate() {
                next[power] -= scale * root * coefficient;
                if let Some(higher) = next.get_mut(power + 1) {
                    *higher += scale * coefficient;
                }
            }
            product.0 = next;
        }
        product
    }

    /// Value at `s`.
    pub fn value(&self, s: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, c| sum * s + c)
    }

    /// Derivative with respect to `s` at `s`.
    pub fn derivative(&self, s: f64) -> f64 {
        let terms = self.0.iter().enumerate().skip(1).rev();
        terms.fold(0.0, |sum, (power, c)| sum * s + power as f64 * c)
    }

    /// The mean over the step weighted by `1 - s`: how far a free body moves under a load of this shape, relative to `H^2` times its acceleration
    /// under a unit load.
    pub fn lever(&self) -> f64 {
        let terms = self.0.iter().enumerate();
        terms
            .map(|(power, c)| c / ((power + 1) * (power + 2)) as f64)
            .sum()
    }

    /// Adds `factor` times another one.
    pub fn add(&mut self, factor: f64, other: &Self) {
        for (own, other) in self.0.iter_mut().zip(other.0) {
            *own += factor * other;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn roots_and_node(roots in proptest::collection::vec(-2f64..0.5, 0..4), node in 0.6f64..1.0) {
            let polynomial = SharePolynomial::with_roots(roots.iter().copied(), node);
            prop_assert!((polynomial.value(node) - 1.0).abs() < 1e-9);
            for root in roots {
                prop_assert!(polynomial.value(root).abs() < 1e-6);
            }
        }

        #[test]
        fn the_derivative_is_a_difference(c in proptest::array::uniform5(-2f64..2.0), s in 0f64..1.0) {
            let polynomial = SharePolynomial::new(c);
            let difference = (polynomial.value(s + 1e-5) - polynomial.value(s - 1e-5)) / 2e-5;
            prop_assert!((polynomial.derivative(s) - difference).abs() < 1e-7);
        }
    }
}
