//! Exchanges where macro steps vary: a failure that a shorter step may cure does not end the run.
//!
//! A request that fails leaves its worker as it was (contract). So a look-ahead is simply repeated; and where the look-ahead beside an
//! advance fails, the workers that refused are asked for the advance alone, and where they refuse that as well for its pieces: then all of them stand
//! at the same macro point again.

use super::all::Workers;
use super::substeps::{advance_in_substeps, is_refusal};
use super::subsystem::Subsystem;
use super::subsystem::answer::Answered;
use crate::error::RunError;
use crate::time::MacroStep;

impl Workers {
    /// A look-ahead of all subsystems, after which a shorter one may follow.
    pub(crate) fn try_look(&mut self, step: MacroStep) -> Result<(), RunError> {
        let mut all: Vec<_> = self.subsystems.iter_mut().collect();
        look(&mut all, step)
    }

    /// The advance of all subsystems over `step` and their look-ahead over the following one, which may come to nothing: then gives why.
    pub(crate) fn try_advance(&mut self, step: MacroStep) -> Result<Option<RunError>, RunError> {
        advance(&mut self.subsystems, step)
    }
}

/// A look-ahead of these subsystems, without an advance. All answers are taken, so that the next request may follow whatever came; a
/// failure that a shorter step does not cure is told before others.
#[tracing::instrument(name = "exchange", level = "trace", skip_all)]
pub(super) fn look(subsystems: &mut [&mut Subsystem], step: MacroStep) -> Result<(), RunError> {
    for subsystem in &mut *subsystems {
        subsystem.post(step)?;
    }
    let mut refusal = None;
    for subsystem in subsystems {
        if let Err(error) = subsystem.collect(step) {
            if !error.may_vanish_with_a_shorter_step() {
                return Err(error);
            }
            refusal.get_or_insert(error);
        }
    }
    refusal.map_or(Ok(()), Err)
}

/// The advance of all subsystems over `step`, and the look-ahead over the following one: gives what came between, if that was the
/// look-ahead alone.
#[tracing::instrument(name = "exchange", level = "trace", skip_all)]
fn advance(subsystems: &mut [Subsystem], step: MacroStep) -> Result<Option<RunError>, RunError> {
    for subsystem in &mut *subsystems {
        subsystem.post(step)?;
    }
    let mut refusal = None;
    let mut left_behind = Vec::new();
    for (number, subsystem) in subsystems.iter_mut().enumerate() {
        match subsystem.collect_advance(step)? {
            Answered::Whole => {}
            Answered::Advanced(error) => {
                refusal.get_or_insert(error);
            }
            Answered::Refused(error) => {
                refusal.get_or_insert(error);
                left_behind.push(number);
            }
        }
    }
    for &number in &left_behind {
        subsystems[number].request.predict = None;
        subsystems[number].post(step)?;
    }
    let mut refused_again = Vec::new();
    for &number in &left_behind {
        match subsystems[number].collect(step) {
            Err(error) if is_refusal(&error) => refused_again.push(number),
            collected => collected?,
        }
    }
    for number in refused_again {
        advance_in_substeps(&mut subsystems[number], step)?;
    }
    Ok(refusal)
}
