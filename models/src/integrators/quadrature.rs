//! Integrals beside an integration, by the weights of its own method.

/// Takes part in every step that an integrator accepts: `sum of weight f(tau, y)` over the stages is what the same method gives for the
/// additional unknown `q' = f(tau, y)`, which nothing else depends on, with the order that the method has at the ends of steps.
pub trait Quadrature {
    /// One stage: `y` at `tau` (s after the start of the interval) with its weight (s).
    fn add(&mut self, tau: f64, y: &[f64], weight: f64);

    /// The longest step (s) in an interval of this length that it bears: an estimate of the error of `y` says nothing of the integrals of `y`
    /// times something that varies over the interval.
    fn longest_step(&self, length: f64) -> f64 {
        length
    }
}

/// Nodes and weights of Gauss's formula with that many points on [0, 1], for integrals along a motion that needs no integration.
pub fn gauss(points: usize) -> impl Iterator<Item = [f64; 2]> {
    let n = points as f64;
    // Legendre's polynomial of degree `points` on [-1, 1] and its derivative.
    let polynomial = move |x: f64| {
        let (mut before, mut own) = (0.0, 1.0);
        for degree in 0..points {
            let k = degree as f64;
            (before, own) = (own, ((2.0 * k + 1.0) * x * own - k * before) / (k + 1.0));
        }
        (own, n * (x * own - before) / (x * x - 1.0))
    };
    (0..points).map(move |place| {
        let guess = (std::f64::consts::PI * (place as f64 + 0.75) / (n + 0.5)).cos();
        let x = (0..6).fold(guess, |x, _| {
            let (value, slope) = polynomial(x);
            x - value / slope
        });
        let (_, slope) = polynomial(x);
        [(1.0 + x) / 2.0, 1.0 / ((1.0 - x * x) * slope * slope)]
    })
}

/// Integrates nothing.
impl Quadrature for () {
    fn add(&mut self, _tau: f64, _y: &[f64], _weight: f64) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_integrates_polynomials_of_twice_its_degree() {
        for points in 1..17 {
            for degree in 0..2 * points {
                let terms = gauss(points).map(|[node, weight]| weight * node.powi(degree as i32));
                let found: f64 = terms.sum();
                assert!(
                    (found * (degree + 1) as f64 - 1.0).abs() < 1e-13,
                    "{points} {degree}: {found}"
                );
            }
        }
    }
}
