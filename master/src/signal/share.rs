//! Polynomials of the share `s = tau / H` of a macro step.

use linchpin_proto::polynomial::MAX_NODES;
use serde::{Deserialize, Serialize};

/// As many as a signal may have nodes.
const TERMS: usize = MAX_NODES;

/// `c_0 + c_1 s + c_2 s^2 + ...`
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SharePolynomial([f64; TERMS]);

impl SharePolynomial {
    /// Number of coefficients: the highest degree is one less.
    pub const TERMS: usize = TERMS;

    /// `s^power`
    pub fn power(power: usize) -> Self {
        let mut coefficients = [0.0; TERMS];
        coefficients[power] = 1.0;
        Self(coefficients)
    }

    /// The polynomial of these lowest coefficients.
    pub fn of(lowest: &[f64]) -> Self {
        let mut coefficients = [0.0; TERMS];
        coefficients[..lowest.len()].copy_from_slice(lowest);
        Self(coefficients)
    }

    /// Legendre's polynomial `L_degree` on the step: orthogonal on [0, 1], 1 at its end.
    pub fn legendre(degree: usize) -> Self {
        let [mut before, mut own] = [Self::default(), Self::power(0)];
        for n in 0..degree {
            let (n, next) = (n as f64, n as f64 + 1.0);
            let mut following = own.times(&Self::of(&[-1.0, 2.0]));
            following = following.scaled((2.0 * n + 1.0) / next);
            following.add(-n / next, &before);
            (before, own) = (own, following);
        }
        own
    }

    /// Coefficients of Legendre's polynomials, the lowest first.
    pub fn legendre_coefficients(mut self) -> [f64; TERMS] {
        let mut found = [0.0; TERMS];
        for degree in (0..TERMS).rev() {
            if self.0[degree] != 0.0 {
                let basis = Self::legendre(degree);
                found[degree] = self.0[degree] / basis.0[degree];
                self.add(-found[degree], &basis);
            }
        }
        found
    }

    /// The product with another polynomial; their degrees add up to less than the number of coefficients.
    pub fn times(&self, other: &Self) -> Self {
        let mut product = [0.0; TERMS];
        for (power, own) in self.0.iter().enumerate() {
            let places = product[power..].iter_mut().zip(&other.0);
            places.for_each(|(sum, other)| *sum += own * other);
        }
        Self(product)
    }

    /// `factor` times the polynomial.
    pub fn scaled(self, factor: f64) -> Self {
        Self(self.0.map(|own| factor * own))
    }

    /// Its derivative with respect to `s`.
    pub fn differentiated(&self) -> Self {
        let mut derivative = [0.0; TERMS];
        for (power, own) in self.0.iter().enumerate().skip(1) {
            derivative[power - 1] = power as f64 * own;
        }
        Self(derivative)
    }

    /// Its integral over `s` from 0 on; its degree is not the highest possible.
    pub fn integrated(&self) -> Self {
        let mut integral = [0.0; TERMS];
        for (power, own) in self.0.iter().enumerate().take(TERMS - 1) {
            integral[power + 1] = own / (power + 1) as f64;
        }
        Self(integral)
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
        fn the_derivative_is_a_difference(c in proptest::array::uniform8(-2f64..2.0), s in 0f64..1.0) {
            let polynomial = SharePolynomial::of(&c);
            let difference = (polynomial.value(s + 1e-5) - polynomial.value(s - 1e-5)) / 2e-5;
            prop_assert!((polynomial.derivative(s) - difference).abs() < 1e-7);
            prop_assert!((polynomial.differentiated().value(s) - polynomial.derivative(s)).abs() < 1e-12);
        }
    }
}
