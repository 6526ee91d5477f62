//! Responses over one length, from those that were measured over others.
//!
//! The position at the end of a step under a load of unit size goes with `H^2` for a free body, the velocity with `H` and the acceleration with `1`.
//! A damper or a spring that the step does not resolve takes powers of `H` away: `1/m H^2`, `1/d H`, `1/c`. In all of them, and nearly so in
//! between, the *inverse* of the response in units of its power is a polynomial in `H`, as impedances add up:
//!
//! ```text
//! H^2 / |x(H)|  =  p_0 + p_1 H + p_2 H^2
//! ```
//!
//! So this inverse is interpolated through the nearest lengths, two or three, for the outputs of one level together; their direction is
//! interpolated as it is. What the farthest length changes tells how good that is.

use std::ops::Range;

use super::axes::turn;
use super::measured::Measured;
use super::settings::{MOST_SUPPORTS, SETTINGS};
use crate::joint::Level;
use crate::layout::Layout;

/// Powers of the length in the responses to a load, by level.
const POWERS: [i32; 3] = [2, 1, 0];

/// Finds responses between lengths.
#[derive(Debug, Clone, PartialEq)]
pub struct Between {
    /// Levels whose responses count.
    levels: &'static [Level],
    /// For each subsystem and coupling output its power of the length.
    powers: Vec<Vec<i32>>,
    /// What each of them is multiplied by in sizes: angles by the size of the mechanism, so that they are lengths as well.
    arms: Vec<Vec<f64>>,
    found: Measured,
    /// Responses over the nearest lengths, turned to one attitude.
    turned: [Vec<Vec<f64>>; MOST_SUPPORTS],
}

impl Between {
    /// For the outputs of `layout`, of which those on `levels` count, in a mechanism of `size` m. Those that no joint reads are taken for
    /// positions: whatever their power, the inverse is a polynomial of degree 2 at most.
    pub fn new(layout: &Layout, levels: &'static [Level], size: f64) -> Self {
        let outputs = layout.outputs.iter();
        let mut powers: Vec<Vec<i32>> = outputs.map(|own| vec![POWERS[0]; own.len()]).collect();
        let mut arms: Vec<Vec<f64>> = powers.iter().map(|own| vec![1.0; own.len()]).collect();
        for end in layout.joints.iter().flat_map(|joint| &joint.ends) {
            for (&level, power) in Level::ALL.iter().zip(POWERS) {
                for position in end.sized(level) {
                    powers[end.subsystem][position.place] = power;
                    arms[end.subsystem][position.place] =
                        if position.is_length { 1.0 } else { size };
                }
            }
        }
        for frame in &layout.frames {
            for &place in &frame.attitude {
                arms[frame.subsystem][place] = size;
            }
        }
        // What is told inside a step are positions and their means.
        for (subsystem, powers) in powers.iter_mut().enumerate() {
            let size = powers.len() + layout.inside.values(subsystem);
            powers.resize(size, POWERS[0]);
            let told = layout.inside.places_of(subsystem);
            let told: Vec<f64> = told.map(|place| arms[subsystem][place]).collect();
            arms[subsystem].extend(told);
        }
        Self {
            levels,
            powers,
            arms,
            found: Measured::default(),
            turned: Default::default(),
        }
    }

    /// What was found.
    pub fn found(&self) -> &Measured {
        &self.found
    }

