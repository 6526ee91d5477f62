//! A run from start to end: the macro step, told by one function.

mod closed;
mod contacts;
mod corrected;
mod degrees;
mod geometry;
mod initial;
mod mechanism;
mod obstacle;
mod panels;
mod penalty;
mod pieces;
mod recovery;
mod refusal;
mod renewal;
mod samples;
mod signal_loop;
mod start;
mod step_size;
mod subsystem;
mod tie;
mod uncorrected;
mod velocities;

use std::time::{Duration, Instant};

use linchpin_proto::v1::{self, ExchangeReply, ExchangeRequest};

pub use contacts::RecordedContact;
pub use mechanism::{Mechanism, RecordedJoint, RecordedMarker};
pub use subsystem::{Ahead, Subsystem};
pub use tie::multiplier_columns;
pub use velocities::FreeVelocity;

pub use crate::coupling::automatic_degrees::StepDegrees;
use crate::coupling::corrector::Corrector;
use crate::coupling::layout::Layout;
use crate::coupling::uncorrected::Uncorrected;
use crate::error::RunError;
use crate::results::{Cause, Guard, Row, Statistics, Verdict};
use crate::scene::Scene;
use crate::time::{MacroStep, TimePlan};

use refusal::refuse_setup;
pub use renewal::Passes;
use renewal::Renewal;
use samples::Samples;
pub use start::{Connect, Options, describe};
use step_size::StepSize;
pub(crate) use subsystem::exchange;
use uncorrected::Ceiling;

/// A running co-simulation.
pub struct CoSimulation {
    parts: Parts,
    scheme: Scheme,
    renewal: Renewal,
    plan: TimePlan,
    /// Present if the macro step or the degrees follow the error.
    step_size: Option<StepSize>,
    ceiling: Ceiling,
    row: Row,
    /// For samples inside the last macro step.
    sample_row: Row,
    multipliers: Vec<f64>,
    last_length: f64,
    mechanism: Option<Mechanism>,
    guard: Guard,
    statistics: Statistics,
}

/// What the coupling methods work on.
pub struct Parts {
    /// Subsystems in the order of the scene.
    pub(crate) subsystems: Vec<Subsystem>,
    /// Joints tied to inputs and outputs.
    pub(crate) layout: Layout,
    /// Present if results are wanted at fixed times.
    pub(crate) samples: Option<Samples>,
}

/// The coupling method with its state.
pub(crate) enum Scheme {
    Corrected(Box<dyn Corrector>),
    Uncorrected(Box<dyn Uncorrected>),
}

/// What a method reports of a macro step.
pub struct Outcome {
    /// The step that was accepted.
    pub step: MacroStep,
    /// Verdict on it.
    pub verdict: Verdict,
    /// Time that was spent on solving for the multipliers.
    pub solving: Duration,
    /// How the corrections went.
    pub passes: Passes,
}

impl Outcome {
    /// Of a step that no corrector has judged.
    pub(crate) fn of_step(step: MacroStep, solving: Duration) -> Self {
        Self {
            step,
            verdict: Verdict::Uncorrected,
            solving,
            passes: Passes::default(),
        }
    }
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
                let steps = step_size.map(|steps| (steps, &mut self.ceiling));
                uncorrected::macro_step(&mut **method, parts, plan, step, steps)?
            }
        };
        let step = outcome.step;
        self.last_length = step.length;
        let degrees = self.scheme.degrees();
        let multipliers = self.scheme.multipliers();
        self.row.read(step, degrees, &self.parts, multipliers);
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
        self.sample_row
            .read_sample(sample, degrees, place, &self.parts, &self.multipliers);
        Some((number, &self.sample_row))
    }

    /// Number of the sample at the present macro point, if one is there.
    pub fn sample_here(&self) -> Option<u64> {
        self.parts.samples.as_ref()?.at(self.t())
    }

    /// The markers of all subsystems, if their positions are recorded ([`Options::record_markers`]).
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
            statistics.add_subsystem(subsystem, self.scheme.unresolved(number));
        }
        statistics
    }
}

