//! One macro step of a predictor/corrector method, one message to each worker unless it is corrected more than once.

use std::time::{Duration, Instant};

use super::renewal::{Renewal, last_change};
use super::step_size::{Judgement, StepSize};
use super::{Outcome, Parts, exchange};
use crate::coupling::corrector::Corrector;
use crate::error::RunError;
use crate::time::{MacroStep, TimePlan};

/// The present macro step of `plan`, and in the same exchange as its advance the look-ahead over the following one.
///
/// The prediction over the step, with its perturbed steps, came with the exchange before. Where steps vary, a step that is too
/// long is repeated by another look-ahead before any worker has taken it.
pub(super) fn macro_step(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    renewal: &mut Renewal,
    plan: &mut TimePlan,
    first: MacroStep,
    step_size: Option<&mut StepSize>,
) -> Result<Outcome, RunError> {
    let mut outcome = Outcome::of_step(first, correct(method, parts, first)?);
    let mut wish = first.length;
    if let Some(step_size) = step_size {
        repeat_until_accepted(method, parts, renewal, plan, step_size, &mut outcome)?;
        wish = step_size.wish();
    }
    correct_again(method, parts, renewal, &mut outcome)?;
    let step = outcome.step;
    parts.prepare_advance(step);
    method.request_advance(parts, step);
    method.move_on(step);
    let following = plan.following(wish);
    match following {
        Some(following) => {
            let with_columns = renewal.wants_columns(method, following);
            method.request_prediction(parts, following, with_columns)?;
        }
        None => parts.forgo_prediction(),
    }
    exchange(&mut parts.subsystems, step)?;
    plan.move_on(following);
    outcome.verdict = method.judge(parts);
    outcome.passes = renewal.finish(method, parts);
    Ok(outcome)
}

/// Corrects as often as columns of earlier steps or the scene demand it.
fn correct_again(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    renewal: &mut Renewal,
    outcome: &mut Outcome,
) -> Result<(), RunError> {
    let step = outcome.step;
    renewal.begin(method);
    while let Some(with_columns) = renewal.next_pass() {
        let Some(again) = method.again() else { break };
        again.request_pass(parts, step, with_columns);
        exchange(&mut parts.subsystems, step)?;
        outcome.solving += correct(method, parts, step)?;
        renewal.note_pass(last_change(method), with_columns);
    }
    renewal.refuse(parts, step)
}

/// Corrects, and gives the time that it took.
fn correct(
    method: &mut dyn Corrector,
    parts: &Parts,
    step: MacroStep,
) -> Result<Duration, RunError> {
    let started = Instant::now();
    method.correct(parts, step)?;
    Ok(started.elapsed())
}

fn repeat_until_accepted(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    renewal: &mut Renewal,
    plan: &mut TimePlan,
    step_size: &mut StepSize,
    outcome: &mut Outcome,
) -> Result<(), RunError> {
    loop {
        let estimate = method.error_estimate(parts, outcome.step, step_size.scales());
        let purpose = step_size.purpose(&estimate);
        let scales = step_size.scales();
        let next = method.choose_degrees(parts, outcome.step, scales, &estimate, purpose);
        let judgement = step_size.judge(outcome.step, &estimate, &next, parts)?;
        let Judgement::Repeat { length, has_jumped } = judgement else {
            return Ok(());
        };
        if has_jumped {
            method.restart();
        }
        outcome.step = plan.shorten(length);
        let with_columns = renewal.wants_columns(method, outcome.step);
        look_ahead(method, parts, outcome.step, with_columns)?;
        outcome.solving += correct(method, parts, outcome.step)?;
    }
}

/// A look-ahead from the present macro point, with no advance before it.
pub(super) fn look_ahead(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    step: MacroStep,
    with_columns: bool,
) -> Result<(), RunError> {
    parts.forgo_advance();
    method.request_prediction(parts, step, with_columns)?;
    exchange(&mut parts.subsystems, step)
}
