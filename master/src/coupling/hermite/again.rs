//! Corrections of a step after the first one.

use super::{Hermite, largest_changes};
use crate::cosimulation::Parts;
use crate::coupling::corrector::Again;
use crate::coupling::measure::Change;
use crate::signal::Curves;
use crate::time::MacroStep;

impl Again for Hermite {
    fn request_pass(&mut self, parts: &mut Parts, step: MacroStep, with_columns: bool) {
        self.promise.remember(&self.end.system, &self.change);
        self.is_first = false;
        parts.prepare_pass(step);
        parts.forgo_evaluation();
        self.request_look(parts, step, with_columns);
    }

    fn last_change(&self) -> Change {
        self.measure.of(&self.changes, self.sample.ends())
    }

    fn has_columns(&self, step: MacroStep) -> bool {
        self.columns_of == step.length
    }

    /// The solution for the conditions at the outputs after the advance, with the matrix of the correction.
    fn remainder(&mut self, parts: &Parts) -> f64 {
        let step = self.before.length();
        self.settled.take(&self.before);
        let outputs = |subsystem: usize| parts.subsystems[subsystem].coupling_values();
        let point = self.settled.point(step, self.before.attitudes());
        let system = &mut self.end.system;
        system.assemble_residuals(&parts.layout, outputs, point);
        system.drop_rounding(&parts.layout, point);
        self.stack.assemble_end(system, step);
        let remaining = self.stack.rhs();
        self.solver.solve_again(remaining);
        largest_changes(system.unknowns(), remaining, &mut self.changes);
        self.measure.of(&self.changes, self.settled.ends()).of_usual
    }
}
