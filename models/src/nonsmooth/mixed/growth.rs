//! Whether a run has blown up: what fails in its last step is not what is wrong.

use crate::nonsmooth::mechanics::StepError;

/// Steps between two marks.
const STRIDE: u64 = 256;
/// From rest velocities grow at most by the number of steps between two marks under constant forces; beyond the limit
/// of stability they grow by a factor in each step.
const BLOWN_UP: f64 = 1e6;

/// The largest velocity now and some hundred steps ago.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Growth {
    steps: u64,
    recent: f64,
    older: f64,
}

impl Growth {
    /// Takes note of the velocities after a step.
    pub fn note(&mut self, v: &[f64]) {
        if self.steps.is_multiple_of(STRIDE) {
            let is_first = self.older == 0.0;
            self.older = if is_first { largest(v) } else { self.recent };
            self.recent = largest(v);
        }
        self.steps += 1;
    }

    /// What a failure means behind these velocities.
    pub fn explain(&self, error: StepError, v: &[f64]) -> StepError {
        let factor = largest(v) / self.older;
        // Not a number: infinite velocities.
        let has_blown_up = factor.is_nan() || factor > BLOWN_UP;
        if self.older > 0.0 && has_blown_up {
            return StepError::Unstable { factor };
        }
        error
    }
}

fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |largest, v| v.abs().max(largest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_fall_from_rest_has_not_blown_up_and_a_factor_in_each_step_has() {
        let singular = StepError::Singular(crate::nonsmooth::matrix::Singular { row: 3 });
        let mut growth = Growth::default();
        for step in 1..2000 {
            let v = [-9.81e-5 * f64::from(step)];
            growth.note(&v);
            assert_eq!(growth.explain(singular, &v), singular, "step {step}");
        }
        let mut growth = Growth::default();
        let mut v = [0.02, 0.0];
        for _ in 0..60 {
            growth.note(&v);
            v[0] *= -1.8;
        }
        let explained = growth.explain(singular, &v);
        assert!(matches!(explained, StepError::Unstable { factor } if factor > 1e15));
    }
}
