//! How the conditions inside a step are read from outputs at instants.

use std::num::NonZeroUsize;

use gauss_quad::{FiniteAboveNegOneF64, GaussJacobi};

use super::variant::Family;
use crate::signal::SharePolynomial;
use crate::system::Weights;

/// How a moment over the step follows from values at instants inside it.
///
/// A condition that vanishes at both ends of the step like `(s (1 - s))^a`, with `a = 2` for the opening of a joint and `a = 1` for a
/// connected signal, is integrated by Gauss-Jacobi quadrature: exactly where the rest of it times the weight of the moment is a polynomial
/// of degree `2M - 1`, with `M` instants.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rule {
    /// The instants as shares of the step, ascending.
    pub shares: Vec<f64>,
    /// For each instant the factor of a value there in the integral over the step.
    factors: Vec<f64>,
}

impl Rule {
    /// With that many instants; `has_signals` if connected signals are among the conditions.
    pub fn new(instants: usize, has_signals: bool) -> Self {
        let power = if has_signals { 1 } else { 2 };
        let exponent = FiniteAboveNegOneF64::new(f64::from(power));
        let (Some(instants), Some(exponent)) = (NonZeroUsize::new(instants), exponent) else {
            return Self::default();
        };
        let rule = GaussJacobi::new(instants, exponent, exponent);
        // From [-1, 1] to [0, 1], where s (1 - s) = (1 - x^2)/4.
        let vanishing = |x: f64| (1.0 - x * x).powi(power);
        let pairs = rule.iter();
        let (shares, factors) = pairs
            .map(|&(x, weight)| ((1.0 + x) / 2.0, weight / 2.0 / vanishing(x)))
            .unzip();
        Self { shares, factors }
    }

    /// The weights of the moments of a family.
    pub fn weights(&self, family: Family) -> Weights {
        let of = |weight: SharePolynomial| -> Vec<f64> {
            let values = self.shares.iter().zip(&self.factors);
            values.map(|(&share, factor)| factor * weight.value(share)).collect()
        };
        Weights {
            of_motion: (0..family.moments_of_motion()).map(|number| of(of_motion(number))).collect(),
            of_signals: (0..family.moments_of_signals())
                .map(|number| of(SharePolynomial::legendre(number)))
                .collect(),
        }
    }
}

/// The weight of moment number `moment` of a joint's condition: the second derivative of a Legendre polynomial. By parts, twice, its moment
/// is that of `g''` with the polynomial itself.
fn of_motion(moment: usize) -> SharePolynomial {
    SharePolynomial::legendre(moment + 2).differentiated().differentiated()
}

#[cfg(test)]
mod tests {
    use super::super::variant::Variant;
    use super::*;

    fn rule_integrates(power: usize, has_signals: bool, instants: usize) {
        let rule = Rule::new(instants, has_signals);
        let vanishing = |s: f64| (s * (1.0 - s)).powi(power as i32);
        for degree in 0..2 * instants {
            // The integral of s^(a + n) (1 - s)^a is a! (a + n)! / (2a + n + 1)!.
            let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
            let expected = factorial(power) * factorial(power + degree) / factorial(2 * power + degree + 1);
            let terms = rule.shares.iter().zip(&rule.factors);
            let found: f64 = terms.map(|(&s, factor)| factor * vanishing(s) * s.powi(degree as i32)).sum();
            assert!((found / expected - 1.0).abs() < 1e-12, "{power} {instants} {degree}: {found} {expected}");
        }
    }

    #[test]
    fn conditions_that_vanish_at_both_ends_are_integrated_exactly() {
        for instants in 1..17 {
            rule_integrates(2, false, instants);
            rule_integrates(1, true, instants);
        }
        assert_eq!(Rule::new(0, true), Rule::default());
    }

    #[test]
    fn two_instants_are_those_of_the_closed_form() {
        let rule = Rule::new(2, false);
        let offset = 0.5 / 7f64.sqrt();
        assert!((rule.shares[0] - 0.5 + offset).abs() < 1e-15);
        assert!((rule.shares[1] - 0.5 - offset).abs() < 1e-15);
    }

    #[test]
    fn the_first_moment_is_twelve_times_the_mean() {
        let family = Family { variant: Variant::Apv, degree: 3, has_own_signals: false };
        let rule = Rule::new(2, false);
        let weights = rule.weights(family);
        assert_eq!((weights.of_motion.len(), weights.of_signals.len()), (1, 0));
        for (weight, factor) in weights.of_motion[0].iter().zip(&rule.factors) {
            assert!((weight - 12.0 * factor).abs() < 1e-12 * weight.abs());
        }
    }
}
