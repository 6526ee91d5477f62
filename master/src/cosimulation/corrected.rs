//! One macro step of a predictor/corrector method, one message to each worker.

use std::time::Instant;

use super::step_size::{Judgement, StepSize};
use super::{Outcome, Parts, exchange};
use crate::coupling::corrector::Corrector;
use crate::error::RunError;
use crate::time::{MacroStep, TimePlan};

/// The present macro step of `plan`, and in the same exchange the look-ahead over the following one.
///
/// The prediction over the step, with its perturbed steps, came with the exchange before. Where steps vary, a step that is too
/// long is repeated by another look-ahead before any worker has taken it.
pub(super) fn macro_step(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    plan: &mut TimePlan,
    first: MacroStep,
    step_size: Option<&mut StepSize>,
) -> Result<Outcome, RunError> {
    let started = Instant::now();
    method.correct(parts, first)?;
    let mut outcome = Outcome::of_step(first, started.elapsed());
    let mut wish = first.length;
    if let Some(step_size) = step_size {
        repeat_until_accepted(method, parts, plan, step_size, &mut outcome)?;
        wish = step_size.wish();
    }
    let step = outcome.step;
    parts.prepare_advance(step);
    method.request_advance(parts, step);
    method.move_on(step);
    let following = plan.following(wish);
    match following {
        Some(following) => method.request_prediction(parts, following, true)?,
        None => parts.forgo_prediction(),
    }
    exchange(&mut parts.subsystems, step)?;
    plan.move_on(following);
    outcome.verdict = method.judge(parts);
    Ok(outcome)
}

fn repeat_until_accepted(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    plan: &mut TimePlan,
    step_size: &mut StepSize,
    outcome: &mut Outcome,
) -> Result<(), RunError> {
    loop {
        let estimate = method.error_estimate(parts, outcome.step, step_size.scales());
        let judgement = step_size.judge(outcome.step, &estimate, parts)?;
        let Judgement::Repeat { length, has_jumped } = judgement else {
            return Ok(());
        };
        if has_jumped {
            method.restart();
        }
        outcome.step = plan.shorten(length);
        look_ahead(method, parts, outcome.step)?;
        let started = Instant::now();
        method.correct(parts, outcome.step)?;
        outcome.solving += started.elapsed();
    }
}

/// A look-ahead from the present macro point, with no advance before it.
pub(super) fn look_ahead(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    step: MacroStep,
) -> Result<(), RunError> {
    parts.forgo_advance();
    method.request_prediction(parts, step, true)?;
    exchange(&mut parts.subsystems, step)
}
