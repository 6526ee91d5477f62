//! An instance belongs to the certificate that made it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use linchpin::connect::access;
use linchpin_master::Interrupt;
use linchpin_master::connection::{
    Connection, ExchangeStream, Grpc, TimeLimits, UnaryTurns, new_runtime,
};
use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{self, value::Kind};
use linchpin_proto::version::PROTOCOL;
use linchpin_tests::process::Workshop;

use crate::Worker;
use crate::authority::{Authority, write};

const NUMBER: u64 = 0x5c0ffee;

/// Starts a worker with the certificates of a folder.
type Start = fn(&Path) -> Worker;

const BOTH: [Start; 2] = [Worker::start, Worker::in_python];

/// A worker with two masters of the same authority.
struct House {
    workshop: Workshop,
    worker: Worker,
}

impl House {
    fn new(start: Start) -> Self {
        let workshop = Workshop::new();
        let authority = Authority::new();
        let folder = |name: &str| workshop.path().join(name);
        for master in ["own", "other"] {
            write(&folder(master), &authority.pem(), &authority.master(1));
        }
        let worker = authority.worker(&["127.0.0.1"], 1);
        write(&folder("worker"), &authority.pem(), &worker);
        let worker = start(&folder("worker"));
        Self { workshop, worker }
    }

    fn folder(&self, master: &str) -> PathBuf {
        self.workshop.path().join(master)
    }

    fn connect(&self, master: &str) -> Grpc {
        let limits = TimeLimits {
            start: Duration::from_secs(5),
            answer: Duration::from_secs(10),
        };
        let access = access(Some(&self.folder(master)), None, false).unwrap();
        let (runtime, interrupt) = (new_runtime().unwrap(), Interrupt::default());
        Grpc::connect(&self.worker.address, limits, &access, runtime, interrupt).unwrap()
    }

    fn instances(&self, master: &str, more: &[&str]) -> linchpin_tests::process::Outcome {
        let ask = ["instances", &self.worker.address, "--certificates", master];
        self.workshop.run(&[&ask[..], more].concat())
    }
}

fn initialize(m: f64) -> v1::InitializeRequest {
    let value = |number| v1::Value {
        kind: Some(Kind::Number(number)),
    };
    let parameters = [("m", m), ("c", 1e3), ("d", 10.0), ("x0", 0.0), ("v0", 1.0)];
    v1::InitializeRequest {
        instance: NUMBER,
        protocol: Some(PROTOCOL),
        model: "oscillator".into(),
        parameters: parameters
            .map(|(name, number)| (name.to_owned(), value(number)))
            .into(),
        ..Default::default()
    }
}

#[track_caller]
fn assert_denied<T: std::fmt::Debug>(answer: Result<T, CallError>) {
    match answer {
        Err(CallError::Denied { message }) => {
            assert!(
                message.contains("belongs to another certificate"),
                "{message}"
            );
            assert!(message.contains("0x5c0ffee"), "{message}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn nobody_else_can_call_it() {
    BOTH.into_iter().for_each(is_called_by_its_owner_alone);
}

fn is_called_by_its_owner_alone(start: Start) {
    let house = House::new(start);
    let (own, other) = (house.connect("own"), house.connect("other"));
    own.initialize(&initialize(1.0)).unwrap();
    let instance = NUMBER;
    assert_denied(other.initialize(&initialize(1.0)));
    assert_denied(other.initialize(&initialize(2.0)));
    assert_denied(other.export_state(&v1::ExportStateRequest { instance }));
    assert_denied(other.import_state(&v1::ImportStateRequest {
        instance,
        ..Default::default()
    }));
    assert_denied(other.snapshot(&v1::SnapshotRequest {
        instance,
        sequence: 1,
        ..Default::default()
    }));
    assert_denied(other.restore(&v1::RestoreRequest {
        instance,
        sequence: 1,
        ..Default::default()
    }));
    let step = v1::StepRequest {
        instance,
        sequence: 1,
        step: 1e-3,
        ..Default::default()
    };
    assert_denied(other.step(&step));
    assert_denied(other.perturbed_step(&v1::PerturbedStepRequest {
        instance,
        ..Default::default()
    }));
    assert_denied(other.evaluate(&v1::EvaluateRequest {
        instance,
        ..Default::default()
    }));
    assert_denied(other.terminate(&v1::TerminateRequest { instance }));

    // By the exchange stream as well, and another connection of the owner still may.
    let exchange = v1::ExchangeRequest {
        instance,
        sequence: 1,
        ..Default::default()
    };
    let mut stream = ExchangeStream::new(other);
    stream.post(&exchange).unwrap();
    assert_denied(stream.collect(&mut v1::ExchangeReply::default()));
    let again = house.connect("own");
    again.step(&step).unwrap();
    own.terminate(&v1::TerminateRequest { instance }).unwrap();
    // The number is free again.
    house.connect("other").initialize(&initialize(2.0)).unwrap();
    assert_denied(own.step(&step));
}

#[test]
fn nobody_else_sees_or_ends_it() {
    BOTH.into_iter().for_each(is_seen_by_its_owner_alone);
}

fn is_seen_by_its_owner_alone(start: Start) {
    let house = House::new(start);
    let own = UnaryTurns::new(house.connect("own"));
    own.initialize(&initialize(1.0)).unwrap();
    let listed = house.instances("own", &[]);
    listed
        .exits_with(0)
        .prints(&["instances: 1", "0x0000000005c0ffee"]);
    house
        .instances("other", &[])
        .exits_with(0)
        .prints(&["instances: 0"]);
    let end = ["--end", "0x5c0ffee"];
    house
        .instances("other", &end)
        .fails(1, &["belongs to another certificate"]);
    house
        .instances("other", &["--end", "7"])
        .fails(1, &["has no instance 0x7"]);
    house
        .instances("own", &end)
        .exits_with(0)
        .prints(&["instances: 0"]);
}

/// Two masters that make an instance of the same number at the same time: it is that of one of them.
#[test]
fn a_race_has_one_winner() {
    let house = Arc::new(House::new(Worker::start));
    for _ in 0..20 {
        let threads = ["own", "other"].map(|master| {
            let house = Arc::clone(&house);
            std::thread::spawn(move || {
                let grpc = house.connect(master);
                let made = grpc.initialize(&initialize(1.0)).is_ok();
                (made, grpc)
            })
        });
        let made = threads.map(|thread| thread.join().unwrap());
        assert_ne!(made[0].0, made[1].0);
        let (_, winner) = made.into_iter().find(|(made, _)| *made).unwrap();
        let instance = NUMBER;
        winner
            .terminate(&v1::TerminateRequest { instance })
            .unwrap();
    }
}
