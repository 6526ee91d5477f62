//! One subsystem as the master sees it: a connection, the last messages, and outputs at the present macro point.

pub(super) mod answer;
mod recovery;
mod replacing;
mod request;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use linchpin_proto::contract::CallError;
use linchpin_proto::v1;
use linchpin_proto::version::PROTOCOL;

use crate::connection::{Connection, ExitMessage};
use crate::error::RunError;
use crate::results::{Cause, ContactStatistics, Integrations, SubsystemStatistics};
use crate::system::Differentiation;
use crate::time::MacroStep;
use recovery::{Recovery, random_number};

pub use recovery::RecoverySettings;

/// How much of the inside of a step an answer tells.
#[derive(Debug, Clone, Copy)]
struct Inside {
    integrals: u32,
    instants: usize,
}

/// Nothing is told.
const NOTHING: Inside = Inside {
    integrals: 0,
    instants: 0,
};

/// How far a look-ahead goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ahead {
    /// Over the next macro step, or over none where a method asks for nothing else.
    Step,
    /// Over none, beside a look-ahead over the next macro step.
    Now,
}

/// A subsystem of a running co-simulation.
pub struct Subsystem {
    name: String,
    connection: Box<dyn Connection>,
    /// Name of its model; empty before it is initialised.
    model: String,
    instance: u64,
    sequence: u64,
    recovery: Recovery,
    /// What the next exchange sends.
    pub(crate) request: v1::ExchangeRequest,
    /// The memory of an advance that the request does without.
    idle_advance: Option<v1::Advance>,
    /// What the last exchange brought.
    pub(crate) reply: v1::ExchangeReply,
    /// Names of the coupling outputs, then of the recorded outputs.
    pub(crate) output_names: Vec<String>,
    /// Number of coupling outputs.
    pub(crate) coupling_outputs: usize,
    /// Names of the outputs that are told at instants inside a step.
    interior_names: Vec<String>,
    /// Names of the outputs that are integrated over it.
    integrated_names: Vec<String>,
    /// Outputs at the present macro point, in the order of the names.
    pub(crate) outputs: Vec<f64>,
    /// Error tolerance of the solver, if it has one.
    pub(crate) tolerance: Option<f64>,
    /// Whether its perturbed steps repeat the internal steps of the step that they are compared with.
    pub(crate) repeats_steps: bool,
    /// Whether it finds impacts that its partners take part in.
    pub(crate) couples_impacts: bool,
    /// The impacts of the present macro step, as they are given to it.
    pub(crate) impacts: Option<v1::Impacts>,
    /// Whether it offers directional derivatives.
    pub(crate) offers_derivatives: bool,
    /// Whether its states can leave its process.
    pub(crate) exports_states: bool,
    /// What the solver did so far.
    pub(crate) work: v1::Work,
    /// What it was asked for so far.
    pub(crate) asked: Integrations,
    /// Why it looks ahead in the next exchange.
    pub(crate) looks_ahead_for: Cause,
    /// Exchanges so far.
    pub(crate) exchanges: u64,
}

impl Subsystem {
    pub(crate) fn new(
        name: &str,
        connection: Box<dyn Connection>,
        settings: RecoverySettings,
    ) -> Self {
        Self {
            name: name.to_owned(),
            connection,
            model: String::new(),
            instance: random_number(name),
            sequence: 0,
            recovery: Recovery::new(settings),
            request: v1::ExchangeRequest::default(),
            idle_advance: None,
            reply: v1::ExchangeReply::default(),
            output_names: Vec::new(),
            coupling_outputs: 0,
            interior_names: Vec::new(),
            integrated_names: Vec::new(),
            outputs: Vec::new(),
            tolerance: None,
            repeats_steps: false,
            couples_impacts: false,
            impacts: None,
            offers_derivatives: false,
            exports_states: false,
            work: v1::Work::default(),
            asked: Integrations::default(),
            looks_ahead_for: Cause::Predictor,
            exchanges: 0,
        }
    }

    /// Name in the scene.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Name of its model.
    pub fn model(&self) -> &str {
        &self.model
    }

    /// What it did so far; `unresolved` as [`SubsystemStatistics`] has it.
    pub(crate) fn statistics(&self, unresolved: Option<f64>) -> SubsystemStatistics {
        let work = &self.work;
        SubsystemStatistics {
            subsystem: self.name.clone(),
            route: self.route().to_owned(),
            exchanges: self.exchanges,
            integrations: work.integrations,
            integrations_by_cause: self.asked,
            solver_steps: work.steps,
            time_in_solver: work.nanoseconds as f64 * 1e-9,
            unresolved,
            contacts: work.contacts.map(|contacts| ContactStatistics {
                crosses_joints: self.couples_impacts,
                ..contacts.into()
            }),
            recoveries: self.recovery.done,
        }
    }

    /// Whether the coupling reads outputs of it. Otherwise it is never asked to look ahead.
    pub(crate) fn is_read(&self) -> bool {
        self.coupling_outputs > 0
    }

