//! A worker in plain Python coupled with a built-in one: the contract asks nothing that only Rust can give.

#![allow(clippy::unwrap_used)]

use std::path::PathBuf;
use std::time::Duration;

use linchpin_master::Interrupt;
use linchpin_master::connection::{Access, Grpc, TimeLimits, UnaryTurns, new_runtime};
use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{self, value::Kind};
use linchpin_proto::version::PROTOCOL;
use linchpin_tests::process::Workshop;
use linchpin_tests::python::{Program, Python, in_repository, python};

const SETTINGS: [&str; 8] = [
    "method=baumgarte index=1 degree=0",
    "method=baumgarte index=1 degree=1",
    "method=baumgarte index=1 degree=2",
    "method=baumgarte index=2 degree=0",
    "method=weighted index=1 degree=0",
    "method=weighted index=1 degree=1",
    "method=weighted index=1 degree=2",
    "method=weighted index=2 degree=0",
];

/// Both workers integrate exactly, one by a matrix exponential, one by power series: only rounding tells them apart.
///
/// Relative to the largest value of each column. The multiplier is what closes the gap between the positions, so their
/// rounding reaches it divided by H^2, and comes back to velocities times H. Measured: x 1e-15, v 7e-14, lambda 1.1e-11.
const LARGEST_DIFFERENCE: f64 = 1e-12;
const LARGEST_DIFFERENCE_OF_LOADS: f64 = 1e-10;

/// The worker's program.
fn worker() -> PathBuf {
    in_repository("tests/python/oscillator_worker.py")
}

fn scene(second: &str) -> String {
    format!(
        r#"
[scene]
name = "masses"
t_end = 0.05

[coupling]
method = "baumgarte"
macro_step = 7e-4

[[subsystem]]
name = "mass1"
model = "oscillator"
parameters = {{ m = 1.3, c = 1.7e3, d = 10.3, x0 = 0.01, v0 = 97.0 }}

[[subsystem]]
name = "mass2"
{second}
parameters = {{ m = 2.1, c = 930.0, d = 4.7, x0 = 0.01, v0 = 97.0 }}

[[joint]]
name = "link"
kind = "rigid-link"
a = "mass1"
b = "mass2"
"#
    )
}

fn columns(table: &str) -> Vec<(String, Vec<f64>)> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let names: Vec<String> = reader
        .headers()
        .unwrap()
        .iter()
        .map(str::to_owned)
        .collect();
    let rows: Vec<Vec<f64>> = reader
        .records()
        .map(|row| {
            row.unwrap()
                .iter()
                .map(|value| value.parse().unwrap())
                .collect()
        })
        .collect();
    let column = |place: usize| rows.iter().map(|row| row[place]).collect();
    names
        .into_iter()
        .enumerate()
        .map(|(place, name)| (name, column(place)))
        .collect()
}

/// Largest difference of two columns relative to the largest value.
fn difference(one: &[f64], other: &[f64]) -> f64 {
    assert_eq!(one.len(), other.len());
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |a: f64, b| a.max(b.abs()));
    let apart = largest(&mut one.iter().zip(other).map(|(a, b)| a - b));
    apart / largest(&mut other.iter().copied())
}

