//! Inputs over a step as polynomials in its share.

use linchpin_proto::v1::Signal;

/// Highest degree that the kit sends of its own accord.
pub const HIGHEST_DEGREE: usize = 3;

/// A polynomial `c_0 + c_1 s + c_2 s^2 + c_3 s^3` in the share `s` of a step, `0 <= s <= 1`.
pub type Powers = [f64; HIGHEST_DEGREE + 1];

/// One polynomial for every input, in the unit of the input.
#[derive(Debug, Clone, PartialEq)]
pub struct Inputs {
    powers: Vec<Powers>,
}

impl Inputs {
    /// The same values during the whole step.
    pub fn constant(values: &[f64]) -> Self {
        let constant = |&value: &f64| [value, 0.0, 0.0, 0.0];
        Self {
            powers: values.iter().map(constant).collect(),
        }
    }

    /// The same with `size s^power` added to an input.
    #[must_use]
    pub fn plus(mut self, input: usize, size: f64, power: usize) -> Self {
        self.powers[input][power] += size;
        self
    }

    /// The same, all of them times a factor.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        for power in self.powers.iter_mut().flatten() {
            *power *= factor;
        }
        self
    }

    /// The same with constants behind them.
    #[must_use]
    pub fn and(mut self, values: &[f64]) -> Self {
        self.powers.extend(Self::constant(values).powers);
        self
    }

    /// Value of an input at a share of the step.
    pub fn value(&self, input: usize, share: f64) -> f64 {
        let powers = self.powers[input].iter().rev();
        powers.fold(0.0, |sum, power| sum * share + power)
    }

    /// Values of all inputs at a share of the step.
    pub fn values(&self, share: f64) -> Vec<f64> {
        (0..self.powers.len())
            .map(|input| self.value(input, share))
            .collect()
    }

    /// The signals of a step that has this length (s), all inputs driven.
    pub fn signals(&self, length: f64) -> Vec<Signal> {
        self.part([0.0, 1.0], length)
    }

    /// The signals of the part between two shares of a step of this length (s), as a step of its own.
    pub fn part(&self, [from, to]: [f64; 2], length: f64) -> Vec<Signal> {
        (0..self.powers.len())
            .map(|input| self.signal(input, [from, to], length))
            .collect()
    }

    /// The signal of one input, through nodes that are spread over the part.
    pub fn signal(&self, input: usize, [from, to]: [f64; 2], length: f64) -> Signal {
        let degree = self.degree(input);
        let share = |node: usize| match degree {
            0 => 0.0,
            degree => node as f64 / degree as f64,
        };
        let nodes = (0..=degree).map(share);
        Signal {
            input: input as u32,
            nodes: nodes
                .clone()
                .map(|own| own * (to - from) * length)
                .collect(),
            values: nodes
                .map(|own| self.value(input, from + own * (to - from)))
                .collect(),
        }
    }

    /// The same polynomial of one input, through nodes at these shares of the step, inside or outside of it.
    pub fn signal_through(&self, input: usize, shares: &[f64], length: f64) -> Signal {
        Signal {
            input: input as u32,
            nodes: shares.iter().map(|share| share * length).collect(),
            values: shares
                .iter()
                .map(|&share| self.value(input, share))
                .collect(),
        }
    }

    /// The highest power of an input that is not zero.
    fn degree(&self, input: usize) -> usize {
        let powers = &self.powers[input];
        powers.iter().rposition(|&power| power != 0.0).unwrap_or(0)
    }
}