impl Parts {
    /// Starts the instance of a subsystem anew.
    fn restart(
        &mut self,
        scene: &Scene,
        number: usize,
        models: &[v1::Model],
        request: &v1::InitializeRequest,
    ) -> Result<(), RunError> {
        let subsystem = &mut self.subsystems[number];
        let restarted = subsystem.restart(request.clone());
        let refuse = |error| refuse_setup(scene, number, &models[number], subsystem, error);
        restarted.map_err(refuse)
    }

    /// Makes every subsystem's next request advance over `step`; the signals are filled in by the method.
    pub(crate) fn prepare_advance(&mut self, step: MacroStep) {
        for (number, subsystem) in self.subsystems.iter_mut().enumerate() {
            let advance = subsystem.advance_to_fill();
            advance.t = step.start;
            advance.step = step.length;
            let inputs = self.layout.inputs_of(number).len();
            advance.signals.resize_with(inputs, Default::default);
        }
        self.request_samples(step);
    }

    /// Makes every subsystem's next request take its last advance back, before anything else.
    pub(crate) fn go_back(&mut self) {
        for subsystem in &mut self.subsystems {
            subsystem.request.go_back = true;
        }
    }

    /// Makes every subsystem's next request look ahead from `t` over `length`, which may be 0; subsystems whose outputs nobody
    /// reads have nothing to tell. The signals are filled in by the method.
    pub(crate) fn prepare_prediction(&mut self, t: f64, length: f64) {
        self.prepare_look(Ahead::Step, t, length);
        for subsystem in &mut self.subsystems {
            subsystem.looks_ahead_for = Cause::Predictor;
        }
    }

    /// Makes every subsystem's next request evaluate its outputs at `t`, beside a prediction.
    pub(crate) fn prepare_evaluation(&mut self, t: f64) {
        self.prepare_look(Ahead::Now, t, 0.0);
    }

    fn prepare_look(&mut self, ahead: Ahead, t: f64, length: f64) {
        for (number, subsystem) in self.subsystems.iter_mut().enumerate() {
            if !subsystem.is_read() {
                continue;
            }
            let look = subsystem.look(ahead);
            look.t = t;
            look.step = length;
            let inputs = self.layout.inputs_of(number).len();
            look.signals.resize_with(inputs, Default::default);
        }
    }

    /// Makes no subsystem evaluate its outputs beside a prediction.
    pub(crate) fn forgo_evaluation(&mut self) {
        for subsystem in &mut self.subsystems {
            subsystem.request.evaluate = None;
        }
    }

    /// Makes every subsystem's next request look ahead over `step` once more, and do nothing else.
    pub(crate) fn prepare_pass(&mut self, step: MacroStep) {
        self.forgo_advance();
        self.prepare_prediction(step.start, step.length);
        for subsystem in &mut self.subsystems {
            subsystem.looks_ahead_for = Cause::Pass;
        }
    }

    /// Makes no subsystem advance.
    pub(crate) fn forgo_advance(&mut self) {
        for subsystem in &mut self.subsystems {
            subsystem.forgo_advance();
        }
    }

    /// Makes no subsystem look ahead.
    pub(crate) fn forgo_prediction(&mut self) {
        self.forgo_evaluation();
        for subsystem in &mut self.subsystems {
            subsystem.request.predict = None;
        }
    }
}

impl Scheme {
    /// Multipliers at the present macro point.
    pub(crate) fn multipliers(&self) -> &[f64] {
        match self {
            Self::Corrected(method) => method.multipliers(),
            Self::Uncorrected(method) => method.multipliers(),
        }
    }

    /// By what factor the responses of a subsystem to loads differed most from those of inertia, if no macro step resolves that.
    fn unresolved(&self, subsystem: usize) -> Option<f64> {
        match self {
            Self::Corrected(method) => method.resolution().unresolved(subsystem),
            Self::Uncorrected(_) => None,
        }
    }

    /// Degrees of the polynomials over the last macro step, as far as they follow the estimates.
    pub(crate) fn degrees(&self) -> StepDegrees {
        match self {
            Self::Corrected(method) => method.degrees(),
            Self::Uncorrected(_) => StepDegrees::default(),
        }
    }
}

/// The step before the first one: for messages about the start.
pub(crate) fn at_start(t: f64) -> MacroStep {
    MacroStep {
        start: t,
        length: 0.0,
        end: t,
    }
}
