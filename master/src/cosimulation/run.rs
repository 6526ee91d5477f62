//! A running co-simulation: the macro step, told by one function.

use std::time::Instant;

use linchpin_proto::v1::{ExchangeReply, ExchangeRequest};

use super::mechanism::Mechanism;
use super::renewal::Renewal;
use super::scheme::Scheme;
use super::step_size::StepSize;
use super::{corrected, uncorrected};
use crate::error::RunError;
use crate::results::{Guard, Row, Statistics};
use crate::time::{MacroStep, TimePlan};
use crate::workers::{Parts, Subsystem};

/// A running co-simulation.
pub struct CoSimulation {
    pub(super) parts: Parts,
    pub(super) scheme: Scheme,
    pub(super) renewal: Renewal,
    pub(super) plan: TimePlan,
    /// Present if the macro step or the degrees follow the error.
    pub(super) step_size: Option<StepSize>,
    pub(super) row: Row,
    /// For samples inside the last macro step.
    pub(super) sample_row: Row,
    pub(super) multipliers: Vec<f64>,
    pub(super) last_length: f64,
    pub(super) mechanism: Option<Mechanism>,
    pub(super) guard: Guard,
    pub(super) statistics: Statistics,
}

impl CoSimulation {
    /// Runs one macro step; `false` if the end was reached before.
    ///
    /// A method with a corrector corrects the multipliers, lets all workers advance and look ahead in one exchange; one without lets
    /// them advance. Then the step is judged and its row is there to be recorded.
    pub fn macro_step(&mut self) -> Result<bool, RunError> {
        let Some(step) = self.plan.step() else {
            return Ok(false);
        };
        let _span = tracing::debug_span!(
            "macro_step",
            number = self.plan.steps_done() + 1,
            t = step.start
        )
        .entered();
        let started = Instant::now();
        let (parts, plan) = (&mut self.parts, &mut self.plan);
        let step_size = self.step_size.as_mut();
        let outcome = match &mut self.scheme {
            Scheme::Corrected(method) => corrected::macro_step(
                &mut **method,
                parts,
                &mut self.renewal,
                plan,
                step,
                step_size,
            )?,
            Scheme::Uncorrected(method) => {
                uncorrected::macro_step(&mut **method, parts, plan, step)?
            }
        };
        let step = outcome.step;
        self.last_length = step.length;
        let degrees = self.scheme.degrees();
        let multipliers = self.scheme.multipliers();
        let outputs = |subsystem: usize| &self.parts.subsystems[subsystem].outputs[..];
        self.row
            .read(step, degrees, &self.parts.layout, outputs, multipliers);
        if let Some(step_size) = &mut self.step_size {
            step_size.observe(&self.parts);
        }
        self.guard.judge(step, &self.row, &self.parts.layout)?;
        self.statistics
            .count(&outcome, degrees, started.elapsed(), &self.row);
        Ok(true)
    }

    /// Time of the present macro point.
    pub fn t(&self) -> f64 {
        self.plan.t()
    }

    /// Number of macro steps done.
    pub fn steps_done(&self) -> usize {
        self.plan.steps_done()
    }

    /// Number of macro steps of the whole run; those done so far if the steps vary.
    pub fn steps_planned(&self) -> usize {
        self.plan.steps_planned()
    }

    /// Whether the end is reached.
    pub fn is_finished(&self) -> bool {
        self.plan.is_finished()
    }

    /// The subsystems in the order of the scene.
    pub fn subsystems(&self) -> &[Subsystem] {
        &self.parts.subsystems
    }

    /// Everything that is recorded of the present macro point.
    pub fn row(&self) -> &Row {
        &self.row
    }

    /// Number of samples inside the last macro step.
    pub fn samples(&self) -> usize {
        let samples = self.parts.samples.as_ref();
        samples.map_or(0, |samples| samples.offsets().len())
    }

    /// Number of a sample inside the last macro step, counted from `t_start`, and everything that is recorded of it.
    pub fn sample(&mut self, place: usize) -> Option<(u64, &Row)> {
        let samples = self.parts.samples.as_ref()?;
        let length = *samples.offsets().get(place)?;
        let (number, end) = samples.inside(place);
        let sample = MacroStep {
            start: end - length,
            length,
            end,
        };
        let multipliers = &mut self.multipliers;
        match &self.scheme {
            Scheme::Corrected(method) => {
                method.multipliers_at(length, self.last_length, multipliers);
            }
            Scheme::Uncorrected(method) => method.multipliers_at(&self.parts, place, multipliers),
        }
        let degrees = self.scheme.degrees();
        let (parts, row) = (&self.parts, &mut self.sample_row);
        let outputs = |subsystem: usize| parts.subsystems[subsystem].sample(place);
        row.read(sample, degrees, &parts.layout, outputs, &self.multipliers);
        Some((number, &self.sample_row))
    }

    /// Number of the sample at the present macro point, if one is there.
    pub fn sample_here(&self) -> Option<u64> {
        self.parts.samples.as_ref()?.at(self.t())
    }

    /// The markers of all subsystems, if their positions are recorded ([`super::Options::record_markers`]).
    pub fn mechanism(&self) -> Option<&Mechanism> {
        self.mechanism.as_ref()
    }

    /// The last request to a subsystem and its answer; `None` if there is no such subsystem.
    pub fn last_messages(&self, subsystem: usize) -> Option<(&ExchangeRequest, &ExchangeReply)> {
        let subsystem = self.parts.subsystems.get(subsystem)?;
        Some((&subsystem.request, &subsystem.reply))
    }

    /// Counts, times and residuals so far.
    pub fn statistics(&self) -> Statistics {
        let mut statistics = self.statistics.clone();
        statistics.steps = self.step_size.as_ref().and_then(StepSize::statistics);
        for (number, subsystem) in self.parts.subsystems.iter().enumerate() {
            let unresolved = self.scheme.unresolved(number);
            statistics.add_subsystem(subsystem.statistics(unresolved));
        }
        statistics
    }
}
