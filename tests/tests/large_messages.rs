//! Exported states above the default size of a message, from a worker in Python that is told to send them.

#![allow(clippy::unwrap_used)]

use linchpin_master::Interrupt;
use linchpin_master::connection::{Access, Grpc, TimeLimits, new_runtime};
use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{self, value::Kind};
use linchpin_proto::version::PROTOCOL;
use linchpin_tests::python::{Program, in_repository};
use std::time::Duration;

/// Above the default of 16.
const MEBIBYTES: usize = 20;

/// A worker, and a connection to it.
struct Peer {
    calls: Grpc,
    _program: Program,
    _folder: tempfile::TempDir,
}

impl Peer {
    fn start(flags: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let program = Program::start_with(
            &in_repository("tests/python/large_worker.py"),
            &in_repository("worker/python/src"),
            &folder.path().join("worker.sock"),
            flags,
        );
        let limit = Duration::from_secs(20);
        let limits = TimeLimits {
            start: limit,
            answer: limit,
        };
        let runtime = new_runtime().unwrap();
        let interrupt = Interrupt::default();
        let access = Access::default();
        Self {
            calls: Grpc::connect(program.address(), limits, &access, runtime, interrupt).unwrap(),
            _program: program,
            _folder: folder,
        }
    }

    /// An instance behind some steps.
    fn stepped(&self, instance: u64, steps: u64) {
        let size = v1::Value {
            kind: Some(Kind::Number(MEBIBYTES as f64)),
        };
        let request = v1::InitializeRequest {
            instance,
            protocol: Some(PROTOCOL),
            model: "large".into(),
            parameters: [("mebibytes".to_owned(), size)].into(),
            coupling_outputs: vec!["steps".into()],
            ..Default::default()
        };
        self.calls.initialize(&request).unwrap();
        for sequence in 1..=steps {
            self.step(instance, sequence);
        }
    }

    fn step(&self, instance: u64, sequence: u64) -> f64 {
        let request = v1::StepRequest {
            instance,
            sequence,
            step: 1e-3,
            ..Default::default()
        };
        let reply = self.calls.step(&request).unwrap();
        reply.outputs.unwrap().values[0]
    }

    fn export(&self, instance: u64) -> Result<v1::ExportedState, CallError> {
        let request = v1::ExportStateRequest { instance };
        Ok(self.calls.export_state(&request)?.state.unwrap())
    }

    fn import(&self, instance: u64, state: &v1::ExportedState) -> Result<(), CallError> {
        let request = v1::ImportStateRequest {
            instance,
            sequence: 1,
            state: Some(state.clone()),
        };
        self.calls.import_state(&request).map(drop)
    }
}

/// Out of one process and into another one.
#[test]
fn a_master_takes_what_a_worker_is_told_to_send() {
    let flags = ["--max-message", "32"];
    let (from, to) = (Peer::start(&flags), Peer::start(&flags));
    from.stepped(1, 3);
    let state = from.export(1).unwrap();
    assert!(state.state.len() > MEBIBYTES << 20);
    to.stepped(2, 0);
    to.import(2, &state).unwrap();
    assert_eq!(to.step(2, 2), 4.0);
}

/// The worker that has the default neither sends nor takes it, says why, and goes on.
#[test]
fn a_worker_refuses_what_is_beyond_its_size() {
    let (large, small) = (Peer::start(&["--max-message", "32"]), Peer::start(&[]));
    large.stepped(1, 1);
    small.stepped(2, 0);
    for refused in [
        small.export(2).map(drop),
        small.import(2, &large.export(1).unwrap()),
    ] {
        let text = refused.unwrap_err().to_string();
        assert!(
            text.contains("larger than max") && text.contains("16777216"),
            "{text}"
        );
    }
    assert_eq!(small.step(2, 1), 1.0);
}
