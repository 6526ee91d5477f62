//! One macro step of a method without a corrector.

use crate::coupling::uncorrected::Uncorrected;
use crate::error::RunError;
use crate::results::Outcome;
use crate::time::{MacroStep, TimePlan};
use crate::workers::Parts;

/// The present macro step of `plan`.
pub(super) fn macro_step(
    method: &mut dyn Uncorrected,
    parts: &mut Parts,
    plan: &mut TimePlan,
    step: MacroStep,
) -> Result<Outcome, RunError> {
    let outcome = Outcome::of_step(step, method.advance(parts, step)?);
    method.move_on(step);
    plan.move_on(plan.following(step.length));
    Ok(outcome)
}
