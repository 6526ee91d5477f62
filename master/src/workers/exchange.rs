//! The exchange of a macro step.

use super::subsystem::Subsystem;
use crate::error::RunError;
use crate::time::MacroStep;

/// Sends every subsystem its request, then takes all answers: the workers compute at the same time.
#[tracing::instrument(level = "trace", skip_all)]
pub(crate) fn exchange(subsystems: &mut [Subsystem], step: MacroStep) -> Result<(), RunError> {
    for subsystem in &mut *subsystems {
        subsystem.post(step)?;
    }
    for subsystem in subsystems {
        subsystem.collect(step)?;
    }
    Ok(())
}
