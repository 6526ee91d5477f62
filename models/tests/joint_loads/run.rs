//! A model as a master drives it over the contract.

use std::collections::BTreeMap;

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1;
use linchpin_proto::version::PROTOCOL;
use linchpin_worker::Host;

use crate::common::cases::Case;
use crate::common::{Solver, number};

/// A signal as a function of the time of the simulation.
pub type Signal<'a> = &'a dyn Fn(f64) -> f64;

/// One instance.
pub struct Run {
    host: Host,
    sequence: u64,
    kept: Option<u64>,
    pub t: f64,
    pub internal_steps: u64,
}

const INSTANCE: u64 = 7;

impl Run {
    /// `case` with other values of some parameters, and what `joints` says of inputs and loads.
    pub fn new(
        case: Case,
        parameters: &[(&str, f64)],
        solver: Solver,
        joints: v1::InitializeRequest,
    ) -> Self {
        let table = |pairs: &[(&str, f64)]| -> BTreeMap<String, v1::Value> {
            let pairs = pairs.iter();
            pairs
                .map(|&(name, value)| (name.to_owned(), number(value)))
                .collect()
        };
        let mut all = case.values();
        all.extend(table(parameters));
        let host = Host::new(linchpin_models::models());
        let request = v1::InitializeRequest {
            instance: INSTANCE,
            protocol: Some(PROTOCOL),
            model: case.model.to_owned(),
            parameters: all,
            solver: Some(v1::Solver {
                kind: solver.0.to_owned(),
                options: table(solver.1),
            }),
            ..joints
        };
        answer(host.initialize(&request));
        Self {
            host,
            sequence: 0,
            kept: None,
            t: 0.0,
            internal_steps: 0,
        }
    }

    fn next(&mut self) -> u64 {
        self.sequence += 1;
        self.sequence
    }

    /// Steps over `length`; every signal is the polynomial of degree 7 that meets its function at Chebyshev's points.
    pub fn step(&mut self, length: f64, signals: &[Signal]) {
        let request = v1::StepRequest {
            instance: INSTANCE,
            sequence: self.next(),
            t: self.t,
            step: length,
            signals: polynomials(&nodes(length), self.t, signals),
            ..v1::StepRequest::default()
        };
        let reply = answer(self.host.step(&request));
        self.internal_steps += reply.work.unwrap().steps;
        self.t += length;
    }

    /// Steps over `length` from here and reads outputs there, then goes back.
    pub fn look_ahead(&mut self, length: f64, signals: &[Signal], outputs: &[String]) -> Vec<f64> {
        let (instance, t) = (INSTANCE, self.t);
        let request = v1::SnapshotRequest {
            instance,
            sequence: self.next(),
            replaces: self.kept,
        };
        let snapshot = answer(self.host.snapshot(&request)).snapshot;
        self.kept = Some(snapshot);
        self.step(length, signals);
        let values = self.read(signals, outputs);
        let request = v1::RestoreRequest {
            instance,
            sequence: self.next(),
            snapshot,
        };
        answer(self.host.restore(&request));
        self.t = t;
        values
    }

    /// Outputs of the present state under the present values of the signals.
    pub fn read(&self, signals: &[Signal], outputs: &[String]) -> Vec<f64> {
        let request = v1::EvaluateRequest {
            instance: INSTANCE,
            t: self.t,
            signals: polynomials(&[0.0], self.t, signals),
            outputs: outputs.to_vec(),
            ..v1::EvaluateRequest::default()
        };
        answer(self.host.evaluate(&request)).outputs.unwrap().values
    }

    pub fn read_all<const N: usize>(&self, signals: &[Signal], outputs: [&str; N]) -> [f64; N] {
        let values = self.read(signals, &outputs.map(str::to_owned));
        values.try_into().unwrap()
    }
}

/// Chebyshev's points of a step.
pub fn nodes(length: f64) -> [f64; 8] {
    std::array::from_fn(|i| {
        let angle = std::f64::consts::PI * (i as f64 + 0.5) / 8.0;
        0.5 * length * (1.0 - angle.cos())
    })
}

fn polynomials(nodes: &[f64], t: f64, signals: &[Signal]) -> Vec<v1::Signal> {
    let signals = signals.iter().zip(0..).map(|(value, input)| v1::Signal {
        input,
        nodes: nodes.to_vec(),
        values: nodes.iter().map(|node| value(t + node)).collect(),
    });
    signals.collect()
}

fn answer<T>(answer: Result<T, CallError>) -> T {
    answer.unwrap_or_else(|error| panic!("{error}"))
}
