//! Integrals of the exact solution of the oscillator over one step of unit length.
//!
//! They are those of the displacement `x(s) - x(0)` with Legendre's polynomials, in the units of [`Propagator`] and found in the same way: by
//! power series on a part of the step, which is doubled until it is the whole.

use linchpin_proto::polynomial::MAX_NODES;
use linchpin_proto::weights::{MAX_WEIGHTS, add_part};

use super::propagator::{Propagator, Series, short_part};

/// Integrals with all weights.
pub type Integrals = [f64; MAX_WEIGHTS];

/// `integral of (x(s) - x(0)) L_i ds = transition * start + sum_j input[j] u_j`.
#[derive(Debug, Clone, PartialEq)]
pub struct Averages {
    /// Of the displacement by a unit position and by a unit velocity.
    pub transition: [Integrals; 2],
    /// Of that by the input `s^j`.
    pub input: [Integrals; MAX_NODES],
    /// Number of weights.
    pub weights: usize,
}

impl Averages {
    /// `None` where [`Propagator::new`] has none.
    pub fn new(kappa: f64, delta: f64, weights: usize) -> Option<Self> {
        let (kappa, delta, doublings) = short_part(kappa, delta)?;
        let of = |start, power| {
            let series = Series::new(kappa, delta, start, power);
            let mut integrals = [0.0; MAX_WEIGHTS];
            for (weight, integral) in integrals[..weights].iter_mut().enumerate() {
                *integral = series.displacement(|power| of_power(power, weight));
            }
            integrals
        };
        let mut own = Self {
            transition: [of([1.0, 0.0], None), of([0.0, 1.0], None)],
            input: std::array::from_fn(|power| of([0.0; 2], Some(power))),
            weights,
        };
        let mut half = Propagator::of_series(kappa, delta);
        for _ in 0..doublings {
            own = own.doubled(&half);
            half = half.doubled();
        }
        Some(own)
    }

    /// The same over twice the time, of which `half` is the solution over one half.
    fn doubled(&self, half: &Propagator) -> Self {
        let [[xx, xv], [vx, vv]] = half.transition;
        let by = |first: &Integrals, [x, v]: [f64; 2], moved: f64, second: &Integrals| {
            // The second half starts at `moved` with the state (x, v).
            let mut whole = [0.0; MAX_WEIGHTS];
            let mut later = *second;
            for (weight, later) in later[..self.weights].iter_mut().enumerate() {
                *later += x * self.transition[0][weight] + v * self.transition[1][weight];
            }
            later[0] += moved;
            let parts = [([0.0, 0.5], first), ([0.5, 1.0], &later)];
            for (part, integrals) in parts {
                add_part(
                    part,
                    1,
                    &integrals[..self.weights],
                    &mut whole[..self.weights],
                );
            }
            whole
        };
        let nothing = [0.0; MAX_WEIGHTS];
        let slow = self.transition[1].map(|integral| 0.5 * integral);
        let mut scale = 0.25;
        let input = std::array::from_fn(|j| {
            let mut second = [0.0; MAX_WEIGHTS];
            let mut binomial = scale;
            for (i, lower) in self.input[..=j].iter().enumerate() {
                for (sum, lower) in second.iter_mut().zip(lower) {
                    *sum += binomial * lower;
                }
                binomial *= (j - i) as f64 / (i + 1) as f64;
            }
            let first = self.input[j].map(|integral| scale * integral);
            let [x, v] = half.input[j].map(|increment| scale * increment);
            scale /= 2.0;
            by(&first, [x, v], x, &second)
        });
        Self {
            transition: [
                by(&self.transition[0], [1.0 + xx, vx], xx, &nothing),
                by(&slow, [0.5 * xv, 0.5 * (1.0 + vv)], 0.5 * xv, &nothing),
            ],
            input,
            weights: self.weights,
        }
    }
}

/// `integral of s^power L_weight ds`; 0 where the power is lower than the degree.
fn of_power(power: usize, weight: usize) -> f64 {
    (0..weight).fold(1.0 / (power + 1 + weight) as f64, |value, k| {
        value * (power as f64 - k as f64) / (power + 1 + k) as f64
    })
}

