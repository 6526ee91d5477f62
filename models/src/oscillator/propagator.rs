//! The exact solution of the oscillator over one step of unit length.
//!
//! With the time `s = t / H`, the state `(x, H v)` and the input `H^2 u / m` the equation of motion is
//! `x'' + delta x' + kappa x = u(s)`, `delta = H d / m`, `kappa = H^2 c / m`: all numbers of the solution are of
//! size 1 or smaller, and so the response of the position, about `H^2 / 2m`, keeps its relative accuracy.
//!
//! The power series of the solution is summed on a part of the step that is short enough to converge at once; the
//! part is then doubled until it is the whole. It is the *increment* of the state that is doubled, not the state: a
//! heavily damped oscillator creeps by a tiny part of its position in every part of the step, and `1 + tiny` would
//! lose it. (Measured: nalgebra's `exp` of the augmented matrix loses four figures at `delta` = 6e5, and takes five
//! to ten times as long.)

use linchpin_proto::polynomial::MAX_NODES;

/// Terms of the power series; with `kappa <= 1/4` and `delta <= 1/2` the first one left out is below rounding.
const TERMS: usize = 24;

/// `end - start = transition * start + sum_j input[j] u_j` for the state `(x, H v)` and the input `sum_j u_j s^j`.
#[derive(Debug, Clone, PartialEq)]
pub struct Propagator {
    /// Increments of `(x, H v)` by a unit position (first column) and a unit velocity (second column).
    pub transition: [[f64; 2]; 2],
    /// Increments of `(x, H v)` by the input `s^j`.
    pub input: [[f64; 2]; MAX_NODES],
}

impl Propagator {
    /// `None` if a coefficient is not finite.
    pub fn new(kappa: f64, delta: f64) -> Option<Self> {
        let (kappa, delta, doublings) = short_part(kappa, delta)?;
        let mut own = Self::of_series(kappa, delta);
        for _ in 0..doublings {
            own = own.doubled();
        }
        Some(own)
    }

    /// By power series, over a [`short_part`].
    pub fn of_series(kappa: f64, delta: f64) -> Self {
        let by_position = increment(kappa, delta, [1.0, 0.0], None);
        let by_velocity = increment(kappa, delta, [0.0, 1.0], None);
        Self {
            transition: [
                [by_position[0], by_velocity[0]],
                [by_position[1], by_velocity[1]],
            ],
            input: std::array::from_fn(|power| increment(kappa, delta, [0.0; 2], Some(power))),
        }
    }

    /// The same over twice the time. The velocity's unit changes with that of time, and `s^j` of the long part is
    /// `s^j / 2^j` in its first half and `(1 + s)^j / 2^j` in its second.
    pub fn doubled(&self) -> Self {
        let [[xx, xv], [vx, vv]] = self.transition;
        let transition = [
            [(2.0 + xx) * xx + xv * vx, (2.0 + xx + vv) * xv / 2.0],
            [(2.0 + xx + vv) * vx * 2.0, (2.0 + vv) * vv + vx * xv],
        ];
        let mut input = [[0.0; 2]; MAX_NODES];
        let mut scale = 0.25;
        for (j, into) in input.iter_mut().enumerate() {
            let [x, v] = self.input[j];
            let mut sum = [x + xx * x + xv * v, v + vx * x + vv * v];
            let mut binomial = 1.0;
            for (i, lower) in self.input[..=j].iter().enumerate() {
                sum[0] += binomial * lower[0];
                sum[1] += binomial * lower[1];
                binomial *= (j - i) as f64 / (i + 1) as f64;
            }
            *into = [scale * sum[0], 2.0 * scale * sum[1]];
            scale /= 2.0;
        }
        Self { transition, input }
    }
}

