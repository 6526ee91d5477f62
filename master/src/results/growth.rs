//! How much the values of a run have grown, and whether as those of a run that diverges.

use serde::{Deserialize, Serialize};

/// A value may grow by this factor since it was as large as a run is at its beginning.
pub const MOST_GROWTH: f64 = 1e12;

/// Number of steps that set the size of the values at the beginning of a motion.
const FIRST_STEPS: usize = 10;

/// Growth in one step by more than this, after one of less than [`CALM`], is the beginning of another motion: a load sets in at rest, where
/// values are rounding.
const BEGINS: f64 = 1e3;

/// Number of steps for which a motion from rest is young.
const YOUNG: usize = 50;

/// Growth in one step of a motion that goes on.
const CALM: f64 = 10.0;

/// Watches the largest of all values.
///
/// A run that diverges grows by the same factor in every step, a sound one by a power of the time: from half of the steps to all of them
/// hardly. So growth counts from the largest value that there was half as many steps ago at least, but not before the
/// beginning of the motion.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Growth {
    /// Largest value so far.
    largest: f64,
    /// Whether the last step has hardly changed that.
    is_calm: bool,
    /// Whether the motion began at rest.
    began_at_rest: bool,
    /// Steps since the motion began.
    steps: usize,
    /// The next number of steps after which the size is taken down.
    next: usize,
    /// The largest value when it was taken down last, and the time before.
    taken: [f64; 2],
}

impl Growth {
    /// From the largest value at the start.
    pub fn from(largest: f64) -> Self {
        let mut own = Self::default();
        own.take(largest);
        own
    }

    /// Whether a load has set in at rest some steps ago: what moves has hardly moved.
    pub fn is_young(&self) -> bool {
        self.began_at_rest && self.steps <= YOUNG
    }

    /// Takes the largest value at a macro point. Gives whether it has grown too much.
    pub fn take(&mut self, largest: f64) -> bool {
        self.steps += 1;
        let may_begin = self.is_calm && (self.steps > FIRST_STEPS || self.steps == 2);
        if may_begin && largest > BEGINS * self.largest {
            *self = Self {
                steps: 1,
                began_at_rest: true,
                ..Self::default()
            };
        }
        self.is_calm = self.steps == 1 && !self.began_at_rest || largest <= CALM * self.largest;
        self.largest = self.largest.max(largest);
        if self.steps <= FIRST_STEPS {
            self.taken = [self.largest; 2];
            self.next = 2 * FIRST_STEPS;
        } else if self.steps == self.next {
            self.taken = [self.largest, self.taken[0]];
            self.next *= 2;
        }
        let from = self.taken[1];
        from > 0.0 && largest > MOST_GROWTH * from
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The step in which values are found to have grown too much.
    fn found(values: impl Iterator<Item = f64>) -> Option<usize> {
        let mut growth = Growth::default();
        let mut values = values;
        values.position(|value| growth.take(value))
    }

    #[test]
    fn equal_factors_in_every_step_are_found() {
        for factor in [1.03, 1.5, 9.0, 11.0, 1e3, 1.1e3, 1e6, 1e20] {
            let needed = (MOST_GROWTH.ln() / f64::ln(factor)).ceil() as usize;
            for first in [1.0, 1e-17, 1e-280] {
                let found = found((0..4000).map(|n| first * factor.powi(n)));
                let found = found.expect("values grow without end");
                assert!(
                    (needed..=2 * needed + 5 * FIRST_STEPS).contains(&found),
                    "{factor}: {found} of {needed}"
                );
            }
            let after_a_sound_run =
                (0..5000).map(|n| 1.0 + 1e-16 * factor.powi(n - 200).min(1e300));
            let found = self::found(after_a_sound_run).expect("the last values grow without end");
            assert!(found < 4999, "{factor}: {found}");
        }
    }

    #[test]
    fn loads_that_set_in_at_rest_and_powers_of_the_time_are_none() {
        for rest in [0.0, 6e-17, 1e-14, 1e-200] {
            for power in [1, 2, 4, 8] {
                for start in [0, 3, 9, 10, 11, 500] {
                    let motion = |n: i32| rest + (1e-9 * f64::from((n - start).max(0))).powi(power);
                    assert_eq!(
                        found((0..100_000).map(motion)),
                        None,
                        "{rest} {power} {start}"
                    );
                }
            }
        }
    }

    #[test]
    fn one_motion_may_set_in_after_the_other() {
        let motion = |n: i32| [1e-17, 1e-9, 1e3, 1e15][(n / 100) as usize];
        assert_eq!(found((0..400).map(motion)), None);
    }
}
