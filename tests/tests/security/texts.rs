//! What a worker says is shown, and harms nobody: no control characters, no floods, no time for requests that grow with their
//! square.

use std::sync::Arc;
use std::time::{Duration, Instant};

use linchpin_models::models;
use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1;
use linchpin_proto::version::PROTOCOL;
use linchpin_tests::process::{Outcome, Peer, Workshop};
use linchpin_worker::Host;

/// It clears the screen, sets the title of the window, and writes from right to left.
const EVIL: &str = "\u{1b}[2J\u{1b}]0;owned\u{7}\u{9b}31m\u{202e}";

/// The built-in models under names that are meant to do harm. They can do nothing.
struct Evil(Host);

fn refused<T>() -> Result<T, CallError> {
    let message = format!("no {EVIL}{}", "m".repeat(5000));
    Err(v1::Failure::misuse(EVIL, message).into())
}

impl Contract for Evil {
    fn describe(&self, request: &v1::DescribeRequest) -> Result<v1::DescribeReply, CallError> {
        let mut reply = self.0.describe(request)?;
        reply.worker += EVIL;
        for model in &mut reply.models {
            model.description += EVIL;
            for variable in &mut model.outputs {
                variable.unit += EVIL;
                variable.description = EVIL.repeat(500);
            }
        }
        Ok(reply)
    }
    fn initialize(&self, _: &v1::InitializeRequest) -> Result<v1::InitializeReply, CallError> {
        refused()
    }
    fn snapshot(&self, _: &v1::SnapshotRequest) -> Result<v1::SnapshotReply, CallError> {
        refused()
    }
    fn restore(&self, _: &v1::RestoreRequest) -> Result<v1::RestoreReply, CallError> {
        refused()
    }
    fn step(&self, _: &v1::StepRequest) -> Result<v1::StepReply, CallError> {
        refused()
    }
    fn perturbed_step(
        &self,
        _: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, CallError> {
        refused()
    }
    fn evaluate(&self, _: &v1::EvaluateRequest) -> Result<v1::EvaluateReply, CallError> {
        refused()
    }
    fn terminate(&self, _: &v1::TerminateRequest) -> Result<v1::TerminateReply, CallError> {
        Ok(v1::TerminateReply::default())
    }
    fn exchange(
        &self,
        _: &v1::ExchangeRequest,
        _: &mut v1::ExchangeReply,
    ) -> Result<(), CallError> {
        refused()
    }
    fn list_instances(
        &self,
        _: &v1::ListInstancesRequest,
    ) -> Result<v1::ListInstancesReply, CallError> {
        let instance = v1::InstanceState {
            model: EVIL.to_owned(),
            ..Default::default()
        };
        Ok(v1::ListInstancesReply {
            instances: vec![instance],
        })
    }
}

#[track_caller]
fn assert_harmless(outcome: &Outcome) {
    for text in [&outcome.stdout, &outcome.stderr] {
        let is_harmful = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
        let found = text.find(is_harmful);
        assert_eq!(found, None, "{:?}", text.get(..400));
        assert!(text.lines().all(|line| line.len() < 6000), "{text}");
    }
}

#[test]
fn terminals_are_safe() {
    let workshop = Workshop::new();
    let peer = Peer::serve(&workshop, Arc::new(Evil(Host::new(models()))));
    for command in ["describe", "instances", "conformance"] {
        let mut ask = vec![command, peer.address()];
        if command == "conformance" {
            ask.extend(["--model", "oscillator"]);
        }
        assert_harmless(&workshop.run(&ask));
    }
    let scene = include_str!("../../../scenes/oscillator.toml");
    let served = format!("model = \"oscillator\"\naddress = \"{}\"", peer.address());
    workshop.write(
        "scene.toml",
        scene.replacen("model = \"oscillator\"", &served, 1),
    );
    let outcome = workshop.run(&["run", "scene.toml"]);
    assert_harmless(outcome.exits_with(2).says(&["mass1", "more bytes"]));
}

#[test]
fn last_words_are_safe() {
    let workshop = Workshop::new();
    let words =
        format!("printf '{EVIL}%s\\n' \"$(head -c 9000 /dev/zero | tr '\\0' m)\" >&2; exit 3");
    workshop.write("last.sh", words);
    let scene = include_str!("../../../scenes/oscillator.toml");
    let served = "model = \"oscillator\"\ncommand = [\"sh\", \"last.sh\"]";
    workshop.write(
        "scene.toml",
        scene.replacen("model = \"oscillator\"", served, 1),
    );
    let outcome = workshop.run(&["run", "scene.toml"]);
    assert_harmless(
        outcome
            .exits_with(1)
            .says(&["mass1", "exit status: 3", "more bytes"]),
    );
}

/// Compared one by one with all others they took 13 s.
#[test]
fn many_names_take_no_time() {
    let host = Host::new(models());
    let names = |prefix: &str| {
        (0..80_000)
            .map(|number| format!("{prefix}{number}"))
            .collect()
    };
    let request = v1::InitializeRequest {
        instance: 1,
        protocol: Some(PROTOCOL),
        model: "planar-body".into(),
        joint_inputs: names("lambda"),
        ..Default::default()
    };
    let mut twice = request.clone();
    twice.joint_inputs[79_999] = "lambda5".into();
    for (request, word) in [
        (request, "parameters"),
        (twice, "\"lambda5\" is listed twice"),
    ] {
        let began = Instant::now();
        let error = host.initialize(&request).unwrap_err().to_string();
        assert!(error.contains(word), "{error}");
        assert!(
            began.elapsed() < Duration::from_secs(2),
            "{:?}",
            began.elapsed()
        );
    }
}
