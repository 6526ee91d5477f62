//! Corrections of a step after the first one.

use super::{Hermite, largest_changes};
use crate::coupling::columns::Nodes;
use crate::coupling::corrector::{Again, Missed};
use crate::coupling::measure::Change;
use crate::signal::Curves;
use crate::time::MacroStep;
use crate::workers::Parts;

impl Again for Hermite {
    fn request_pass(&mut self, parts: &mut Parts, step: MacroStep, with_columns: bool) {
        self.promise.remember(&self.end.system, &self.solution);
        self.is_first = false;
        parts.prepare_pass(step);
        parts.forgo_evaluation();
        self.request_look(parts, with_columns);
    }

    fn accept(&mut self) -> bool {
        self.measure.note(&self.changes);
        self.continues
    }

    fn is_blind(&self) -> bool {
        !self.arcs.has_past()
    }

    fn last_change(&self) -> Change {
        self.measure.of(&self.changes, self.sample.ends())
    }

    fn prepare_columns(&mut self, parts: &Parts, step: MacroStep) -> Option<f64> {
        let step = (step.length, Nodes::default());
        self.end.columns.prepare(&parts.layout, step, &self.arcs)
    }

    /// The solution for the conditions at the outputs after the advance, with the matrix of the correction.
    fn learn(&mut self, parts: &Parts, with_new_columns: bool) -> Missed {
        let step = self.before.length();
        self.settled.take(&self.before);
        let outputs = |subsystem: usize| parts.subsystems[subsystem].coupling_values();
        let point = self.settled.point(step, self.before.attitudes());
        let system = &mut self.end.system;
        system.assemble_residuals(&parts.layout, outputs, point);
        self.stack.assemble_end(system, step);
        let remaining = self.stack.rhs();
        self.solver.solve_again(remaining);
        let unknowns = system.unknowns();
        if with_new_columns {
            largest_changes(unknowns, remaining, &mut self.changes);
            self.measure.note_left(&self.changes);
        }
        let (measure, ends) = (&self.measure, self.settled.ends());
        let changes = &mut self.changes;
        let mut size = |change: &[f64]| {
            largest_changes(unknowns, change, changes);
            measure.of(changes, ends).of_usual
        };
        Missed {
            by_last: size(remaining),
            by_first: self.shortfall.learn(remaining, size),
        }
    }
}