#[test]
fn it_agrees_with_the_built_in_worker_to_rounding() {
    let Python { interpreter, stubs } = python();
    let workshop = Workshop::new();
    workshop.write(
        "foreign.toml",
        scene(&format!("command = {:?}", [interpreter, &worker()])),
    );
    workshop.write("built-in.toml", scene(r#"model = "oscillator""#));
    for settings in SETTINGS {
        let run = |name: &str| {
            let file = format!("{name}.toml");
            let mut arguments = vec!["run", &file, "--out", name, "--no-plots", "--quiet"];
            let sets: Vec<String> = settings
                .split(' ')
                .map(|set| format!("--set=coupling.{set}"))
                .collect();
            arguments.extend(sets.iter().map(String::as_str));
            let mut command = workshop.command(&arguments);
            command.env("PYTHONPATH", stubs);
            workshop.start_command(command).wait().succeeds();
            columns(&workshop.read(&format!("{name}/results.csv")))
        };
        for ((name, foreign), (_, own)) in run("foreign").iter().zip(&run("built-in")) {
            let allowed = match name {
                // Accelerations are loads over a mass; residuals are nothing but rounding.
                name if name.ends_with(".lambda") || name.ends_with(".a") => {
                    LARGEST_DIFFERENCE_OF_LOADS
                }
                name if name.contains(".residual.") => continue,
                // A difference of solutions that agree in most of their digits.
                name if name == "error_estimate" => continue,
                _ => LARGEST_DIFFERENCE,
            };
            let difference = difference(foreign, own);
            assert!(
                difference <= allowed,
                "{settings}: {name} differs by {difference:e}"
            );
        }
        let run = workshop.read("foreign/run.json");
        let run: serde_json::Value = serde_json::from_str(&run).unwrap();
        let subsystems = &run["statistics"]["subsystems"];
        assert_eq!(subsystems[0]["route"], "exchange stream");
        assert_eq!(subsystems[1]["route"], "unary calls");
    }
}

/// The program, and its calls as exchanges.
fn serve(workshop: &Workshop) -> (Program, UnaryTurns<Grpc>) {
    let socket = workshop.path().join("foreign");
    let program = Program::start(&worker(), &python().stubs, &socket);
    let limits = TimeLimits {
        start: Duration::from_secs(10),
        answer: Duration::from_secs(10),
    };
    let runtime = new_runtime().unwrap();
    let (access, interrupt) = (Access::default(), Interrupt::default());
    let grpc = Grpc::connect(program.address(), limits, &access, runtime, interrupt).unwrap();
    (program, UnaryTurns::new(grpc))
}

fn initialize(instance: u64) -> v1::InitializeRequest {
    let parameters = [("m", 1.3), ("c", 1.7e3), ("d", 10.3), ("v0", 97.0)];
    let parameters = parameters.map(|(name, value)| {
        let kind = Some(Kind::Number(value));
        (name.to_owned(), v1::Value { kind })
    });
    v1::InitializeRequest {
        instance,
        protocol: Some(PROTOCOL),
        model: "oscillator".into(),
        parameters: parameters.into(),
        inputs: vec!["f".into()],
        coupling_outputs: vec!["x".into(), "v".into(), "a".into()],
        ..v1::InitializeRequest::default()
    }
}

fn force(end: f64) -> Vec<v1::Signal> {
    vec![v1::Signal {
        input: 0,
        nodes: vec![7e-4, 0.0],
        values: vec![end, -17.9],
    }]
}

/// The worker has the unary calls only; an exchange made of them goes back, and takes samples, as any other.
#[test]
fn an_advance_is_taken_back_and_samples_disturb_nothing() {
    let workshop = Workshop::new();
    let (_program, calls) = serve(&workshop);
    let advance = |end, samples: &[f64]| {
        Some(v1::Advance {
            t: 0.0,
            step: 7e-4,
            signals: force(end),
            samples: samples.to_vec(),
            ..v1::Advance::default()
        })
    };
    let predict = v1::Predict {
        t: 7e-4,
        step: 7e-4,
        signals: force(3.0),
        perturbed: force(4.0),
        directions: force(1.0),
        ..v1::Predict::default()
    };
    let go = |instance, turns: &[(bool, Option<v1::Advance>)]| {
        calls.initialize(&initialize(instance)).unwrap();
        let mut reply = v1::ExchangeReply::default();
        for ((go_back, advance), sequence) in turns.iter().zip(1..) {
            let request = v1::ExchangeRequest {
                instance,
                sequence,
                go_back: *go_back,
                advance: advance.clone(),
                predict: Some(predict.clone()),
                ..v1::ExchangeRequest::default()
            };
            calls.exchange(&request, &mut reply).unwrap();
        }
        reply
    };
    let straight = go(1, &[(false, advance(5.0, &[]))]);
    let wandering = [
        (false, advance(-31.0, &[])),
        (true, None),
        (false, advance(9.0, &[3e-4])),
        (true, advance(5.0, &[1e-4, 6e-4])),
    ];
    let mut wandering = go(2, &wandering);
    assert_eq!(std::mem::take(&mut wandering.samples).len(), 2);
    assert_eq!(wandering.derivatives.len(), 1);
    let parts = |reply: v1::ExchangeReply| {
        let all = [reply.perturbed, reply.derivatives].concat();
        let all = reply.advanced.into_iter().chain(reply.predicted).chain(all);
        let bits = |outputs: v1::Outputs| outputs.values.into_iter().map(f64::to_bits);
        all.map(|outputs| bits(outputs).collect()).collect()
    };
    let expected: Vec<Vec<u64>> = parts(straight);
    assert_eq!(expected.len(), 4);
    assert_eq!(parts(wandering), expected);
}
