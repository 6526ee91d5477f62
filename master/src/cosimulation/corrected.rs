//! One macro step of a predictor/corrector method, one message to each worker unless it is corrected more than once.

use std::time::{Duration, Instant};

use super::obstacle::Obstacle;
use super::renewal::Renewal;
use super::step_size::StepSize;
use crate::coupling::corrector::Corrector;
use crate::coupling::error_estimate::Estimate;
use crate::error::RunError;
use crate::results::Outcome;
use crate::time::{MacroStep, TimePlan};
use crate::workers::{Parts, exchange, recovery};

/// The present macro step of `plan`, and in the same exchange as its advance the look-ahead over the following one.
///
/// The prediction over the step, with its perturbed steps, came with the exchange before. Where steps vary, a step that meets an
/// obstacle is repeated by another look-ahead, shorter, before any worker has taken it.
pub(super) fn macro_step(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    renewal: &mut Renewal,
    plan: &mut TimePlan,
    first: MacroStep,
    mut step_size: Option<&mut StepSize>,
) -> Result<Outcome, RunError> {
    let mut outcome = Outcome::of_step(first, Duration::ZERO);
    let mut wish = first.length;
    match &mut step_size {
        Some(step_size) => {
            wish = repeat_until_accepted(method, parts, renewal, plan, step_size, &mut outcome)?;
        }
        None => {
            attempt(method, parts, renewal, None, &mut outcome)?;
        }
    }
    let step = outcome.step;
    renewal.take(step);
    parts.prepare_advance(step);
    method.request_advance(parts, step);
    method.move_on(step);
    let following = plan.following(wish);
    match following {
        Some(following) => {
            let with_columns = renewal.wants_columns(method, parts, following);
            method.request_prediction(parts, following, with_columns)?;
        }
        None => parts.forgo_prediction(),
    }
    match step_size.filter(|own| own.varies()) {
        None => exchange(&mut parts.subsystems, step)?,
        Some(step_size) => {
            step_size.keep_refusal(recovery::advance(&mut parts.subsystems, step)?);
        }
    }
    plan.move_on(following);
    outcome.verdict = method.judge(parts);
    outcome.passes = renewal.finish(method, parts);
    Ok(outcome)
}

/// Shortens the step until nothing stands against it; the length of the next one.
fn repeat_until_accepted(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    renewal: &mut Renewal,
    plan: &mut TimePlan,
    step_size: &mut StepSize,
    outcome: &mut Outcome,
) -> Result<f64, RunError> {
    loop {
        let before = *renewal;
        match attempt(method, parts, renewal, Some(step_size), outcome) {
            Ok((estimate, next)) => {
                return Ok(step_size.accept(outcome.step, &next, next == estimate));
            }
            Err(obstacle) => {
                let repetition = step_size.repeat(outcome.step, obstacle)?;
                if repetition.has_jumped {
                    method.restart();
                }
                outcome.step = plan.shorten(repetition.length);
                *renewal = before;
                let with_columns = renewal.wants_columns(method, parts, outcome.step);
                let ahead = (outcome.step, with_columns);
                look_ahead(method, parts, ahead, Some(step_size))?;
            }
        }
    }
}

/// Corrects the step as often as it takes, from the answers to the look-ahead over it. Where steps vary its error must be small enough
/// at the first correction: later ones change what the error belongs to, and cost exchanges. Gives that error, and the one that the
/// step would have had with the degrees of the next one.
fn attempt(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    renewal: &mut Renewal,
    step_size: Option<&mut StepSize>,
    outcome: &mut Outcome,
) -> Result<(Estimate, Estimate), Obstacle> {
    let step = outcome.step;
    let mut estimates = (Estimate::NONE, Estimate::NONE);
    let varies = step_size.as_ref().is_some_and(|own| own.varies());
    if let Some(step_size) = step_size {
        step_size.check_answered()?;
        outcome.solving += correct(method, parts, step)?;
        let estimate = method.error_estimate(parts, step, step_size.scales());
        let (purpose, scales) = (step_size.purpose(&estimate), step_size.scales());
        let next = method.choose_degrees(parts, step, scales, &estimate, purpose);
        step_size.check_error(step, &estimate, &next, parts)?;
        estimates = (estimate, next);
    } else {
        outcome.solving += correct(method, parts, step)?;
    }
    renewal.begin(method);
    while let Some(with_columns) = renewal.next_pass() {
        method.request_pass(parts, step, with_columns);
        look(parts, step, varies)?;
        outcome.solving += correct(method, parts, step)?;
        renewal.note_pass(method.last_change(), with_columns);
    }
    renewal.check(parts, step)?;
    Ok(estimates)
}

/// Corrects, and gives the time that it took.
#[tracing::instrument(name = "correction", level = "trace", skip_all)]
fn correct(
    method: &mut dyn Corrector,
    parts: &Parts,
    step: MacroStep,
) -> Result<Duration, RunError> {
    let started = Instant::now();
    method.correct(parts, step)?;
    Ok(started.elapsed())
}

/// A look-ahead from the present macro point over a step, with new columns or without, and no advance before it. Where steps vary the
/// next attempt at the step learns what has become of it.
pub(super) fn look_ahead(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    (step, with_columns): (MacroStep, bool),
    step_size: Option<&mut StepSize>,
) -> Result<(), RunError> {
    parts.forgo_advance();
    let step_size = step_size.filter(|own| own.varies());
    let varies = step_size.is_some();
    let requested = method.request_prediction(parts, step, with_columns);
    let looked = requested.and_then(|()| look(parts, step, varies));
    match (looked, step_size) {
        (Err(error), Some(step_size)) if error.may_vanish_with_a_shorter_step() => {
            step_size.keep_refusal(Some(error));
            Ok(())
        }
        (looked, _) => looked,
    }
}

#[tracing::instrument(name = "look_ahead", level = "trace", skip_all, fields(t = step.start, H = step.length))]
fn look(parts: &mut Parts, step: MacroStep, varies: bool) -> Result<(), RunError> {
    match varies {
        true => recovery::look(&mut parts.subsystems, step),
        false => exchange(&mut parts.subsystems, step),
    }
}
