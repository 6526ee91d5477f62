//! One macro step of a predictor/corrector method, one message to each worker.

use std::time::Instant;

use super::{Outcome, Parts, exchange};
use crate::coupling::corrector::Corrector;
use crate::error::RunError;
use crate::time::MacroStep;

/// The macro step `step`, and in the same exchange the look-ahead over the `following` one.
///
/// The prediction over `step`, with its perturbed steps, came with the exchange before.
pub(super) fn macro_step(
    method: &mut dyn Corrector,
    parts: &mut Parts,
    step: MacroStep,
    following: Option<MacroStep>,
) -> Result<Outcome, RunError> {
    let started = Instant::now();
    method.correct(parts, step)?;
    let solving = started.elapsed().as_secs_f64();
    parts.prepare_advance(step);
    method.request_advance(parts, step);
    method.move_on(step);
    match following {
        Some(following) => method.request_prediction(parts, following, true)?,
        None => parts.forgo_prediction(),
    }
    exchange(&mut parts.subsystems, step)?;
    let verdict = method.judge(parts);
    Ok(Outcome { verdict, solving })
}
