//! One macro step of a predictor/corrector method, one message to each worker unless it is corrected more than once.

use std::time::Instant;

use super::renewal::Renewal;
use super::{Outcome, Parts, exchange};
use crate::coupling::corrector::Corrector;
use crate::coupling::measure::Change;
use crate::error::RunError;
use crate::time::MacroStep;

/// The macro step `step`, and in the same exchange as its advance the look-ahead over the `following` one.
///
/// The prediction over `step`, with its perturbed steps, came with the exchange before.
pub(super) fn macro_step(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    renewal: &mut Renewal,
    step: MacroStep,
    following: Option<MacroStep>,
) -> Result<Outcome, RunError> {
    let mut solving = correct(method, parts, step)?;
    renewal.begin(last_change(method));
    while let Some(with_columns) = renewal.next_pass() {
        let Some(again) = method.again() else { break };
        again.request_pass(parts, step, with_columns);
        exchange(&mut parts.subsystems, step)?;
        solving += correct(method, parts, step)?;
        renewal.note_pass(last_change(method), with_columns);
    }
    renewal.refuse(parts, step)?;
    parts.prepare_advance(step);
    method.request_advance(parts, step);
    method.move_on(step);
    match following {
        Some(following) => {
            let with_columns = renewal.wants_columns(method, following);
            method.request_prediction(parts, following, with_columns)?;
        }
        None => parts.forgo_prediction(),
    }
    exchange(&mut parts.subsystems, step)?;
    let verdict = method.judge(parts);
    let passes = renewal.finish(method, parts);
    Ok(Outcome {
        verdict,
        solving,
        passes,
    })
}

fn last_change(method: &mut dyn Corrector) -> Change {
    let again = method.again();
    again.map_or_else(Change::default, |again| again.last_change())
}

/// Corrects, and gives the time in s that it took.
fn correct(method: &mut dyn Corrector, parts: &Parts, step: MacroStep) -> Result<f64, RunError> {
    let started = Instant::now();
    method.correct(parts, step)?;
    Ok(started.elapsed().as_secs_f64())
}