/// `kappa` and `delta` of a part of the step over which power series converge, and how often it is doubled; `None` if they are not finite.
pub fn short_part(kappa: f64, delta: f64) -> Option<(f64, f64, usize)> {
    if !(kappa.is_finite() && delta.is_finite()) {
        return None;
    }
    let (mut kappa, mut delta, mut doublings) = (kappa, delta, 0);
    while kappa > 0.25 || delta > 0.5 {
        kappa /= 4.0;
        delta /= 2.0;
        doublings += 1;
    }
    Some((kappa, delta, doublings))
}

/// A motion as the power series `x = sum x_k s^k`.
pub struct Series {
    terms: [f64; TERMS + 2],
}

impl Series {
    /// From a state, under the input `s^power`.
    pub fn new(kappa: f64, delta: f64, start: [f64; 2], power: Option<usize>) -> Self {
        let mut terms = [0.0; TERMS + 2];
        terms[0] = start[0];
        terms[1] = start[1];
        for k in 0..TERMS {
            let input = if power == Some(k) { 1.0 } else { 0.0 };
            let next = (k + 1) as f64;
            terms[k + 2] =
                (input - delta * next * terms[k + 1] - kappa * terms[k]) / (next * (next + 1.0));
        }
        Self { terms }
    }

    /// The sum of what `factor` makes of each power of the displacement `x - x(0)`, the smallest terms first.
    pub fn displacement(&self, factor: impl Fn(usize) -> f64) -> f64 {
        let terms = self.terms.iter().enumerate().skip(1).rev();
        terms.fold(0.0, |sum, (power, term)| sum + factor(power) * term)
    }
}

/// Increment of `(x, x')` from `s = 0` to 1 under the input `s^power`.
fn increment(kappa: f64, delta: f64, start: [f64; 2], power: Option<usize>) -> [f64; 2] {
    let series = Series::new(kappa, delta, start, power);
    let bent = |factor: fn(usize) -> f64| {
        series.displacement(|power| if power > 1 { factor(power) } else { 0.0 })
    };
    [series.displacement(|_| 1.0), bent(|power| power as f64)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_free_mass_answers_powers_of_time() {
        let propagator = Propagator::new(0.0, 0.0).unwrap();
        assert_eq!(propagator.transition, [[0.0, 1.0], [0.0, 0.0]]);
        for (j, [x, v]) in propagator.input.into_iter().enumerate() {
            let next = (j + 1) as f64;
            assert!(
                (v * next - 1.0).abs() < 1e-15 && (x * next * (next + 1.0) - 1.0).abs() < 1e-15
            );
        }
    }

    /// The response to `s^j` satisfies `v_j = j x_{j-1}` and `kappa x_j + delta v_j + j v_{j-1} = 1`, because its
    /// derivative is the response to `j s^(j-1)`.
    #[test]
    fn responses_to_neighbouring_powers_fit_together() {
        for kappa in [1e-9, 0.3, 1.0, 47.0, 1e4, 1e7] {
            for delta in [0.0, 1e-7, 0.4, 1.9, 30.0, 1e3, 1e6, 1e9] {
                let Propagator { transition, input } = Propagator::new(kappa, delta).unwrap();
                let phase = 1.0 + f64::sqrt(kappa);
                assert!((input[0][1] - transition[0][1]).abs() < 1e-14);
                for j in 1..MAX_NODES {
                    let ([x, v], [x_lower, v_lower]) = (input[j], input[j - 1]);
                    let order = j as f64;
                    let context = format!("kappa {kappa:e} delta {delta:e} j {j}: x {x:e} v {v:e}");
                    assert!(
                        (v - order * x_lower).abs() < 1e-13 * x_lower.abs() * phase,
                        "{context}"
                    );
                    let sum = kappa * x + delta * v + order * v_lower;
                    assert!((sum - 1.0).abs() < 1e-13 * phase, "{context}: {sum}");
                }
            }
        }
    }

    #[test]
    fn numbers_without_a_solution_are_refused_and_large_ones_end() {
        assert_eq!(Propagator::new(f64::INFINITY, 0.0), None);
        assert_eq!(Propagator::new(1.0, f64::NAN), None);
        assert!(Propagator::new(1e300, 1e300).is_some());
    }
}