    /// Responses over `length` from those of other lengths, the nearest first. Gives the share of them that may be wrong; `None` if it is too
    /// large or cannot be told.
    pub fn find(
        &mut self,
        layout: &Layout,
        length: f64,
        supports: [Option<&Measured>; MOST_SUPPORTS],
        of_input: &[Range<usize>],
    ) -> Option<f64> {
        let [Some(nearest), Some(_), ..] = supports else {
            return None;
        };
        let supports = || supports.iter().flatten();
        for (turned, support) in self.turned.iter_mut().zip(supports()) {
            turned.resize_with(support.responses.len(), Vec::new);
            for (turned, response) in turned.iter_mut().zip(&support.responses) {
                turned.clone_from(response);
            }
            let attitudes = [&support.attitudes[..], &nearest.attitudes];
            turn(layout, attitudes, of_input, turned);
        }
        let mut lengths = [0.0; MOST_SUPPORTS];
        for (length, support) in lengths.iter_mut().zip(supports()) {
            *length = support.length();
        }
        let lengths = &lengths[..supports().count()];
        self.found.attitudes.clone_from(&nearest.attitudes);
        let responses = &mut self.found.responses;
        responses.resize_with(nearest.responses.len(), Vec::new);
        let mut changed: f64 = 0.0;
        for (subsystem, (powers, arms)) in self.powers.iter().zip(&self.arms).enumerate() {
            for own in &of_input[layout.input_range(subsystem)] {
                let mut whole = [Part::default(); POWERS.len()];
                for place in own.clone() {
                    let turned = &self.turned;
                    let support = |number: usize| &turned[number][place][..];
                    let outputs = (&powers[..], &arms[..]);
                    let parts =
                        interpolate(lengths, length, support, outputs, &mut responses[place]);
                    for (whole, part) in whole.iter_mut().zip(parts) {
                        whole.take(part);
                    }
                }
                let counted = self
                    .levels
                    .iter()
                    .map(|&level| whole[level as usize].share());
                changed = counted.fold(changed, f64::max);
            }
        }
        (changed <= SETTINGS.most_changed).then(|| changed.powf(SETTINGS.left_of_change))
    }
}

/// The part of a response on one level: its size, and how much of it the farthest length changes.
#[derive(Debug, Clone, Copy, Default)]
struct Part {
    size: f64,
    changed: f64,
}

impl Part {
    /// Responses to several curves of one input count together: shapes are made of them.
    fn take(&mut self, other: Self) {
        self.size = self.size.max(other.size);
        self.changed = match other.changed.is_nan() {
            true => f64::INFINITY,
            false => self.changed.max(other.changed),
        };
    }

    fn share(self) -> f64 {
        match (self.changed, self.changed / self.size) {
            (0.0, _) => 0.0,
            (_, share) if share.is_nan() => f64::INFINITY,
            (_, share) => share,
        }
    }
}

/// Writes the response over `length` from `support(i)` over `lengths[i]`, the nearest first. Gives its parts on all levels.
fn interpolate<'a>(
    lengths: &[f64],
    length: f64,
    support: impl Fn(usize) -> &'a [f64],
    (powers, arms): (&[i32], &[f64]),
    found: &mut Vec<f64>,
) -> [Part; POWERS.len()] {
    found.clear();
    let mut parts = [Part::default(); POWERS.len()];
    if (0..lengths.len()).any(|number| support(number).is_empty()) {
        return parts;
    }
    found.resize(powers.len(), 0.0);
    for (power, part) in POWERS.into_iter().zip(&mut parts) {
        let places = || (0..powers.len()).filter(|&place| powers[place] == power);
        let mut sizes = [0.0; MOST_SUPPORTS];
        for (number, size) in sizes[..lengths.len()].iter_mut().enumerate() {
            *size = norm(places().map(|place| arms[place] * support(number)[place]));
        }
        let sizes = &sizes[..lengths.len()];
        if sizes.iter().all(|size| *size == 0.0) {
            continue;
        }
        let along = |number: usize, place: usize| support(number)[place] / sizes[number];
        let sized = || places().map(|place| (place, arms[place]));
        let fine = Block::new(lengths, sizes, length, power, sized(), along);
        let nearer = lengths.len() - 1;
        let (near_lengths, near_sizes) = (&lengths[..nearer], &sizes[..nearer]);
        let coarse = Block::new(near_lengths, near_sizes, length, power, sized(), along);
        let difference = sized()
            .map(|(place, arm)| arm * (fine.value(place, along) - coarse.value(place, along)));
        *part = Part {
            size: fine.size,
            changed: norm(difference),
        };
        for place in places() {
            found[place] = fine.value(place, along);
        }
    }
    parts
}

