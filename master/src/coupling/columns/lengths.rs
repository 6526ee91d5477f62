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
use super::kept::Measured;
use crate::coupling::layout::Layout;
use crate::joint::Level;

/// Most lengths that an interpolation goes through.
pub const MOST_SUPPORTS: usize = 3;

/// Share of a response that the farthest length may change.
const MOST_CHANGED: f64 = 0.05;

/// What the farthest length changes falls with the square of the distances, what is left then with the cube: power of the one in the other.
const LEFT_OF_CHANGE: f64 = 1.5;

/// Powers of the length in the responses to a load, by level.
const POWERS: [i32; 3] = [2, 1, 0];

/// Finds responses between lengths.
#[derive(Debug, Clone, PartialEq)]
pub struct Between {
    /// Levels whose responses count.
    levels: &'static [Level],
    /// For each subsystem and coupling output its power of the length.
    powers: Vec<Vec<i32>>,
    found: Measured,
    /// Responses over the nearest lengths, turned to one attitude.
    turned: [Vec<Vec<f64>>; MOST_SUPPORTS],
}

impl Between {
    /// For the outputs of `layout`, of which those on `levels` count. Those that no joint reads are taken for positions: whatever their power, the inverse is a polynomial of
    /// degree 2 at most.
    pub fn new(layout: &Layout, levels: &'static [Level]) -> Self {
        let outputs = layout.outputs.iter();
        let mut powers: Vec<Vec<i32>> = outputs.map(|own| vec![POWERS[0]; own.len()]).collect();
        for end in layout.joints.iter().flat_map(|joint| &joint.ends) {
            for (&level, power) in Level::ALL.iter().zip(POWERS) {
                for place in end.places(level) {
                    powers[end.subsystem][place] = power;
                }
            }
        }
        Self {
            levels,
            powers,
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
            let to = |frame: usize, _: &_| nearest.attitudes[frame];
            turn(layout, &support.attitudes, to, of_input, turned);
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
        for (subsystem, powers) in self.powers.iter().enumerate() {
            for own in &of_input[layout.input_range(subsystem)] {
                let mut whole = [Part::default(); POWERS.len()];
                for place in own.clone() {
                    let turned = &self.turned;
                    let support = |number: usize| &turned[number][place][..];
                    let parts =
                        interpolate(lengths, length, support, powers, &mut responses[place]);
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
        (changed <= MOST_CHANGED).then(|| changed.powf(LEFT_OF_CHANGE))
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
        match self.changed {
            0.0 => 0.0,
            changed => changed / self.size,
        }
    }
}

/// Writes the response over `length` from `support(i)` over `lengths[i]`, the nearest first. Gives its parts on all levels.
fn interpolate<'a>(
    lengths: &[f64],
    length: f64,
    support: impl Fn(usize) -> &'a [f64],
    powers: &[i32],
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
            *size = norm(places().map(|place| support(number)[place]));
        }
        let sizes = &sizes[..lengths.len()];
        if sizes.iter().all(|size| *size == 0.0) {
            continue;
        }
        let along = |number: usize, place: usize| support(number)[place] / sizes[number];
        let fine = Block::new(lengths, sizes, length, power, places(), along);
        let nearer = lengths.len() - 1;
        let (near_lengths, near_sizes) = (&lengths[..nearer], &sizes[..nearer]);
        let coarse = Block::new(near_lengths, near_sizes, length, power, places(), along);
        let difference =
            places().map(|place| fine.value(place, along) - coarse.value(place, along));
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
        places: impl Iterator<Item = usize>,
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
        let direction = norm(places.map(|place| block.direction(place, &along)));
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
