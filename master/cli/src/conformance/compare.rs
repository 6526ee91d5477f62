//! Comparisons of values with what is allowed.

use serde::Serialize;

/// Two values that should agree.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Difference {
    /// Which value.
    pub place: String,
    /// That of the worker.
    pub found: f64,
    /// What it should be.
    pub expected: f64,
    /// By how much they may differ, in the unit of the values.
    pub allowed: f64,
}

impl Difference {
    /// How far they differ, as a multiple of what is allowed; infinite if nothing is allowed or a value is not finite.
    pub fn ratio(&self) -> f64 {
        let apart = (self.found - self.expected).abs();
        match apart / self.allowed {
            _ if apart == 0.0 => 0.0,
            ratio if ratio.is_nan() => f64::INFINITY,
            ratio => ratio,
        }
    }
}

/// Several values that should agree.
#[derive(Debug, Clone, Default)]
pub struct Comparison {
    /// How many values were compared.
    pub compared: usize,
    /// Those that differ by more than is allowed.
    pub beyond: Vec<Difference>,
    /// The one that differs most, as a multiple of what is allowed.
    pub worst: Option<Difference>,
}

impl Comparison {
    /// Compares two values; they may differ by `allowed`, in their unit.
    pub fn near(&mut self, place: impl Into<String>, found: f64, expected: f64, allowed: f64) {
        let difference = Difference {
            place: place.into(),
            found,
            expected,
            allowed,
        };
        self.compared += 1;
        let ratio = difference.ratio();
        if self
            .worst
            .as_ref()
            .is_none_or(|worst| ratio > worst.ratio())
        {
            self.worst = Some(difference.clone());
        }
        if ratio > 1.0 {
            self.beyond.push(difference);
        }
    }

    /// Compares two lists of values bit by bit; a zero has no sign.
    pub fn same(&mut self, names: &[String], found: &[f64], expected: &[f64]) {
        for ((name, &found), &expected) in names.iter().zip(found).zip(expected) {
            self.near(name, found, expected, 0.0);
        }
    }

    /// The largest difference as a multiple of what is allowed; 0 if nothing was compared.
    pub fn ratio(&self) -> f64 {
        self.worst.as_ref().map_or(0.0, Difference::ratio)
    }

    /// Whether all values agree.
    pub fn holds(&self) -> bool {
        self.beyond.is_empty()
    }
}

/// By how much two computations of values of this size may differ by rounding alone: a few units in the last place, for
/// sums of a few dozen terms.
pub fn rounding(sizes: &[f64]) -> f64 {
    64.0 * f64::EPSILON
        * sizes
            .iter()
            .fold(0.0, |largest: f64, size| largest.max(size.abs()))
}
