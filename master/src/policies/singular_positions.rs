//! Positions of a mechanism in which its joints do not determine their multipliers: bars in line.
//!
//! The least pivot of the equations of a step, as a share of its column, goes to 0 with the square of the distance from such a position. Near
//! it columns of earlier steps are wrong by as much as they are small themselves, and errors do not fall with the length of a step any more.

use serde::{Deserialize, Serialize};

use crate::accuracy::SingularPosition;
use crate::results::SingularPassages;
use crate::time::MacroStep;

/// A mechanism is near a singular position where the least pivot is below this share of the largest one that it has had. Larger asks for more
/// columns than it takes, smaller uses columns that are wrong: at 1e-2 the double four-bar ends in the position with a tolerance of 1e-8.
const NEAR: f64 = 0.1;

/// What has come below this share has passed the position.
const PASSED: f64 = 0.01;

/// Near a singular position columns are those of a step whose least pivot differs by no more than this factor.
const LIKE: f64 = 1.5;

/// Attempts at a step near a singular position come to an end at this share of the last step before: with larger ones a step misses more of the
/// tolerance than it has to, with smaller ones steps come nearer and nearer to the position and never across.
const LEAST: f64 = 1.0 / 32.0;

/// What a step that is taken near a singular position means for the next one; nothing elsewhere.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Approach {
    /// Whether it needs columns of its own.
    pub needs_columns: bool,
    /// Its least length in s.
    pub least: f64,
}

/// Watches how far the equations of the steps are from having no unique solution.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SingularPositions {
    /// The largest least pivot so far.
    usual: f64,
    /// That of the last step.
    last: f64,
    /// The length in s of the last step that did not end near a position.
    length: f64,
    /// How far ahead in s the position is, where steps come nearer to one.
    ahead: Option<f64>,
    /// The time in s and the least pivot of the step nearest to the position that is being passed.
    nearest: Option<(f64, f64)>,
    passages: SingularPassages,
}

impl SingularPositions {
    /// Whether a step with this least pivot ends near a singular position.
    fn is_near(&self, least_pivot: f64) -> bool {
        least_pivot < NEAR * self.usual
    }

    /// The position that a step with this least pivot ends near, or begins near.
    pub fn nearby(&self, least_pivot: f64) -> Option<SingularPosition> {
        let is_near = self.is_near(least_pivot) || self.is_near(self.last);
        is_near.then(|| SingularPosition {
            across: self.ahead.map(|ahead| 2.0 * ahead),
            least: LEAST * self.length,
        })
    }

    /// Takes a step; what follows for the next one.
    pub fn accept(&mut self, step: MacroStep, least_pivot: f64) -> Approach {
        self.usual = self.usual.max(least_pivot);
        if !self.is_near(least_pivot) {
            self.length = step.length;
        }
        let ratio = least_pivot / self.last;
        let is_like = (1.0 / LIKE..=LIKE).contains(&ratio);
        // The square root falls like the distance.
        let fall = self.last.sqrt() - least_pivot.sqrt();
        self.ahead = (fall > 0.0).then(|| step.length * least_pivot.sqrt() / fall);
        self.last = least_pivot;
        if self.is_near(least_pivot) {
            let nearest = self.nearest.filter(|(_, least)| *least <= least_pivot);
            self.nearest = Some(nearest.unwrap_or((step.end, least_pivot)));
            return Approach {
                needs_columns: !is_like,
                least: LEAST * self.length,
            };
        }
        if let Some((t, least)) = self.nearest.take()
            && least < PASSED * self.usual
        {
            self.passages.count += 1;
            self.passages.first.get_or_insert(t);
            tracing::debug!(t, least_pivot = least, "passed a singular position");
        }
        Approach::default()
    }

    /// A step with an impact says nothing of positions; behind it contacts are others, and with them the equations.
    pub fn restart(&mut self) -> Approach {
        *self = Self {
            passages: self.passages,
            ..Self::default()
        };
        Approach::default()
    }

    /// The step is taken although its error is larger than allowed: shorter ones would be no better.
    pub fn take_unsolved(&mut self) {
        self.passages.unsolved_steps += 1;
    }

    /// What the mechanism has passed so far.
    pub fn passages(&self) -> SingularPassages {
        self.passages
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of 0.1 s with these least pivots; for each whether the next one needs columns.
    fn accept(pivots: &[f64]) -> (Vec<bool>, SingularPassages) {
        let mut own = SingularPositions::default();
        let steps = pivots.iter().enumerate().map(|(number, &pivot)| {
            let start = 0.1 * number as f64;
            let (length, end) = (0.1, start + 0.1);
            own.accept(MacroStep { start, length, end }, pivot)
                .needs_columns
        });
        (steps.collect(), own.passages())
    }

    #[test]
    fn a_position_is_passed_where_the_least_pivot_was_least() {
        let (needs, passages) = accept(&[0.1, 0.09, 0.05, 5e-3, 2e-5, 4e-5, 6e-3, 0.04, 0.1]);
        let expected = [false, false, false, true, true, true, true, false, false];
        assert_eq!(needs, expected);
        assert_eq!(passages.count, 1);
        assert!((passages.first.unwrap() - 0.5).abs() < 1e-12);
    }

    #[test]
    fn small_pivots_that_stay_are_no_passage_and_keep_their_columns() {
        let (needs, passages) = accept(&[0.1, 5e-3, 5.5e-3, 5e-3, 4.5e-3]);
        assert_eq!(needs, [false, true, false, false, false]);
        assert_eq!(passages, SingularPassages::default());
        // Nor are those of equations that are ill-conditioned from the first step on.
        let (needs, passages) = accept(&[1e-9, 1.1e-9, 0.9e-9]);
        assert_eq!((needs, passages.count), (vec![false; 3], 0));
    }
}
