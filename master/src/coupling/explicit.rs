//! The explicit index-1 method of Gu & Asada (S1 ref. 16 and Sect. 4.1.3), for comparison.

use std::time::Instant;

use super::columns::Column;
use super::condition::{Condition, check_finite};
use super::solve::LinearSolver;
use super::system::System;
use crate::cosimulation::{Outcome, Parts, exchange};
use crate::error::RunError;
use crate::results::Verdict;
use crate::scene::Increment;
use crate::signal::combine;
use crate::time::MacroStep;

/// `(mu d/dt + 1)^2 g = g + 2 mu g' + mu^2 g'' = 0` at `T_N` gives the multipliers, which are held over the step to
/// `T_{N+1}`. `g''` depends on the multipliers at once, so a look-ahead of zero length suffices and no step is repeated.
pub struct Explicit {
    condition: Condition,
    increment: Increment,
    multipliers: Vec<f64>,
    change: Vec<f64>,
    columns: Vec<Column>,
    system: System,
    solver: LinearSolver,
}

impl Explicit {
    /// The method with time constant `mu` (s), from trial multipliers.
    pub fn new(mu: f64, increment: Increment, multipliers: Vec<f64>, parts: &Parts) -> Self {
        let rows = parts.layout.rows.len();
        Self {
            condition: Condition::Baumgarte {
                beta: 2.0 * mu,
                gamma: mu * mu,
            },
            increment,
            multipliers,
            change: vec![0.0; rows],
            columns: vec![Column::default(); parts.layout.inputs.len()],
            system: System::new(rows, parts.layout.level),
            solver: LinearSolver::new(rows),
        }
    }

    /// Multipliers at the present macro point.
    pub fn multipliers(&self) -> &[f64] {
        &self.multipliers
    }

    /// Evaluates the first macro point and solves for its multipliers.
    pub fn begin(&mut self, parts: &mut Parts, first: MacroStep) -> Result<(), RunError> {
        self.request_evaluation(parts, first.start);
        exchange(&mut parts.subsystems, first)?;
        self.solve(parts, first)
    }

    /// One macro step: advance with the multipliers of its start, evaluate its end, solve there.
    pub fn macro_step(&mut self, parts: &mut Parts, step: MacroStep) -> Result<Outcome, RunError> {
        parts.prepare_advance(step);
        for input in &parts.layout.inputs {
            let held = combine(&input.combination, &self.multipliers);
            parts.subsystems[input.subsystem]
                .advance_signal(input.place)
                .set_constant(held);
        }
        self.request_evaluation(parts, step.end);
        exchange(&mut parts.subsystems, step)?;
        let started = Instant::now();
        self.solve(parts, step)?;
        let solving = started.elapsed().as_secs_f64();
        Ok(Outcome {
            verdict: Verdict::Uncorrected,
            solving,
        })
    }

    fn request_evaluation(&mut self, parts: &mut Parts, t: f64) {
        parts.prepare_prediction(t, 0.0);
        for (input, column) in parts.layout.inputs.iter().zip(&mut self.columns) {
            let subsystem = &mut parts.subsystems[input.subsystem];
            let trial = combine(&input.combination, &self.multipliers);
            column.choose_increment(self.increment, trial, subsystem.tolerance);
            let (signal, raised) = subsystem.prediction_signals(input.place);
            signal.set_constant(trial);
            raised.set_constant(trial + column.increment);
        }
    }

    fn solve(&mut self, parts: &Parts, step: MacroStep) -> Result<(), RunError> {
        self.system.assemble(parts, &mut self.columns);
        self.condition
            .solve(&mut self.system, &mut self.solver, &mut self.change)
            .map_err(|singular| singular.in_step(parts, step))?;
        for (multiplier, change) in self.multipliers.iter_mut().zip(&self.change) {
            *multiplier += change;
        }
        check_finite(&self.multipliers, parts, step)
    }
}
