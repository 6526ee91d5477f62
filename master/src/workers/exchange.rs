//! The exchange of a macro step.

use super::all::Workers;
use super::subsystem::Subsystem;
use crate::error::RunError;
use crate::time::MacroStep;

impl Workers {
    /// Sends every subsystem its request, then takes all answers: the workers compute at the same time.
    pub(crate) fn exchange(&mut self, step: MacroStep) -> Result<(), RunError> {
        exchange(&mut self.subsystems, step)
    }

    /// The same with one subsystem alone.
    pub(crate) fn exchange_with(&mut self, number: usize, step: MacroStep) -> Result<(), RunError> {
        exchange(&mut self.subsystems[number..=number], step)
    }
}

#[tracing::instrument(level = "trace", skip_all)]
fn exchange(subsystems: &mut [Subsystem], step: MacroStep) -> Result<(), RunError> {
    for subsystem in &mut *subsystems {
        subsystem.post(step)?;
    }
    for subsystem in subsystems {
        subsystem.collect(step)?;
    }
    Ok(())
}
