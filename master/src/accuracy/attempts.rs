//! What several attempts at a macro step tell of variables that have no past.

use serde::{Deserialize, Serialize};

/// The error of a chord falls with this power of its length.
pub const CHORD_ORDER: usize = 2;

/// The values at the end of the attempt before at the present macro step, which was longer or shorter.
///
/// A variable without a past is interpolated by a chord over the first step. How much that is off shows in no difference between predicted and
/// corrected value, which is the slope for the most part. Two attempts tell the curvature: with `w_1` after `H_1` and `w` after `H`,
/// `c = ((w_1 - w_0)/H_1 - (w - w_0)/H) / (H_1 - H)`, and the chord over `H` misses the parabola by `c H^2 / 6` in the mean.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Attempts {
    before: Attempt,
    /// The present attempt, once it is corrected.
    present: Attempt,
}

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct Attempt {
    /// 0 if there is none.
    length: f64,
    ends: Vec<f64>,
}

impl Attempts {
    /// The attempt over this length was corrected to these values of all variables.
    pub fn correct(&mut self, length: f64, ends: &[f64]) {
        self.present.length = length;
        self.present.ends.clear();
        self.present.ends.extend_from_slice(ends);
    }

    /// Another attempt at the same step begins.
    pub fn repeat(&mut self) {
        if self.present.length > 0.0 {
            std::mem::swap(&mut self.before, &mut self.present);
            self.present.length = 0.0;
        }
    }

    /// The step is taken.
    pub fn move_on(&mut self) {
        (self.before.length, self.present.length) = (0.0, 0.0);
    }

    /// Mean error of the chord of a variable over the present attempt from the value `start`; `None` if there was no other one.
    pub fn chord_error(&self, variable: usize, start: f64) -> Option<f64> {
        let slope = |attempt: &Attempt| (attempt.ends[variable] - start) / attempt.length;
        let (before, present) = (&self.before, &self.present);
        if before.length == 0.0 || present.length == 0.0 || before.length == present.length {
            return None;
        }
        let curvature = (slope(before) - slope(present)) / (before.length - present.length);
        Some(curvature * present.length * present.length / 6.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_attempts_tell_the_curvature_of_a_parabola() {
        let parabola = |t: f64| 3.0 - 70.0 * t + 11.0 * t * t;
        let mut attempts = Attempts::default();
        attempts.correct(0.7, &[0.0, parabola(0.7)]);
        assert_eq!(attempts.chord_error(1, 3.0), None);
        attempts.repeat();
        attempts.correct(0.2, &[0.0, parabola(0.2)]);
        let error = attempts.chord_error(1, 3.0).unwrap();
        assert!((error - 11.0 * 0.04 / 6.0).abs() < 1e-12, "{error}");
        attempts.repeat();
        // An attempt that failed before it was corrected tells nothing.
        attempts.repeat();
        attempts.correct(0.1, &[0.0, parabola(0.1)]);
        assert!(attempts.chord_error(1, 3.0).is_some());
        attempts.move_on();
        assert_eq!(attempts.chord_error(1, 3.0), None);
    }
}
