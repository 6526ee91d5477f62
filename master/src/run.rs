//! A co-simulation: the loop around the macro step, and what is read of it.
//!
//! * [`crate::macro_step`]: one macro step;
//! * [`settings`]: the constants that decide about its steps;
//! * `state`: what a run is at a macro point, as a value;
//! * `outside`: a run whose times somebody else chooses;
//! * [`checkpoint`]: the same together with the states of its workers, from which a run goes on.

pub mod checkpoint;
mod outside;
pub mod settings;
mod state;

use std::time::Instant;

use linchpin_proto::v1::{ExchangeReply, ExchangeRequest};

use crate::error::RunError;
use crate::macro_step::{Run, macro_step};
use crate::policies::step_size::StepSize;
use crate::results::{Guard, Mechanism, OfStep, Row, Statistics, StepDegrees};
use crate::time::MacroStep;
use crate::workers::Subsystem;

/// A running co-simulation.
pub struct CoSimulation {
    /// What takes part in a macro step.
    pub(crate) run: Run,
    pub(crate) row: Row,
    /// For samples inside the last macro step.
    pub(crate) sample_row: Row,
    pub(crate) multipliers: Vec<f64>,
    pub(crate) mechanism: Option<Mechanism>,
    pub(crate) guard: Guard,
    pub(crate) statistics: Statistics,
}

impl CoSimulation {
    /// Runs one macro step, judges it and reads its row; `false` if the end was reached before.
    ///
    /// # Errors
    /// What ends the run.
    pub fn macro_step(&mut self) -> Result<bool, RunError> {
        let Some(first) = self.run.plan.step() else {
            return Ok(false);
        };
        let number = self.run.plan.steps_done() + 1;
        let _span = tracing::debug_span!("macro_step", number, t = first.start).entered();
        let started = Instant::now();
        let outcome = macro_step(&mut self.run, first)?;
        self.read_row(outcome.step);
        self.run.errors.observe(&self.run.workers.now());
        if let Some(step_size) = &mut self.run.step_size {
            step_size.tolerance_mut().observe(&self.run.workers.now());
        }
        self.guard
            .judge(outcome.step, &self.row, &self.run.layout)?;
        let degrees = self.degrees();
        self.statistics
            .count(&outcome, degrees, started.elapsed(), &self.row);
        Ok(true)
    }

    /// Reads the row at the end of `step`.
    pub(crate) fn read_row(&mut self, step: MacroStep) {
        let of_step = self.of_step();
        let outputs = |subsystem: usize| &self.run.workers.subsystems[subsystem].outputs[..];
        let multipliers = self.run.method.multipliers();
        self.row
            .read(step, of_step, &self.run.layout, outputs, multipliers);
    }

    /// What is told of the last macro step.
    fn of_step(&mut self) -> OfStep {
        OfStep {
            degrees: self.degrees(),
            error: self.run.errors.of_last_step(),
        }
    }

    /// Degrees of the polynomials over the last macro step, as far as they follow the estimates.
    pub(crate) fn degrees(&mut self) -> StepDegrees {
        match (&self.run.degrees, self.run.method.corrected()) {
            (Some(degrees), Some(method)) => {
                degrees.of_last_step(|variable| method.degree_of_last_step(variable))
            }
            _ => StepDegrees::default(),
        }
    }

    /// Time of the present macro point.
    pub fn t(&self) -> f64 {
        self.run.plan.t()
    }

    /// Number of attempts at macro steps so far that were repeated with a shorter one.
    pub fn rejected(&self) -> u64 {
        let steps = self.run.step_size.as_ref().and_then(StepSize::statistics);
        steps.map_or(0, |steps| steps.rejected)
    }

    /// Number of macro steps done.
    pub fn steps_done(&self) -> usize {
        self.run.plan.steps_done()
    }

    /// Number of macro steps of the whole run; those done so far if the steps vary.
    pub fn steps_planned(&self) -> usize {
        self.run.plan.steps_planned()
    }

    /// Whether the end is reached.
    pub fn is_finished(&self) -> bool {
        self.run.plan.is_finished()
    }

    /// The subsystems in the order of the scene.
    pub fn subsystems(&self) -> &[Subsystem] {
        &self.run.workers.subsystems
    }

    /// Everything that is recorded of the present macro point.
    pub fn row(&self) -> &Row {
        &self.row
    }

    /// Number of samples inside the last macro step.
    pub fn samples(&self) -> usize {
        let samples = self.run.workers.samples.as_ref();
        samples.map_or(0, |samples| samples.offsets().len())
    }

    /// Number of a sample inside the last macro step, counted from `t_start`, and everything that is recorded of it.
    pub fn sample(&mut self, place: usize) -> Option<(u64, &Row)> {
        let samples = self.run.workers.samples.as_ref()?;
        let length = *samples.offsets().get(place)?;
        let (number, end) = samples.inside(place);
        let sample = MacroStep {
            start: end - length,
            length,
            end,
        };
        let of_step = self.of_step();
        let sampled = self.run.workers.sampled(place);
        self.run
            .method
            .multipliers_at(length, &self.run.layout, &sampled, &mut self.multipliers);
        let outputs = |subsystem: usize| self.run.workers.subsystems[subsystem].sample(place);
        let (row, multipliers) = (&mut self.sample_row, &self.multipliers);
        row.read(sample, of_step, &self.run.layout, outputs, multipliers);
        Some((number, row))
    }

    /// Number of the sample at the present macro point, if one is there.
    pub fn sample_here(&self) -> Option<u64> {
        self.run.workers.samples.as_ref()?.at(self.t())
    }

    /// The markers of all subsystems, if their positions are recorded (`Options::record_markers`).
    pub fn mechanism(&self) -> Option<&Mechanism> {
        self.mechanism.as_ref()
    }

    /// The last request to a subsystem and its answer; `None` if there is no such subsystem.
    pub fn last_messages(&self, subsystem: usize) -> Option<(&ExchangeRequest, &ExchangeReply)> {
        let subsystem = self.run.workers.subsystems.get(subsystem)?;
        Some((&subsystem.request, &subsystem.reply))
    }

    /// Counts, times and residuals so far.
    pub fn statistics(&self) -> Statistics {
        let mut statistics = self.statistics.clone();
        statistics.estimated_errors = self.run.errors.of_run(&self.run.layout);
        if let Some(corrector) = &self.run.corrector {
            statistics.singular_positions = corrector.singular_positions.passages();
        }
        statistics.steps = self.run.step_size.as_ref().and_then(StepSize::statistics);
        for (number, subsystem) in self.run.workers.subsystems.iter().enumerate() {
            let columns = self.run.corrector.as_ref().map(|own| &own.end.columns);
            let unresolved = columns.and_then(|own| own.resolution().unresolved(number));
            statistics.add_subsystem(subsystem.statistics(unresolved));
        }
        statistics
    }
}
