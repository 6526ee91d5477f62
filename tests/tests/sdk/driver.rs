//! A master's side of one instance: counts its calls.

use std::sync::Arc;

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{self, Failure, Severity, value::Kind};
use linchpin_proto::version::PROTOCOL;

/// One instance as its master drives it.
pub struct Driver {
    pub calls: Arc<dyn Contract>,
    pub instance: u64,
    pub sequence: u64,
}

/// First sequence number: an odd one, since the master may choose it.
pub const FIRST: u64 = 41;

impl Driver {
    /// Makes the instance that `request` asks for.
    pub fn initialize(calls: Arc<dyn Contract>, request: &v1::InitializeRequest) -> Self {
        calls.initialize(request).unwrap();
        Self {
            calls,
            instance: request.instance,
            sequence: request.sequence,
        }
    }

    pub fn next(&mut self) -> u64 {
        self.sequence += 1;
        self.sequence
    }

    pub fn step_request(&mut self, t: f64, step: f64, signals: Vec<v1::Signal>) -> v1::StepRequest {
        v1::StepRequest {
            instance: self.instance,
            sequence: self.next(),
            t,
            step,
            signals,
            outputs: v1::OutputSet::Coupling.into(),
            ..v1::StepRequest::default()
        }
    }

    /// Coupling outputs after a step.
    pub fn step(
        &mut self,
        t: f64,
        step: f64,
        signals: Vec<v1::Signal>,
    ) -> Result<Vec<f64>, Failure> {
        let request = self.step_request(t, step, signals);
        failure(self.calls.step(&request)).map(|reply| values(reply.outputs))
    }

    pub fn perturbed_request(
        &mut self,
        step: f64,
        signals: Vec<v1::Signal>,
        perturbed: Vec<v1::Signal>,
    ) -> v1::PerturbedStepRequest {
        v1::PerturbedStepRequest {
            instance: self.instance,
            sequence: self.next(),
            t: 0.0,
            step,
            signals,
            perturbed,
            ..v1::PerturbedStepRequest::default()
        }
    }

    pub fn exchange_request(
        &mut self,
        advance: Option<v1::Advance>,
        predict: Option<v1::Predict>,
    ) -> v1::ExchangeRequest {
        v1::ExchangeRequest {
            instance: self.instance,
            sequence: self.next(),
            advance,
            predict,
            ..v1::ExchangeRequest::default()
        }
    }

    /// One turn of the exchange; instance and sequence number are filled in.
    pub fn turn(&mut self, request: v1::ExchangeRequest) -> Result<v1::ExchangeReply, Failure> {
        let request = v1::ExchangeRequest {
            instance: self.instance,
            sequence: self.next(),
            ..request
        };
        exchange(&*self.calls, &request)
    }

    pub fn exchange(
        &mut self,
        advance: Option<v1::Advance>,
        predict: Option<v1::Predict>,
    ) -> Result<v1::ExchangeReply, Failure> {
        let request = self.exchange_request(advance, predict);
        exchange(&*self.calls, &request)
    }

    pub fn snapshot_request(&mut self, replaces: Option<u64>) -> v1::SnapshotRequest {
        v1::SnapshotRequest {
            instance: self.instance,
            sequence: self.next(),
            replaces,
        }
    }

    /// Number of a snapshot of the present state.
    pub fn snapshot(&mut self, replaces: Option<u64>) -> Result<u64, Failure> {
        let request = self.snapshot_request(replaces);
        failure(self.calls.snapshot(&request)).map(|reply| reply.snapshot)
    }

    pub fn restore_request(&mut self, snapshot: u64) -> v1::RestoreRequest {
        v1::RestoreRequest {
            instance: self.instance,
            sequence: self.next(),
            snapshot,
        }
    }

    pub fn restore(&mut self, snapshot: u64) -> Result<(), Failure> {
        let request = self.restore_request(snapshot);
        failure(self.calls.restore(&request)).map(|_| ())
    }