    /// How its responses are had.
    pub(crate) fn differentiation(&self) -> Differentiation {
        Differentiation {
            noise: self.tolerance.filter(|_| !self.repeats_steps),
            has_derivatives: self.offers_derivatives,
        }
    }

    /// Whether its worker is a process of its own.
    pub(super) fn is_elsewhere(&self) -> bool {
        self.connection.is_renewable()
    }

    /// Which way the exchange takes.
    pub fn route(&self) -> &'static str {
        self.connection.route()
    }

    /// What the worker offers; where `model` is given, that model with these parameters, if the worker can tell.
    pub(crate) fn describe(
        &self,
        model: Option<&str>,
        parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::DescribeReply, CallError> {
        self.connection.contract().describe(&v1::DescribeRequest {
            protocol: Some(PROTOCOL),
            model: model.map(str::to_owned),
            parameters: parameters.clone(),
        })
    }

    pub(crate) fn initialize(
        &mut self,
        mut request: v1::InitializeRequest,
    ) -> Result<(), CallError> {
        request.instance = self.instance;
        request.sequence = self.sequence;
        request.protocol = Some(PROTOCOL);
        self.model.clone_from(&request.model);
        self.coupling_outputs = request.coupling_outputs.len();
        self.output_names = [&request.coupling_outputs[..], &request.recorded_outputs].concat();
        self.interior_names.clone_from(&request.interior_outputs);
        self.integrated_names
            .clone_from(&request.integrated_outputs);
        let reply = self.connection.contract().initialize(&request)?;
        self.recovery.begin(&request, self.exports_states);
        self.tolerance = reply.tolerance;
        Ok(())
    }

    /// Ends the instance and makes it anew.
    pub(crate) fn restart(&mut self, request: v1::InitializeRequest) -> Result<(), CallError> {
        self.terminate()?;
        self.initialize(request)
    }

    /// Ends the instance.
    pub(crate) fn terminate(&self) -> Result<(), CallError> {
        let request = v1::TerminateRequest {
            instance: self.instance,
        };
        self.connection.contract().terminate(&request).map(drop)
    }

    /// Outputs `names` at `t` under constant inputs, by a call outside the macro step.
    pub(crate) fn evaluate(
        &self,
        t: f64,
        inputs: &[f64],
        names: &[String],
    ) -> Result<Vec<f64>, RunError> {
        let signal = |(input, &value): (usize, &f64)| v1::Signal {
            input: input as u32,
            nodes: vec![0.0],
            values: vec![value],
        };
        let request = v1::EvaluateRequest {
            instance: self.instance,
            t,
            signals: inputs.iter().enumerate().map(signal).collect(),
            outputs: names.to_vec(),
            directions: Vec::new(),
        };
        let now = MacroStep {
            start: t,
            length: 0.0,
            end: t,
        };
        let reply = self
            .connection
            .contract()
            .evaluate(&request)
            .map_err(|error| self.failed(error, now))?;
        let values = reply.outputs.unwrap_or_default().values;
        self.check(("outputs", names), &values, NOTHING, now)?;
        Ok(values)
    }

    pub(crate) fn post(&mut self, step: MacroStep) -> Result<(), RunError> {
        self.label_request();
        match self.connection.post(&self.request) {
            Err(error) if error.is_loss() => {
                self.recovery.unsent = Some(error);
                Ok(())
            }
            posted => posted.map_err(|error| self.failed(error, step)),
        }
    }

    /// Gives the next request its numbers.
    fn label_request(&mut self) {
        self.sequence += 1;
        self.request.instance = self.instance;
        self.request.sequence = self.sequence;
    }

    /// Takes the answer and checks that it is complete and finite. `step` is the macro step that is under way.
    pub(crate) fn collect(&mut self, step: MacroStep) -> Result<(), RunError> {
        self.receive(step)?;
        self.take_advanced(step)?;
        self.check_prediction(step)?;
        self.check_evaluation(step)
    }

    fn receive(&mut self, step: MacroStep) -> Result<(), RunError> {
        let collected = match self.recovery.unsent.take() {
            Some(unsent) => Err(unsent),
            None => self.connection.collect(&mut self.reply),
        };
        match collected {
            Err(error) if error.is_loss() => self.recover(error, step)?,
            collected => collected.map_err(|error| self.failed(error, step))?,
        }
        self.exchanges += 1;
        self.asked.count(&self.request, self.looks_ahead_for);
        self.work += self.recovery.whole(self.reply.work.unwrap_or_default());
        self.remember_advance();
        Ok(())
    }

    pub(crate) fn failed(&self, source: CallError, step: MacroStep) -> RunError {
        let exit_message = match source {
            CallError::Lost { .. } | CallError::Deadline { .. } => self.connection.exit_message(),
            _ => ExitMessage::default(),
        };
        RunError::Worker {
            subsystem: self.name.clone(),
            t: step.start,
            step: step.length,
            source: Box::new(source),
            exit_message,
        }
    }
}

impl Drop for Subsystem {
    fn drop(&mut self) {
        // A worker that is gone needs no end of its instance.
        let _ = self.terminate();
    }
}
