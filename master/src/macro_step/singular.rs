//! Singular positions that a step ends or begins near.

use super::correcting::Correcting;
use crate::accuracy::SingularPosition;
use crate::policies::singular_positions::Approach;
use crate::time::MacroStep;

impl Correcting<'_> {
    /// The singular position that the step which was corrected last ends near, or begins near. The equations of a step with an impact say nothing
    /// of positions.
    pub fn singular_position(&self) -> Option<SingularPosition> {
        let own = &self.own.singular_positions;
        match self.meets_impacts() {
            true => None,
            false => own.nearby(self.method.least_pivot()),
        }
    }

    /// Takes note of where the step ends, which is taken: what follows for the next one. `is_unsolved`: its error is larger than allowed.
    pub fn note_position(
        &mut self,
        step: MacroStep,
        has_impact: bool,
        is_unsolved: bool,
    ) -> Approach {
        let least_pivot = self.method.least_pivot();
        let own = &mut self.own.singular_positions;
        if is_unsolved {
            own.take_unsolved();
        }
        match has_impact {
            true => own.restart(),
            false => own.accept(step, least_pivot),
        }
    }
}
