//! The weights of integrals of outputs over a step: Legendre's polynomials on it.
//!
//! With the share `s = (t - T_N)/H` of the step, `L_i` has the degree `i`, is orthogonal on `0 <= s <= 1` to all polynomials of lower
//! degree, and `L_i(1) = 1`: `L_0 = 1`, `L_1 = 2s - 1`, `L_2 = 6s^2 - 6s + 1`. Integral number `i` of an output `y` is
//! `integral of y L_i ds`, in the unit of the output; the first one is its mean over the step.

/// The most weights that a request may ask for.
pub const MAX_WEIGHTS: usize = 8;

/// Writes `L_0, L_1, ..` at a share of the step.
pub fn legendre(share: f64, values: &mut [f64]) {
    let x = 2.0 * share - 1.0;
    let (mut before, mut own) = (0.0, 1.0);
    for (degree, value) in values.iter_mut().enumerate() {
        *value = own;
        let n = degree as f64;
        (before, own) = (own, ((2.0 * n + 1.0) * x * own - n * before) / (n + 1.0));
    }
}

/// Adds what a part of a step, from share `from` to share `to`, has to the integrals over the whole. Integrals stand weight by weight,
/// each of as many outputs; those of the part have the weights of a step of its own.
pub fn add_part([from, to]: [f64; 2], outputs: usize, part: &[f64], whole: &mut [f64]) {
    if outputs == 0 {
        return;
    }
    let length = to - from;
    // L_i over the part, by the polynomials of the part: their three-term recurrence.
    let (mut before, mut own) = ([0.0; MAX_WEIGHTS], [0.0; MAX_WEIGHTS]);
    own[0] = 1.0;
    for (degree, sums) in whole
        .chunks_exact_mut(outputs)
        .enumerate()
        .take(MAX_WEIGHTS)
    {
        for (own, parts) in own.iter().zip(part.chunks_exact(outputs)) {
            for (sum, value) in sums.iter_mut().zip(parts) {
                *sum += length * own * value;
            }
        }
        let n = degree as f64;
        let mut next = [0.0; MAX_WEIGHTS];
        for (place, own) in own.iter().enumerate().take(degree + 1) {
            let k = place as f64;
            let size = (2.0 * n + 1.0) * own;
            next[place] += size * (from + to - 1.0);
            if let Some(above) = next.get_mut(place + 1) {
                *above += size * length * (k + 1.0) / (2.0 * k + 1.0);
            }
            if let Some(below) = place.checked_sub(1) {
                next[below] += size * length * k / (2.0 * k + 1.0);
            }
        }
        for (next, before) in next.iter_mut().zip(before) {
            *next = (*next - n * before) / (n + 1.0);
        }
        (before, own) = (own, next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `integral of s^power L_i ds`: `power (power - 1) .. (power - i + 1) / ((power + 1) .. (power + i + 1))`.
    fn of_power(power: usize, weight: usize) -> f64 {
        let above = (0..weight)
            .map(|k| power as f64 - k as f64)
            .product::<f64>();
        let below = (0..=weight)
            .map(|k| (power + 1 + k) as f64)
            .product::<f64>();
        above / below
    }

    #[test]
    fn they_are_legendres_polynomials() {
        let mut values = [0.0; 4];
        for s in [0.0, 0.13, 0.5, 0.97, 1.0] {
            legendre(s, &mut values);
            let cubic = ((20.0 * s - 30.0) * s + 12.0) * s - 1.0;
            let expected = [1.0, 2.0 * s - 1.0, 6.0 * s * s - 6.0 * s + 1.0, cubic];
            for (found, expected) in values.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-14, "{s}: {values:?}");
            }
        }
    }

    #[test]
    fn parts_add_up_to_the_whole() {
        for cuts in [
            vec![0.0f64, 1.0],
            vec![0.0, 0.37, 1.0],
            vec![0.0, 1e-3, 0.2, 0.71, 1.0],
        ] {
            // Two outputs: s^power and 3 s^(power + 1).
            for power in 0..9 {
                let mut whole = [0.0; 2 * MAX_WEIGHTS];
                for part in cuts.windows(2) {
                    let (from, length) = (part[0], part[1] - part[0]);
                    let mut own = [0.0; 2 * MAX_WEIGHTS];
                    for (place, own) in own.iter_mut().enumerate() {
                        let (factor, power) = [(1.0, power), (3.0, power + 1)][place % 2];
                        let mut binomial = 1.0;
                        for k in 0..=power {
                            let term =
                                binomial * from.powi((power - k) as i32) * length.powi(k as i32);
                            *own += factor * term * of_power(k, place / 2);
                            binomial *= (power - k) as f64 / (k + 1) as f64;
                        }
                    }
                    add_part([part[0], part[1]], 2, &own, &mut whole);
                }
                for (place, found) in whole.iter().enumerate() {
                    let (factor, power) = [(1.0, power), (3.0, power + 1)][place % 2];
                    let expected = factor * of_power(power, place / 2);
                    assert!(
                        (found - expected).abs() < 1e-13,
                        "{cuts:?} {power} {place}: {found} {expected}"
                    );
                }
            }
        }
    }
}