/// The outputs of one level: their size, and the weights of the known directions in theirs.
struct Block {
    size: f64,
    weights: [f64; MOST_SUPPORTS],
    supports: usize,
}

impl Block {
    fn new(
        lengths: &[f64],
        sizes: &[f64],
        length: f64,
        power: i32,
        sized: impl Iterator<Item = (usize, f64)>,
        along: impl Fn(usize, usize) -> f64,
    ) -> Self {
        let mut block = Self {
            size: f64::NAN,
            weights: [0.0; MOST_SUPPORTS],
            supports: lengths.len(),
        };
        let mut inverse = 0.0;
        for (number, (own, size)) in lengths.iter().zip(sizes).enumerate() {
            let others = lengths.iter().enumerate();
            let factors = others
                .filter(|(other, _)| *other != number)
                .map(|(_, other)| (length - other) / (own - other));
            let weight: f64 = factors.product();
            block.weights[number] = weight;
            inverse += weight * own.powi(power) / size;
        }
        let direction = norm(sized.map(|(place, arm)| arm * block.direction(place, &along)));
        // A size that has passed through infinity is none.
        if inverse > 0.0 {
            block.size = length.powi(power) / inverse;
        }
        for weight in &mut block.weights {
            *weight /= direction;
        }
        block
    }

    fn direction(&self, place: usize, along: impl Fn(usize, usize) -> f64) -> f64 {
        let weights = self.weights[..self.supports].iter().enumerate();
        weights
            .map(|(number, weight)| weight * along(number, place))
            .sum()
    }

    fn value(&self, place: usize, along: impl Fn(usize, usize) -> f64) -> f64 {
        self.size * self.direction(place, along)
    }
}

