//! A polynomial input as pieces of a low degree, for FMUs that take no more than that inside of one call.
//!
//! A macro step is divided into `n` equal sub-steps, and on each of them the input is a polynomial of degree `q`, mostly 0. What such an
//! input `w` misses of the true one, `u`, reaches the end of the macro step as `integral of G(s) (u - w) ds`, with the smooth response
//! `G` of the model. So `w` is chosen orthogonal to it as far as possible: `integral of L_k (u - w) ds = 0` for all Legendre polynomials
//! `L_k` of the *macro* step up to degree `n (q + 1) - 1`. With the mean of each sub-step alone this holds for `k = 0` only, and
//! the order is 2; with all of them it is `n (q + 1) + 1`. Of the inputs that meet these conditions it is the one that is nearest to the
//! best approximation on each sub-step.

use gauss_quad::GaussLegendre;
use linchpin_proto::polynomial::{MAX_NODES, Polynomial};
use linchpin_proto::weights::{MAX_WEIGHTS, legendre};
use nalgebra::DMatrix;

/// The pieces of polynomials over a step that is divided into `count` parts.
#[derive(Debug, Clone, PartialEq)]
pub struct Pieces {
    count: usize,
    degree: usize,
    /// Row `i (degree + 1) + k`: the coefficient of `x^k` on piece `i`, where `x` runs from 0 to 1 on it, by the powers of the share of
    /// the whole step.
    by_powers: DMatrix<f64>,
}

impl Pieces {
    /// Pieces of degree `degree` on `count` sub-steps, at least one.
    pub fn new(count: usize, degree: usize) -> Option<Self> {
        let count = count.max(1);
        let rows = count * (degree + 1);
        let (nodes, weights): (Vec<f64>, Vec<f64>) = GaussLegendre::new(MAX_NODES.try_into().ok()?)
            .iter()
            .map(|(node, weight)| (0.5 + 0.5 * node, 0.5 * weight))
            .unzip();
        let own = |place: usize, x: f64| {
            let mut values = vec![0.0; degree + 1];
            legendre(x, &mut values);
            values[place] * (2.0 * place as f64 + 1.0).sqrt()
        };
        let share = |piece: usize, x: f64| (piece as f64 + x) / count as f64;
        // Components on each piece of a function of the share.
        let component = |row: usize, of: &dyn Fn(f64) -> f64| {
            let (piece, place) = (row / (degree + 1), row % (degree + 1));
            let terms = nodes.iter().zip(&weights);
            terms
                .map(|(&x, weight)| weight * own(place, x) * of(share(piece, x)))
                .sum::<f64>()
        };
        let nearest = DMatrix::from_fn(rows, MAX_NODES, |row, power| {
            component(row, &|s| s.powi(power as i32))
        });
        let kept = rows.min(MAX_WEIGHTS);
        let weight = |number: usize, s: f64| {
            let mut values = [0.0; MAX_WEIGHTS];
            legendre(s, &mut values);
            values[number]
        };
        let moments = DMatrix::from_fn(kept, rows, |number, row| {
            component(row, &|s| weight(number, s)) / count as f64
        });
        let whole = DMatrix::from_fn(kept, MAX_NODES, |number, power| {
            let terms = nodes.iter().zip(&weights);
            terms
                .map(|(&s, w)| w * weight(number, s) * s.powi(power as i32))
                .sum()
        });
        let missed = whole - &moments * &nearest;
        let gram = &moments * moments.transpose();
        let correction = moments.transpose() * gram.lu().solve(&missed)?;
        let components = nearest + correction;
        let by_powers = DMatrix::from_fn(rows, MAX_NODES, |row, power| {
            let (piece, place) = (row / (degree + 1), row % (degree + 1));
            let terms = (place..=degree).map(|of| {
                let scale = (2.0 * of as f64 + 1.0).sqrt();
                scale * shifted_legendre(of, place) * components[(piece * (degree + 1) + of, power)]
            });
            terms.sum()
        });
        Some(Self {
            count,
            degree,
            by_powers,
        })
    }

    /// Number of sub-steps.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Degree of the pieces.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Whether these are the pieces of that number and degree.
    pub fn are(&self, count: usize, degree: usize) -> bool {
        (self.count, self.degree) == (count.max(1), degree)
    }

    /// Derivative of order `order` of the piece `number` of `polynomial` with respect to time at the start of the piece; the whole step
    /// has the length `length` (s). Order 0 is the value.
    pub fn derivative(
        &self,
        polynomial: &Polynomial,
        length: f64,
        number: usize,
        order: usize,
    ) -> f64 {
        let row = self.by_powers.row(number * (self.degree + 1) + order);
        let powers = polynomial.powers(length);
        let coefficient: f64 = { row.iter().zip(&powers) }.map(|(a, b)| a * b).sum();
        let factorial: f64 = (1..=order).map(|k| k as f64).product();
        coefficient * factorial * (self.count as f64 / length).powi(order as i32)
    }
}

/// Coefficient of `x^power` in Legendre's polynomial of this degree on 0 to 1:
/// `(-1)^(degree + power) binomial(degree, power) binomial(degree + power, power)`.
fn shifted_legendre(degree: usize, power: usize) -> f64 {
    let binomial =
        |n: usize, k: usize| -> f64 { (1..=k).map(|i| (n - k + i) as f64 / i as f64).product() };
    let sign = if (degree + power).is_multiple_of(2) {
        1.0
    } else {
        -1.0
    };
    sign * binomial(degree, power) * binomial(degree + power, power)
}

#[cfg(test)]
mod tests;
