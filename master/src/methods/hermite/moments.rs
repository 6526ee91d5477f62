//! How the conditions inside a step are read from outputs at instants, or from integrals of outputs.

use std::num::NonZeroUsize;

use gauss_quad::{FiniteAboveNegOneF64, GaussJacobi, GaussLegendre};
use linchpin_proto::polynomial::MAX_NODES;
use linchpin_proto::weights::{MAX_WEIGHTS, legendre};

use super::variant::Family;
use crate::signal::SharePolynomial;
use crate::system::Weights;

/// How a moment over the step follows from integrals of outputs, or from values at instants.
///
/// With integrals a moment is a sum of those: its weight is a sum of Legendre's polynomials.
///
/// A condition that vanishes at both ends of the step like `(s (1 - s))^a`, with `a = 2` for the opening of a joint and `a = 1` for a
/// connected signal, is integrated by Gauss-Jacobi quadrature: exactly where the rest of it times the weight of the moment is a polynomial
/// of degree `2M - 1`, with `M` instants.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rule {
    /// Number of integrals of each output.
    integrals: usize,
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
        Self {
            integrals: 0,
            shares,
            factors,
        }
    }

    /// The same with that many integrals of each output as well.
    pub fn with_integrals(self, integrals: usize) -> Self {
        Self { integrals, ..self }
    }

    /// How curves are looked at.
    pub fn looks(&self) -> impl Iterator<Item = Look> {
        let instants = self.shares.iter().map(|&share| Look::At(share));
        (0..self.integrals).map(Look::integral).chain(instants)
    }

    /// The weights of the moments of a family.
    pub fn weights(&self, family: Family) -> Weights {
        let of = |weight: SharePolynomial| -> Vec<f64> {
            let parts = weight.legendre_coefficients().into_iter().take(self.integrals);
            let values = self.shares.iter().zip(&self.factors);
            parts.chain(values.map(|(&share, factor)| factor * weight.value(share))).collect()
        };
        Weights {
            of_motion: (0..family.moments_of_motion()).map(|number| of(of_motion(number))).collect(),
            of_signals: (0..family.moments_of_signals())
                .map(|number| of(SharePolynomial::legendre(number)))
                .collect(),
        }
    }
}

/// What a curve shows of the inside of a step.
#[derive(Debug, Clone, PartialEq)]
pub enum Look {
    /// Its value at a share of the step.
    At(f64),
    /// Its integral with a weight: shares with factors of the values there.
    Integral(Vec<[f64; 2]>),
}

impl Look {
    /// With Legendre's polynomial of this degree, of curves of degree [`MAX_NODES`] at most.
    fn integral(weight: usize) -> Self {
        let points = NonZeroUsize::new((MAX_NODES + weight) / 2 + 1).unwrap_or(NonZeroUsize::MIN);
        let rule = GaussLegendre::new(points);
        let nodes = rule.iter().map(|&(x, factor)| {
            let share = (1.0 + x) / 2.0;
            let mut polynomials = [0.0; MAX_WEIGHTS];
            legendre(share, &mut polynomials);
            [share, factor / 2.0 * polynomials[weight]]
        });
        Self::Integral(nodes.collect())
    }

    /// What several curves show, whose values at a share `values` gives.
    pub fn of(&self, values: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
        match self {
            Self::At(share) => values(*share),
            Self::Integral(nodes) => {
                let terms = nodes.iter().map(|&[share, factor]| {
                    let values = values(share).into_iter();
                    values.map(|value| factor * value).collect()
                });
                let add = |sum: Vec<f64>, term: Vec<f64>| sum.iter().zip(term).map(|(sum, term)| sum + term).collect();
                terms.reduce(add).unwrap_or_default()
            }
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

    /// By parts, twice, a moment of `s^2 (1 - s)^2 q` is the same by integrals and by instants.
    #[test]
    fn integrals_and_instants_give_the_same_moments() {
        let family = Family { variant: Variant::Apv, degree: 5, has_own_signals: true };
        let integrals = Rule::default().with_integrals(4);
        let curve = |s: f64| vec![s * (1.0 - s) * (0.3 + s * (1.7 - 2.1 * s))];
        let shown: Vec<f64> = integrals.looks().flat_map(|look| look.of(curve)).collect();
        let by_integrals = integrals.weights(family);
        let instants = Rule::new(5, true);
        let values: Vec<f64> = instants.looks().flat_map(|look| look.of(curve)).collect();
        let by_instants = instants.weights(family);
        let pairs = [(&by_integrals.of_motion, &by_instants.of_motion), (&by_integrals.of_signals, &by_instants.of_signals)];
        for (own, other) in pairs {
            assert!(own.len() == other.len() && own.len() >= 3);
            for (own, other) in own.iter().zip(other) {
                let sum = |weights: &[f64], values: &[f64]| weights.iter().zip(values).map(|(w, v)| w * v).sum::<f64>();
                let [own, other] = [sum(own, &shown), sum(other, &values)];
                assert!((own - other).abs() < 1e-13, "{own} {other}");
            }
        }
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