    /// Outputs of the present state.
    pub fn evaluate(
        &self,
        signals: Vec<v1::Signal>,
        outputs: &[&str],
    ) -> Result<Vec<f64>, Failure> {
        let request = v1::EvaluateRequest {
            instance: self.instance,
            t: 0.0,
            signals,
            outputs: outputs.iter().map(|&name| name.into()).collect(),
            ..v1::EvaluateRequest::default()
        };
        failure(self.calls.evaluate(&request)).map(|reply| values(reply.outputs))
    }

    /// The present level of a tank.
    pub fn level(&self) -> f64 {
        self.evaluate(vec![constant(0, 0.0)], &["level"]).unwrap()[0]
    }
}

/// One turn of the exchange.
pub fn exchange(
    calls: &dyn Contract,
    request: &v1::ExchangeRequest,
) -> Result<v1::ExchangeReply, Failure> {
    let mut reply = v1::ExchangeReply::default();
    failure(calls.exchange(request, &mut reply))?;
    Ok(reply)
}

/// The answer, or what the worker says against the call.
pub fn failure<T>(answer: Result<T, CallError>) -> Result<T, Failure> {
    answer.map_err(|error| match error {
        CallError::Failed(failure) => failure,
        // What it is on an exchange stream.
        CallError::NoInstance { message } => Failure::misuse("instance", message),
        other => panic!("{other}"),
    })
}

/// That the call was refused as misuse of `field`, with all `words` in the message.
pub fn assert_misuse<T: std::fmt::Debug>(answer: Result<T, Failure>, field: &str, words: &[&str]) {
    let failure = answer.unwrap_err();
    assert_eq!(failure.severity(), Severity::Misuse, "{failure:?}");
    assert_eq!(failure.field.as_deref(), Some(field), "{failure:?}");
    for word in words {
        assert!(failure.message.contains(word), "{word}: {failure:?}");
    }
}

pub fn values(outputs: Option<v1::Outputs>) -> Vec<f64> {
    outputs.unwrap().values
}

/// A signal that is constant over the step.
pub fn constant(input: u32, value: f64) -> v1::Signal {
    through(input, &[(0.0, value)])
}

/// A signal through points (s, value).
pub fn through(input: u32, points: &[(f64, f64)]) -> v1::Signal {
    v1::Signal {
        input,
        nodes: points.iter().map(|point| point.0).collect(),
        values: points.iter().map(|point| point.1).collect(),
    }
}

/// A tank with inflow and leak driven.
pub fn tank(instance: u64) -> v1::InitializeRequest {
    v1::InitializeRequest {
        instance,
        sequence: FIRST,
        protocol: Some(PROTOCOL),
        model: "tank".into(),
        parameters: [("capacity".into(), number(2.5))].into(),
        inputs: vec!["inflow".into(), "leak".into()],
        coupling_outputs: vec!["level".into(), "rate".into()],
        ..v1::InitializeRequest::default()
    }
}

/// A stiff mass on a spring, force and partner driven.
pub fn oscillator(instance: u64, solver: &str) -> v1::InitializeRequest {
    let parameters = [
        ("m", 1.3),
        ("c", 1.7e5),
        ("d", 10.3),
        ("x0", 0.37),
        ("v0", -2.9),
    ];
    let options: &[(&str, f64)] = match solver {
        "rk4" => &[("step", 1.3e-4)],
        _ => &[],
    };
    let table = |pairs: &[(&str, f64)]| {
        let pairs = pairs
            .iter()
            .map(|&(name, value)| (name.into(), number(value)));
        pairs.collect()
    };
    v1::InitializeRequest {
        instance,
        sequence: FIRST,
        protocol: Some(PROTOCOL),
        model: "oscillator".into(),
        parameters: table(&parameters),
        solver: Some(v1::Solver {
            kind: solver.into(),
            options: table(options),
        }),
        inputs: vec!["f".into(), "partner_x".into()],
        coupling_outputs: vec!["x".into(), "v".into()],
        recorded_outputs: vec!["a".into()],
        ..v1::InitializeRequest::default()
    }
}

pub fn number(value: f64) -> v1::Value {
    v1::Value {
        kind: Some(Kind::Number(value)),
    }
}
