//! One macro step of a method without a corrector.

use super::step_size::{Judgement, StepSize};
use super::{Outcome, Parts};
use crate::coupling::uncorrected::Uncorrected;
use crate::error::RunError;
use crate::time::{MacroStep, TimePlan};

/// The present macro step of `plan`. Where steps vary, a step that proves too long is taken back by all workers and tried again with
/// a shorter one.
pub(super) fn macro_step(
    method: &mut dyn Uncorrected,
    parts: &mut Parts,
    plan: &mut TimePlan,
    first: MacroStep,
    step_size: Option<&mut StepSize>,
) -> Result<Outcome, RunError> {
    let mut wish = first.length;
    let outcome = match step_size {
        Some(step_size) => {
            let outcome = advance_until_accepted(method, parts, plan, first, step_size)?;
            wish = step_size.wish();
            outcome
        }
        None => Outcome::of_step(first, method.advance(parts, first)?),
    };
    method.move_on(outcome.step);
    plan.move_on(plan.following(wish));
    Ok(outcome)
}

/// A jump of the loads needs no history that starts anew: a step that is short enough takes it, whatever lies before.
fn advance_until_accepted(
    method: &mut dyn Uncorrected,
    parts: &mut Parts,
    plan: &mut TimePlan,
    first: MacroStep,
    step_size: &mut StepSize,
) -> Result<Outcome, RunError> {
    method.prepare_estimate(parts, first, step_size.scales())?;
    let mut outcome = Outcome::of_step(first, method.advance(parts, first)?);
    loop {
        let estimate = method.error_estimate(parts, outcome.step, step_size.scales());
        let judgement = step_size.judge(outcome.step, &estimate, parts)?;
        let Judgement::Repeat { length, .. } = judgement else {
            return Ok(outcome);
        };
        outcome.step = plan.shorten(length);
        parts.go_back();
        outcome.solving += method.advance(parts, outcome.step)?;
    }
}
