//! One macro step of a method without a corrector.

use super::step_size::StepSize;
use crate::coupling::uncorrected::Uncorrected;
use crate::error::RunError;
use crate::results::Outcome;
use crate::time::{MacroStep, TimePlan};
use crate::workers::Parts;

/// The present macro step of `plan`. Where steps vary, a step that proves too long is taken back by all workers and tried again with
/// a shorter one.
pub(super) fn macro_step(
    method: &mut dyn Uncorrected,
    parts: &mut Parts,
    plan: &mut TimePlan,
    first: MacroStep,
    steps: Option<(&mut StepSize, &mut Ceiling)>,
) -> Result<Outcome, RunError> {
    let mut wish = first.length;
    let outcome = match steps {
        Some((step_size, ceiling)) => {
            let (outcome, wished) = advance_until_accepted(method, parts, plan, first, step_size)?;
            ceiling.note(first.length, outcome.step.length);
            wish = ceiling.limit(wished, outcome.step.length);
            outcome
        }
        None => Outcome::of_step(first, method.advance(parts, first)?),
    };
    method.move_on(outcome.step);
    plan.move_on(plan.following(wish));
    Ok(outcome)
}

/// Shortens the step until its error is small enough; also the length of the next one. Histories never start anew, also where loads jump: the run with the accepted steps
/// alone, which knows of no rejected one, has equal bits.
fn advance_until_accepted(
    method: &mut dyn Uncorrected,
    parts: &mut Parts,
    plan: &mut TimePlan,
    first: MacroStep,
    step_size: &mut StepSize,
) -> Result<(Outcome, f64), RunError> {
    method.prepare_estimate(parts, first, step_size.scales())?;
    let mut outcome = Outcome::of_step(first, method.advance(parts, first)?);
    loop {
        let estimate = method.error_estimate(parts, outcome.step, step_size.scales());
        let Err(obstacle) = step_size.check_error(outcome.step, &estimate, &estimate, parts) else {
            let wish = step_size.accept(outcome.step, &estimate, true);
            return Ok((outcome, wish));
        };
        let repetition = step_size.repeat(outcome.step, obstacle)?;
        outcome.step = plan.shorten(repetition.length);
        parts.go_back();
        outcome.solving += method.advance(parts, outcome.step)?;
    }
}

/// Share of a rejected length below which the steps stay for a while.
const BELOW: f64 = 0.9;

/// Lengths within this factor are rejected for the same reason.
const ALIKE: f64 = 2.0;

/// Most steps for which a rejected length is remembered.
const MOST_PATIENCE: u32 = 64;

/// A step after that is at most this many times as long as the one before.
const CAUTIOUS_GROWTH: f64 = 1.25;

/// Keeps the steps below the length at which a stiff spring becomes unstable.
///
/// Above that length its load grows from step to step until the error is too large. Just below, the error is small and asks for longer steps.
/// So a length that is rejected again and again is tried more and more seldom.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ceiling {
    rejected: f64,
    length: f64,
    /// For how many steps the ceiling holds.
    patience: u32,
    /// Steps that were taken since the last rejected one.
    since: u32,
}

impl Ceiling {
    /// None.
    pub fn new() -> Self {
        Self {
            rejected: f64::INFINITY,
            length: f64::INFINITY,
            patience: 1,
            since: 0,
        }
    }

    /// Takes how long a step was tried first, and how long it was at last.
    fn note(&mut self, first: f64, taken: f64) {
        if taken == first {
            self.since = self.since.saturating_add(1);
            return;
        }
        let ratio = first / self.rejected;
        let is_known = ratio < ALIKE && ratio > 1.0 / ALIKE;
        self.patience = match is_known {
            true if self.since >= self.patience => MOST_PATIENCE.min(2 * self.patience),
            // The ceiling was too high.
            true => self.patience,
            false => 1,
        };
        self.rejected = first;
        self.length = taken.max(BELOW * first);
        self.since = 0;
    }

    /// The length of the next step where one of length `wish` is wished for after one of length `last`.
    fn limit(&self, wish: f64, last: f64) -> f64 {
        if self.since < self.patience {
            wish.min(self.length)
        } else if self.patience > 1 {
            wish.min(CAUTIOUS_GROWTH * last)
        } else {
            wish
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps that want to grow and are rejected above one length.
    #[test]
    fn a_length_that_is_rejected_again_and_again_is_tried_seldom() {
        let mut ceiling = Ceiling::new();
        let (mut length, mut rejected) = (1e-3, 0);
        for _ in 0..1000 {
            let taken = if length > 1.0 { 0.8 * length } else { length };
            rejected += u32::from(taken != length);
            ceiling.note(length, taken);
            length = ceiling.limit(1.6 * taken, taken);
        }
        assert!((10..60).contains(&rejected), "{rejected}");
    }

    #[test]
    fn a_single_rejected_step_keeps_no_other_from_growing() {
        let mut ceiling = Ceiling::new();
        ceiling.note(1.0, 0.25);
        assert_eq!(ceiling.limit(0.25, 0.25), 0.25);
        ceiling.note(0.25, 0.25);
        assert_eq!(ceiling.limit(2.0, 1.0), 2.0);
    }
}
