//! The semi-implicit predictor/corrector methods of Schweizer & Lu (S1 Sects. 2 and 3.3).

use std::time::Instant;

use super::columns::Column;
use super::condition::{Condition, check_finite};
use super::solve::LinearSolver;
use super::system::{System, motion_of};
use crate::cosimulation::{Outcome, Parts, exchange};
use crate::error::RunError;
use crate::joint::{Level, extent};
use crate::results::{Defect, Verdict};
use crate::scene::Increment;
use crate::signal::{History, combine};
use crate::time::MacroStep;

/// State of a semi-implicit method between two macro steps.
pub struct SemiImplicit {
    condition: Condition,
    increment: Increment,
    history: History,
    predicted: Vec<f64>,
    change: Vec<f64>,
    corrected: Vec<f64>,
    promised: Vec<f64>,
    shift: Vec<f64>,
    columns: Vec<Column>,
    system: System,
    solver: LinearSolver,
}

impl SemiImplicit {
    /// The method with multipliers `history` up to the first macro point.
    pub fn new(
        condition: Condition,
        increment: Increment,
        history: History,
        parts: &Parts,
    ) -> Self {
        let rows = parts.layout.rows.len();
        Self {
            condition,
            increment,
            history,
            predicted: vec![0.0; rows],
            change: vec![0.0; rows],
            corrected: vec![0.0; rows],
            promised: vec![0.0; rows],
            shift: vec![0.0; rows],
            columns: vec![Column::default(); parts.layout.inputs.len()],
            system: System::new(rows, parts.layout.level),
            solver: LinearSolver::new(rows),
        }
    }

    /// Multipliers at the present macro point.
    pub fn multipliers(&self) -> &[f64] {
        self.history.newest()
    }

    /// Looks ahead over the first macro step.
    pub fn begin(&mut self, parts: &mut Parts, first: MacroStep) -> Result<(), RunError> {
        self.request_prediction(parts, first)?;
        exchange(&mut parts.subsystems, first)
    }

    /// One macro step. The prediction over it, with its perturbed steps, came with the exchange before.
    pub fn macro_step(
        &mut self,
        parts: &mut Parts,
        step: MacroStep,
        following: Option<MacroStep>,
    ) -> Result<Outcome, RunError> {
        let started = Instant::now();
        self.correct(parts, step)?;
        let solving = started.elapsed().as_secs_f64();
        self.request_advance(parts, step);
        self.history.push(step.length, &self.corrected);
        match following {
            Some(following) => self.request_prediction(parts, following)?,
            None => parts.forgo_prediction(),
        }
        exchange(&mut parts.subsystems, step)?;
        let verdict = self.judge(parts);
        Ok(Outcome { verdict, solving })
    }

    /// S1 eqs. (62) to (68), (73) to (76): columns, Jacobian, corrected multipliers at `T_{N+1}`.
    fn correct(&mut self, parts: &Parts, step: MacroStep) -> Result<(), RunError> {
        self.system.assemble(parts, &mut self.columns);
        self.condition
            .solve(&mut self.system, &mut self.solver, &mut self.change)
            .map_err(|singular| singular.in_step(parts, step))?;
        for (row, corrected) in self.corrected.iter_mut().enumerate() {
            *corrected = self.predicted[row] + self.change[row];
        }
        check_finite(&self.corrected, parts, step)
    }

    /// S1 eq. (69): the interpolation through the corrected end value.
    fn request_advance(&mut self, parts: &mut Parts, step: MacroStep) {
        parts.prepare_advance(step);
        for input in &parts.layout.inputs {
            let subsystem = &mut parts.subsystems[input.subsystem];
            let signal = subsystem.advance_signal(input.place);
            let end = combine(&input.combination, &self.corrected);
            self.history
                .interpolate(&input.combination, step.length, end, signal);
        }
    }

    /// S1 eqs. (56), (59): the extrapolation, and for every input the interpolation through its raised end value.
    fn request_prediction(&mut self, parts: &mut Parts, step: MacroStep) -> Result<(), RunError> {
        for (row, predicted) in self.predicted.iter_mut().enumerate() {
            *predicted = self.history.extrapolated_value(row, step.length);
        }
        check_finite(&self.predicted, parts, step)?;
        parts.prepare_prediction(step.start, step.length);
        for (input, column) in parts.layout.inputs.iter().zip(&mut self.columns) {
            let subsystem = &mut parts.subsystems[input.subsystem];
            let end = combine(&input.combination, &self.predicted);
            column.choose_increment(self.increment, end, subsystem.tolerance);
            let (signal, raised) = subsystem.prediction_signals(input.place);
            self.history.extrapolate(&input.combination, signal);
            let end = end + column.increment;
            self.history
                .interpolate(&input.combination, step.length, end, raised);
        }
        Ok(())
    }

    /// Compares the position conditions at the corrected outputs with what their linearisation promised.
    fn judge(&mut self, parts: &Parts) -> Verdict {
        self.promised
            .copy_from_slice(self.system.residual(Level::Position));
        self.system
            .shift(Level::Position, &self.change, &mut self.shift);
        let corrected = |subsystem: usize| parts.subsystems[subsystem].coupling_values();
        self.system.assemble_residuals(&parts.layout, corrected);
        let mut defect = Defect::default();
        for (row, found) in self.system.residual(Level::Position).iter().enumerate() {
            let motion = motion_of(&parts.layout, parts.layout.rows[row].joint, corrected);
            let extent = extent(&motion, Level::Position);
            defect.add(self.promised[row], self.shift[row], *found, extent);
        }
        defect.verdict()
    }
}