/// Integrals of the rate of what has these integrals of its displacement and has moved by `displacement` over the step: by parts, with the
/// derivative of `L_i`, `2 (2k + 1) L_k` summed over `k = i - 1, i - 3, ..`.
pub fn of_rate(displacement: f64, integrals: &Integrals) -> Integrals {
    std::array::from_fn(|weight| {
        let lower = (0..weight).rev().step_by(2);
        lower.fold(displacement, |rate, k| {
            rate - 2.0 * (2.0 * k as f64 + 1.0) * integrals[k]
        })
    })
}

#[cfg(test)]
mod tests {
    use linchpin_proto::weights::legendre;

    use super::*;

    /// Integrals by Gauss's formula with three points on each of many parts, from solutions up to every point.
    fn by_quadrature(
        kappa: f64,
        delta: f64,
        displacement: impl Fn(&Propagator, f64) -> f64,
    ) -> Integrals {
        let parts = 500;
        let mut sums = [0.0; MAX_WEIGHTS];
        for part in 0..parts {
            for (node, weight) in [
                (0.5 - 0.15f64.sqrt(), 5.0),
                (0.5, 8.0),
                (0.5 + 0.15f64.sqrt(), 5.0),
            ] {
                let s = (f64::from(part) + node) / f64::from(parts);
                let own = Propagator::new(kappa * s * s, delta * s).unwrap();
                let mut polynomials = [0.0; MAX_WEIGHTS];
                legendre(s, &mut polynomials);
                let value = displacement(&own, s) * weight / 18.0 / f64::from(parts);
                for (sum, polynomial) in sums.iter_mut().zip(polynomials) {
                    *sum += polynomial * value;
                }
            }
        }
        sums
    }

    #[test]
    fn they_are_the_integrals_of_the_solution() {
        for (kappa, delta) in [
            (0.0, 0.0),
            (0.2, 0.1),
            (9.0, 0.0),
            (700.0, 3.0),
            (2500.0, 0.0),
            (4.0, 60.0),
        ] {
            let averages = Averages::new(kappa, delta, MAX_WEIGHTS).unwrap();
            let mut pairs = vec![
                (
                    averages.transition[0],
                    by_quadrature(kappa, delta, |own, _| own.transition[0][0]),
                ),
                (
                    averages.transition[1],
                    by_quadrature(kappa, delta, |own, s| own.transition[0][1] * s),
                ),
            ];
            for j in [0, 3, MAX_NODES - 1] {
                let expected = by_quadrature(kappa, delta, |own, s| {
                    own.input[j][0] * s.powi(j as i32 + 2)
                });
                pairs.push((averages.input[j], expected));
            }
            for (found, expected) in pairs {
                let size = found
                    .iter()
                    .fold(0.0f64, |size, value| size.max(value.abs()));
                for (found, expected) in found.iter().zip(expected) {
                    assert!(
                        (found - expected).abs() <= 1e-10 * size,
                        "{kappa} {delta}: {found:e} {expected:e}"
                    );
                }
            }
        }
    }

    /// Fewer weights are the first ones, to the bit, whatever the motion is.
    #[test]
    fn fewer_weights_are_the_first_ones() {
        let all = Averages::new(170.0, 2.0, MAX_WEIGHTS).unwrap();
        for weights in 0..MAX_WEIGHTS {
            let fewer = Averages::new(170.0, 2.0, weights).unwrap();
            for (fewer, all) in fewer.input.iter().zip(&all.input) {
                assert_eq!(fewer[..weights], all[..weights]);
                assert_eq!(fewer[weights..], [0.0; MAX_WEIGHTS][weights..]);
            }
        }
    }

    #[test]
    fn rates_have_the_integrals_of_derivatives() {
        for power in 1..7 {
            let integrals = std::array::from_fn(|weight| of_power(power, weight));
            let rates = of_rate(1.0, &integrals);
            for (weight, rate) in rates.iter().enumerate() {
                let expected = power as f64 * of_power(power - 1, weight);
                assert!(
                    (rate - expected).abs() < 1e-13,
                    "{power} {weight}: {rate} {expected}"
                );
            }
        }
    }
}