fn norm(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|value| value * value).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Position, velocity and acceleration under `lambda = s`, of a mass, of a mass-less damper and of a mass-less spring.
    fn mass(m: f64) -> impl Fn(f64) -> [f64; 3] {
        move |h| [h * h / (6.0 * m), h / (2.0 * m), 1.0 / m]
    }

    fn damper(d: f64) -> impl Fn(f64) -> [f64; 3] {
        move |h| [h / (2.0 * d), 1.0 / d, 1.0 / (d * h)]
    }

    /// The acceleration is that under `lambda = s^2`: under `s` it is 0.
    fn spring(c: f64) -> impl Fn(f64) -> [f64; 3] {
        move |h| [1.0 / c, 1.0 / (c * h), 2.0 / (c * h * h)]
    }

    /// A mass on a damper, `m v' + d v = s`.
    fn damped_mass(m: f64, d: f64) -> impl Fn(f64) -> [f64; 3] {
        move |h| {
            let z = d * h / m;
            let v = (1.0 - (1.0 - (-z).exp()) / z) / d;
            let x = h * (0.5 - 1.0 / z + (1.0 - (-z).exp()) / (z * z)) / d;
            [x, v, (1.0 - d * v) / m]
        }
    }

    fn found(response: impl Fn(f64) -> [f64; 3], lengths: &[f64], h: f64) -> (Vec<f64>, [f64; 3]) {
        let measured: Vec<[f64; 3]> = lengths.iter().map(|&length| response(length)).collect();
        let mut found = Vec::new();
        let parts = interpolate(
            lengths,
            h,
            |number| &measured[number],
            (&POWERS, &[1.0; 3]),
            &mut found,
        );
        (found, parts.map(Part::share))
    }

    fn off(found: &[f64], exact: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|level| (found[level] / exact[level] - 1.0).abs())
    }

    #[test]
    fn where_one_of_inertia_damping_and_stiffness_rules_any_length_is_found() {
        for h in [7e-5, 1.3e-3, 0.04] {
            let lengths = [1e-3, 2.3e-3, 7e-4];
            let (masses, _) = found(mass(1.7), &lengths, h);
            assert!(
                off(&masses, mass(1.7)(h)).iter().all(|off| *off < 1e-9),
                "{masses:?}"
            );
            let (dampers, _) = found(damper(31.0), &lengths, h);
            assert!(
                off(&dampers, damper(31.0)(h)).iter().all(|off| *off < 1e-9),
                "{dampers:?}"
            );
            let (springs, _) = found(spring(2e4), &lengths, h);
            assert!(
                off(&springs, spring(2e4)(h)).iter().all(|off| *off < 1e-9),
                "{springs:?}"
            );
        }
    }

    /// The error falls with the cube of the distances, what the farthest length changes with the square; the one is below the other.
    #[test]
    fn a_damped_mass_is_found_between_and_beyond_its_lengths() {
        for h in [1e-5, 1e-4, 1e-3, 1e-2] {
            let response = damped_mass(4.0, 3.5e5);
            for share in [0.8, 1.3] {
                let of = |distance: f64| {
                    let lengths = [0, 1, 2]
                        .map(|place: i32| h * share * (-distance * f64::from(place)).exp());
                    let (found, changed) = found(&response, &lengths, h);
                    (off(&found, response(h)), changed)
                };
                let (near, near_changed) = of(0.1);
                let (far, far_changed) = of(0.4);
                for level in 0..3 {
                    let context = format!(
                        "{h} {share} {level}: {far:?} {near:?} {far_changed:?} {near_changed:?}"
                    );
                    assert!(near[level] < 5e-3 && far[level] < 0.05, "{context}");
                    assert!(near[level] <= near_changed[level] + 1e-12, "{context}");
                    assert!(near[level] < 0.7 * far[level] + 1e-9, "{context}");
                }
            }
        }
    }

    #[test]
    fn what_changes_its_sign_cannot_be_told() {
        let (_, changed) = found(|h| [h - 2.0, 0.0, 0.0], &[1.9, 2.2, 1.5], 2.1);
        assert!(changed[0] > SETTINGS.most_changed, "{changed:?}");
        assert_eq!(changed[1..], [0.0, 0.0]);
        let (_, changed) = found(
            |h| [if h > 1.0 { 1.0 } else { 0.0 }, 0.0, 0.0],
            &[1.1, 0.9],
            1.0,
        );
        assert_eq!(changed[0], f64::INFINITY);
    }

    #[test]
    fn one_length_more_is_needed_than_is_known() {
        let mut found = vec![1.0];
        let parts = interpolate(&[1.0, 2.0], 1.5, |_| &[], (&POWERS, &[1.0; 3]), &mut found);
        assert!(found.is_empty() && parts.iter().all(|part| part.share() == 0.0));
    }

    proptest! {
        /// The size and the direction of a vector do not depend on the axes.
        #[test]
        fn turned_responses_are_found_turned(
            vectors in proptest::array::uniform3(proptest::array::uniform2(0.1f64..3.0)),
            angle in 0f64..6.0,
            h in 0.5f64..3.0,
        ) {
            let lengths = [1.0, 1.4, 0.8];
            let (sin, cos) = angle.sin_cos();
            let turn = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
            let find = |vectors: [[f64; 2]; 3]| {
                let mut found = Vec::new();
                let parts = interpolate(&lengths, h, |number| &vectors[number], (&[2, 2], &[1.0; 2]), &mut found);
                ([found[0], found[1]], parts[0].share())
            };
            let (plain, share) = find(vectors);
            let (turned, turned_share) = find(vectors.map(turn));
            prop_assume!(share.is_finite() && share < 10.0);
            let expected = turn(plain);
            let size = plain[0].hypot(plain[1]);
            prop_assert!((turned[0] - expected[0]).hypot(turned[1] - expected[1]) < 1e-6 * size);
            prop_assert!((share - turned_share).abs() < 1e-6 * share.max(1.0));
        }
    }
}
