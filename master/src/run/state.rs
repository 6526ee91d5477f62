//! What a run is at a macro point, as one value that can be written and read back.

use serde::{Deserialize, Serialize};

use linchpin_proto::v1;
use prost::Message;

use super::CoSimulation;
use crate::accuracy::{step_errors, tolerance};
use crate::error::RunError;
use crate::macro_step::{Corrector, CorrectorState, PointJacobian, look_ahead};
use crate::methods::Saved;
use crate::policies::degree::{self, AutomaticDegrees};
use crate::policies::{columns, iteration, step_size};
use crate::results::{Guard, Integrations, Recoveries, Statistics};
use crate::time::{MacroStep, TimePlan};

/// All that a run knows at a macro point, but for the states of the solvers, which are their workers', and for what its scene and the
/// workers' descriptions say. Any serde format keeps it that keeps all bits of numbers, also of infinite ones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct RunState {
    /// What the run couples and records: names of the coupling variables, then of the result columns.
    names: Vec<String>,
    plan: TimePlan,
    /// The last macro step, which ends at the macro point.
    last: MacroStep,
    method: Saved,
    corrector: Option<CorrectorState>,
    /// Columns of conditions at macro points, and whether new ones are wanted.
    point: Option<(columns::State, bool)>,
    iteration: iteration::State,
    step_size: Option<(step_size::State, tolerance::State)>,
    degrees: Option<degree::State>,
    errors: step_errors::State,
    guard: Guard,
    statistics: Statistics,
    workers: Vec<WorkerState>,
}

/// What the master knows of one worker.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct WorkerState {
    /// Outputs at the macro point.
    outputs: Vec<f64>,
    exchanges: u64,
    recoveries: Recoveries,
    asked: Integrations,
    /// What it reported so far, in the encoding of the contract.
    work: Vec<u8>,
}

impl CoSimulation {
    /// The run at the present macro point.
    pub(super) fn state(&self) -> RunState {
        let workers = self.run.workers.subsystems.iter().map(|own| WorkerState {
            outputs: own.outputs.clone(),
            exchanges: own.exchanges,
            recoveries: own.recoveries(),
            asked: own.asked,
            work: own.work.encode_to_vec(),
        });
        RunState {
            names: self.names(),
            plan: self.run.plan.clone(),
            last: self.row.step(),
            method: self.run.method.state(),
            corrector: self.run.corrector.as_ref().map(Corrector::state),
            point: self.run.point.as_ref().map(PointJacobian::state),
            iteration: self.run.iteration.state(),
            step_size: self
                .run
                .step_size
                .as_ref()
                .map(|own| (own.state(), own.tolerance().state())),
            degrees: self.run.degrees.as_ref().map(AutomaticDegrees::state),
            errors: self.run.errors.state(),
            guard: self.guard.clone(),
            statistics: self.statistics.clone(),
            workers: workers.collect(),
        }
    }

    /// Names of the coupling variables, then of the result columns.
    fn names(&self) -> Vec<String> {
        let layout = &self.run.layout;
        let variables = (0..layout.variables()).map(|variable| layout.variable_name(variable));
        variables
            .chain(self.row.columns().iter().cloned())
            .collect()
    }

    /// That a state is one of this run.
    ///
    /// # Errors
    /// It belongs to another scene or another method.
    pub(super) fn check(&self, state: &RunState) -> Result<(), RunError> {
        self.run.method.state().compare(&state.method)?;
        let names = self.names();
        match state.names == names {
            true => Ok(()),
            false => Err(RunError::OtherRun(first_difference(&state.names, &names))),
        }
    }

    /// Goes on from `state` in place of the start of the scene. The workers stand at the macro point of that state. The look-ahead over
    /// the next macro step is asked for anew, in an exchange of its own.
    pub(super) fn go_on(&mut self, state: RunState) -> Result<(), RunError> {
        let works = state
            .workers
            .iter()
            .map(|own| v1::Work::decode(&own.work[..]));
        let works: Vec<v1::Work> = works.collect::<Result<_, _>>().map_err(|error| {
            RunError::OtherRun(format!(
                "what its workers have done cannot be read: {error}"
            ))
        })?;
        self.run.method.resume(&state.method)?;
        let subsystems = self.run.workers.subsystems.iter_mut();
        for (subsystem, (state, work)) in subsystems.zip(state.workers.into_iter().zip(works)) {
            subsystem.outputs = state.outputs;
            subsystem.exchanges = state.exchanges;
            subsystem.asked = state.asked;
            subsystem.go_on(work, state.recoveries);
        }
        self.run.plan = state.plan;
        if let (Some(own), Some(state)) = (&mut self.run.corrector, state.corrector) {
            own.resume(state);
        }
        if let (Some(point), Some(state)) = (&mut self.run.point, state.point) {
            point.resume(state);
        }
        self.run.iteration.resume(state.iteration);
        if let (Some(own), Some((state, tolerance))) = (&mut self.run.step_size, state.step_size) {
            own.resume(state);
            own.tolerance_mut().resume(tolerance);
        }
        if let (Some(own), Some(state)) = (&mut self.run.degrees, state.degrees) {
            own.resume(state);
        }
        self.run.errors.resume(state.errors);
        self.guard = state.guard;
        self.statistics = state.statistics;
        self.read_row(state.last);
        match self.run.plan.step() {
            Some(step) => look_ahead(&mut self.run, step, None),
            None => Ok(()),
        }
    }
}

/// Where the names of a state and of a run part.
fn first_difference(found: &[String], expected: &[String]) -> String {
    let all = found.len().max(expected.len());
    let place = (0..all).find(|&place| found.get(place) != expected.get(place));
    let name = |names: &[String]| {
        let name = place.and_then(|place| names.get(place));
        name.map_or_else(|| "nothing more".to_owned(), |name| format!("\"{name}\""))
    };
    format!(
        "it has {} where this run has {}",
        name(found),
        name(expected)
    )
}
