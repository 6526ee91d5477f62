//! A run whose times somebody else chooses.

use super::CoSimulation;
use crate::error::RunError;
use crate::macro_step::look_ahead;
use crate::time::ROUNDING;

impl CoSimulation {
    /// Takes macro steps up to `t` (s), which becomes a macro point. Where it is one of those that the run has anyway, all results are those of a run
    /// that nobody interferes with, bit by bit; otherwise the steps before it are shortened, which takes one look-ahead more for each.
    ///
    /// # Errors
    /// What ends a run; [`RunError::BehindTheEnd`] if `t` lies behind the end of the scene.
    pub fn advance_to(&mut self, t: f64) -> Result<(), RunError> {
        while let Some(step) = self.run.plan.step() {
            if t - self.t() <= ROUNDING * step.length {
                return Ok(());
            }
            if let Some(shorter) = self.run.plan.meet(t) {
                look_ahead(&mut self.run, shorter, None)?;
            }
            self.macro_step()?;
        }
        let end = self.t();
        match t - end <= ROUNDING * end.abs().max(self.row.step().length) {
            true => Ok(()),
            false => Err(RunError::BehindTheEnd { t, end }),
        }
    }
}
