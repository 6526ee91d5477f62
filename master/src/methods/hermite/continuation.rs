//! What of a curve goes on from one step to the next.

use super::variant::HIGHEST_DEGREE;
use crate::signal::SharePolynomial;

/// Lowest degree that goes on from one step to the next, whatever the columns miss.
const CONTINUED_DEGREE: usize = 2;

/// Share of its errors that a part of a curve may carry from one step into the next.
const CARRIED: f64 = 0.1;

/// Highest degree of what goes on from one step to the next, over a step so many times as `long`. Over a step of equal length a part of
/// degree 2, 3, 4, 5 grows to 13, 63, 321, 1683 times its size, and with it the share that corrections leave wrong in it, the `rate`.
pub fn continued_degree(long: f64, rate: Option<f64>) -> usize {
    let Some(rate) = rate else {
        return CONTINUED_DEGREE;
    };
    let carried = |degree: &usize| rate * SharePolynomial::legendre(*degree).value(1.0 + long);
    let higher = (CONTINUED_DEGREE + 1..=HIGHEST_DEGREE).take_while(|degree| carried(degree) <= CARRIED);
    higher.last().unwrap_or(CONTINUED_DEGREE)
}

/// What goes on of a curve behind its end: without its Legendre polynomials above this degree, and from the value that it has there.
pub fn continued(curve: &SharePolynomial, degree: usize) -> SharePolynomial {
    if curve.coefficients()[degree + 1..].iter().all(|one| *one == 0.0) {
        return *curve;
    }
    let coefficients = curve.legendre_coefficients().into_iter().enumerate();
    let mut low = SharePolynomial::default();
    for (degree, coefficient) in coefficients.take(degree + 1) {
        low.add(coefficient, &SharePolynomial::legendre(degree));
    }
    low.add(curve.value(1.0) - low.value(1.0), &SharePolynomial::power(0));
    low
}
