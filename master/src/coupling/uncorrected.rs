//! What a method without a corrector does in a macro step; in which order is told by the co-simulation.

use std::time::Duration;

use crate::error::RunError;
use crate::time::MacroStep;
use crate::workers::Parts;

/// A method that takes a macro step with extrapolated coupling variables.
///
/// It stands at the present macro point `T_N`, from where it advances; [`Uncorrected::move_on`] takes it to `T_{N+1}`.
pub(crate) trait Uncorrected: Send {
    /// Multipliers at the present macro point.
    fn multipliers(&self) -> &[f64];

    /// Lets all workers advance over `step` and finds the coupling variables at its end. The time that was spent on solving for
    /// them.
    fn advance(&mut self, parts: &mut Parts, step: MacroStep) -> Result<Duration, RunError>;

    /// Moves on to the end of `step`.
    fn move_on(&mut self, step: MacroStep);

    /// Writes the multipliers at sample number `sample` inside the last step that was taken.
    fn multipliers_at(&self, parts: &Parts, sample: usize, multipliers: &mut [f64]);
}
