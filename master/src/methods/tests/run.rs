//! Two free masses between which the method holds a spring force, against the recursion that this is.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1::{self, value::Kind};

use crate::connection::Direct;
use crate::scene::{Scene, Subsystem, parse};
use crate::setup::Options;
use crate::CoSimulation;
use crate::run::checkpoint::Checkpoint;

const SCENE: &str = r#"
[scene]
name = "pair"
t_end = 0.35

[coupling]
method = "held"
spring = 700.0
macro_step = 1e-2

[[subsystem]]
name = "one"
address = "http://127.0.0.1:1"
parameters = { m = 1.5, v = 2.0 }

[[subsystem]]
name = "other"
address = "http://127.0.0.1:2"
parameters = { m = 4.0, v = -1.0 }

[[joint]]
name = "link"
kind = "rigid-link"
a = "one"
b = "other"
"#;

/// A mass under a force that is constant over a step: position, velocity, mass.
#[derive(Default)]
struct Mass(Mutex<[f64; 3]>);

fn missing<T>(call: &'static str) -> Result<T, CallError> {
    Err(CallError::Unimplemented { call })
}

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(ToString::to_string).collect()
}

fn variable(name: &str) -> v1::Variable {
    v1::Variable {
        name: name.into(),
        unit: "1".into(),
        description: name.into(),
        default: Some(0.0),
    }
}

impl Contract for Mass {
    fn describe(&self, _: &v1::DescribeRequest) -> Result<v1::DescribeReply, CallError> {
        let parameter = |name: &str| v1::Parameter {
            name: name.into(),
            ..Default::default()
        };
        let model = v1::Model {
            name: "mass".into(),
            inputs: vec![variable("f")],
            outputs: vec![variable("x")],
            parameters: vec![parameter("m"), parameter("v")],
            markers: vec![v1::Marker {
                name: "mass".into(),
                kind: v1::MarkerKind::Scalar.into(),
                position: names(&["x"]),
                load: names(&["f"]),
                ..v1::Marker::default()
            }],
            ..v1::Model::default()
        };
        Ok(v1::DescribeReply {
            protocol: Some(linchpin_proto::version::PROTOCOL),
            models: vec![model],
            ..v1::DescribeReply::default()
        })
    }

    fn initialize(&self, request: &v1::InitializeRequest) -> Result<v1::InitializeReply, CallError> {
        let number = |name: &str| match request.parameters[name].kind {
            Some(Kind::Number(number)) => number,
            _ => f64::NAN,
        };
        *self.0.lock().unwrap() = [0.0, number("v"), number("m")];
        Ok(v1::InitializeReply::default())
    }

    fn snapshot(&self, _: &v1::SnapshotRequest) -> Result<v1::SnapshotReply, CallError> {
        missing("Snapshot")
    }

    fn restore(&self, _: &v1::RestoreRequest) -> Result<v1::RestoreReply, CallError> {
        missing("Restore")
    }

    fn export_state(&self, _: &v1::ExportStateRequest) -> Result<v1::ExportStateReply, CallError> {
        let state = self.0.lock().unwrap().map(f64::to_le_bytes).concat();
        Ok(v1::ExportStateReply {
            state: Some(v1::ExportedState::sealed("mass", "test", state)),
            ..v1::ExportStateReply::default()
        })
    }

    fn import_state(&self, request: &v1::ImportStateRequest) -> Result<v1::ImportStateReply, CallError> {
        let state = &request.state.as_ref().unwrap().state;
        let (numbers, _) = state.as_chunks();
        let numbers: Vec<f64> = numbers.iter().copied().map(f64::from_le_bytes).collect();
        self.0.lock().unwrap().copy_from_slice(&numbers);
        Ok(v1::ImportStateReply::default())
    }

    fn step(&self, _: &v1::StepRequest) -> Result<v1::StepReply, CallError> {
        missing("Step")
    }

    fn perturbed_step(
        &self,
        _: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, CallError> {
        missing("PerturbedStep")
    }

    fn evaluate(&self, request: &v1::EvaluateRequest) -> Result<v1::EvaluateReply, CallError> {
        let [x, ..] = *self.0.lock().unwrap();
        let values = request.outputs.iter().map(|_| x).collect();
        Ok(v1::EvaluateReply {
            outputs: Some(v1::Outputs { values }),
            ..v1::EvaluateReply::default()
        })
    }

    fn terminate(&self, _: &v1::TerminateRequest) -> Result<v1::TerminateReply, CallError> {
        Ok(v1::TerminateReply::default())
    }

    fn exchange(
        &self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), CallError> {
        let advance = request.advance.as_ref().unwrap();
        let force = Polynomial::from_signal(&advance.signals[0]).unwrap().value(0.0);
        let mut state = self.0.lock().unwrap();
        let [x, v, m] = *state;
        let h = advance.step;
        *state = [x + h * v + force / m * h * h / 2.0, v + force / m * h, m];
        let values = vec![state[0]];
        *reply = v1::ExchangeReply {
            advanced: Some(v1::Outputs { values }),
            ..v1::ExchangeReply::default()
        };
        Ok(())
    }
}

fn start() -> CoSimulation {
    let scene = parse(SCENE, "pair.toml", &[]).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut connect = |_: &Scene, _: &Subsystem| -> Result<Box<dyn crate::connection::Connection>, _> {
        Ok(Box::new(Direct::new(Arc::new(Mass::default()))))
    };
    CoSimulation::start(&scene, &mut connect, &Options::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

fn finish(mut simulation: CoSimulation) -> Vec<BTreeMap<String, f64>> {
    let mut rows = Vec::new();
    while simulation.macro_step().unwrap() {
        let row = simulation.row();
        let columns = row.columns().iter().cloned();
        rows.push(columns.zip(row.values().iter().copied()).collect());
    }
    rows
}

#[test]
fn a_new_method_is_its_folder_and_a_line() {
    let (masses, mut positions, mut velocities) = ([1.5, 4.0], [0.0; 2], [2.0, -1.0]);
    let rows = finish(start());
    assert_eq!(rows.len(), 35);
    for (number, row) in rows.iter().enumerate() {
        let h = 1e-2;
        let force = -700.0 * (positions[0] - positions[1]);
        for (place, sign) in [1.0, -1.0].into_iter().enumerate() {
            let rate = sign * force / masses[place];
            positions[place] += h * velocities[place] + rate * h * h / 2.0;
            velocities[place] += rate * h;
        }
        for (name, expected) in [("one.x", positions[0]), ("other.x", positions[1])] {
            assert!((row[name] - expected).abs() < 1e-12, "{number} {name} {row:?}");
        }
    }
}

#[test]
fn it_is_written_and_read_back_as_any_other() {
    let whole = finish(start());
    let mut stopped = start();
    for _ in 0..12 {
        assert!(stopped.macro_step().unwrap());
    }
    let bytes = postcard::to_stdvec(&stopped.checkpoint().unwrap()).unwrap();
    let checkpoint: Checkpoint = postcard::from_bytes(&bytes).unwrap();
    let mut resumed = start();
    resumed.resume(checkpoint).unwrap();
    assert_eq!(finish(resumed), whole[12..]);
}

#[test]
fn a_scene_that_lacks_its_parameter_is_told() {
    let text = SCENE.replace("spring = 700.0", "");
    let told = parse(&text, "pair.toml", &[]).unwrap_err().to_string();
    assert!(told.contains("lacks `spring`") && told.contains("spring = 1e3"), "{told}");
}
