//! Whatever a message says: the worker answers, and the instance behind it stays sound.

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1;
use proptest::prelude::*;

use crate::driver::{Driver, constant, number, oscillator, tank};
use crate::peer::host;
use crate::tank::START;

fn numbers() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => -3.0..3.0f64,
        1 => Just(0.0),
        1 => any::<f64>(),
        1 => prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(f64::MAX), Just(5e-324)],
    ]
}

fn signal() -> impl Strategy<Value = v1::Signal> {
    let points = proptest::collection::vec((numbers(), numbers()), 0..10);
    (0u32..4, points, any::<bool>()).prop_map(|(input, points, equal)| {
        let (nodes, mut values): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        if !equal {
            values.pop();
        }
        v1::Signal {
            input,
            nodes,
            values,
        }
    })
}

/// None, in most cases inside the step where they are any, or anything.
fn instants() -> impl Strategy<Value = Vec<f64>> {
    prop_oneof![
        Just(Vec::new()),
        Just(vec![1e-4, 3e-4]),
        proptest::collection::vec(numbers(), 1..3),
    ]
}

fn signals() -> impl Strategy<Value = Vec<v1::Signal>> {
    proptest::collection::vec(signal(), 0..4)
}

fn integrals() -> impl Strategy<Value = u32> {
    prop_oneof![0..9u32, any::<u32>()]
}

#[derive(Debug, Clone)]
enum Call {
    Step(v1::StepRequest),
    Perturbed(v1::PerturbedStepRequest),
    Evaluate(v1::EvaluateRequest),
    Exchange(Box<v1::ExchangeRequest>),
    Snapshot(v1::SnapshotRequest),
    Restore(v1::RestoreRequest),
}

prop_compose! {
    fn impact()(at in numbers(), contacts in proptest::collection::vec(0u32..3, 0..3),
        loads in proptest::collection::vec(numbers(), 0..3)) -> v1::Impact {
        v1::Impact { at, contacts, loads, multipliers: Vec::new() }
    }
}

fn impacts() -> impl Strategy<Value = Option<v1::Impacts>> {
    let impacts = proptest::collection::vec(impact(), 0..3);
    proptest::option::of(impacts.prop_map(|impacts| v1::Impacts { impacts }))
}

fn interface() -> impl Strategy<Value = Option<v1::Interface>> {
    let lists = [0; 2].map(|_| proptest::collection::vec(numbers(), 0..3));
    let interface = (0u32..3, lists).prop_map(|(rows, [directions, mobility])| v1::Interface {
        rows,
        directions,
        mobility,
    });
    proptest::option::of(interface)
}

prop_compose! {
    fn step()(sequence in 40u64..46, outputs in -1..3i32, t in numbers(), step in numbers(), signals in signals(),
        instants in instants(), integrals in integrals(), impacts in impacts(), interface in interface(),
    ) -> v1::StepRequest {
        v1::StepRequest { instance: 5, sequence, t, step, signals, outputs, instants, integrals, impacts, interface }
    }
}

prop_compose! {
    fn look()(
        t in numbers(), step in numbers(), signals in signals(), perturbed in signals(), directions in signals(),
        instants in instants(), integrals in integrals(), impacts in impacts(), interface in interface(),
    ) -> v1::Predict {
        v1::Predict { t, step, signals, perturbed, directions, instants, integrals, impacts, interface }
    }
}

fn call() -> impl Strategy<Value = Call> {
    let name = prop_oneof![Just("level".to_owned()), Just("x".to_owned()), ".{0,3}"];
    let samples = proptest::collection::vec(numbers(), 0..3);
    let optional = |present: bool, look: v1::Predict| present.then_some(look);
    prop_oneof![
        step().prop_map(Call::Step),
        (step(), look()).prop_map(|(step, look)| Call::Perturbed(v1::PerturbedStepRequest {
            instance: 5,
            sequence: step.sequence,
            t: look.t,
            step: look.step,
            signals: look.signals,
            perturbed: look.perturbed,
            directions: look.directions,
            instants: look.instants,
            integrals: look.integrals,
            impacts: look.impacts,
            interface: look.interface,
        })),
        (look(), proptest::collection::vec(name, 0..3)).prop_map(|(look, outputs)| {
            Call::Evaluate(v1::EvaluateRequest {
                instance: 5,
                t: look.t,
                signals: look.signals,
                outputs,
                directions: look.directions,
            })
        }),
        (step(), [look(), look()], any::<[bool; 4]>(), samples).prop_map(
            move |(step, [ahead, now], [go_back, advances, predicts, evaluates], samples)| {
                Call::Exchange(Box::new(v1::ExchangeRequest {
                    instance: 5,
                    sequence: step.sequence,
                    advance: advances.then_some(v1::Advance {
                        t: step.t,
                        step: step.step,
                        signals: step.signals,
                        samples,
                        instants: step.instants,
                        integrals: step.integrals,
                        impacts: step.impacts,
                    }),
                    predict: optional(predicts, ahead),
                    go_back,
                    evaluate: optional(evaluates, v1::Predict { step: 0.0, ..now }),
                }))
            }
        ),
        (40u64..46, proptest::option::of(0u64..4)).prop_map(|(sequence, replaces)| {
            Call::Snapshot(v1::SnapshotRequest {
                instance: 5,
                sequence,
                replaces,
            })
        }),
        (40u64..46, 0u64..4).prop_map(|(sequence, snapshot)| {
            Call::Restore(v1::RestoreRequest {
                instance: 5,
                sequence,
                snapshot,
            })
        }),
    ]
}

fn make(calls: &dyn Contract, call: &Call) -> Result<(), CallError> {
    match call {
        Call::Step(request) => calls.step(request).map(drop),
        Call::Perturbed(request) => calls.perturbed_step(request).map(drop),
        Call::Evaluate(request) => calls.evaluate(request).map(drop),
        Call::Exchange(request) => calls.exchange(request, &mut v1::ExchangeReply::default()),
        Call::Snapshot(request) => calls.snapshot(request).map(drop),
        Call::Restore(request) => calls.restore(request).map(drop),
    }
}

fn vector() -> impl Strategy<Value = Vec<f64>> {
    prop_oneof![
        15 => Just(vec![0.6, 0.8, 0.0]),
        1 => Just(vec![0.0; 3]),
        1 => proptest::collection::vec(numbers(), 0..5),
    ]
}

fn places(len: usize) -> impl Strategy<Value = Vec<u32>> {
    prop_oneof![
        15 => proptest::collection::vec(0u32..11, len),
        1 => Just(Vec::new()),
        1 => proptest::collection::vec(any::<u32>(), 0..6),
    ]
}

prop_compose! {
    /// Mostly one that the end of a planar body or a body in space can take.
    fn joint_load()(
        is_planar in any::<bool>(), law in 0..4i32, end in 0..3i32, multiplier in 0..12u32,
        [point_a, point_b, axis_a, axis_b] in [vector(), vector(), vector(), vector()],
        [planar, spatial] in [[places(2), places(1), places(0)], [places(3), places(3), places(4)]],
    ) -> (&'static str, v1::JointLoad) {
        let (model, places) = if is_planar { ("planar-body", planar) } else { ("spatial-body", spatial) };
        let [partner_position, partner_rotation, partner_attitude] = places;
        let marker = "end".to_owned();
        (model, v1::JointLoad {
            marker, law, end, point_a, point_b, axis_a, axis_b, multiplier,
            partner_position, partner_rotation, partner_attitude,
        })
    }
}

/// An instance with ten joint inputs behind one input.
fn joined(model: &str, load: v1::JointLoad) -> v1::InitializeRequest {
    let needed = ["m", "j1", "j2", "j3", "inertia", "length"];
    let known = host()
        .describe(&v1::DescribeRequest::default())
        .unwrap()
        .models;
    let parameters = { known.into_iter() }
        .find(|own| own.name == model)
        .unwrap()
        .parameters;
    let parameters = parameters
        .into_iter()
        .filter(|own| needed.contains(&own.name.as_str()));
    v1::InitializeRequest {
        model: model.into(),
        parameters: parameters.map(|own| (own.name, number(0.7))).collect(),
        solver: None,
        inputs: vec!["end_fx".into()],
        coupling_outputs: vec!["end_x".into()],
        joint_inputs: (0..10).map(|input| input.to_string()).collect(),
        joint_loads: vec![load],
        ..tank(5)
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn an_oscillator_survives_any_calls(
        calls in proptest::collection::vec(call(), 1..12),
        solver in prop_oneof![Just("exact"), Just("radau5")],
    ) {
        let host = host();
        let driver = Driver::initialize(host.clone(), &oscillator(5, solver));
        for call in calls {
            if let Err(error) = make(&*host, &call) {
                let CallError::Failed(failure) = error else { panic!("{error}") };
                prop_assert!(!failure.message.contains("panicked"), "{:?}: {:?}", call, failure);
            }
        }
        let state = driver.evaluate(vec![], &["x", "v"]).unwrap();
        prop_assert!(state.iter().all(|value| value.is_finite()), "{:?}", state);
    }

    /// Wherever this tank goes it overflows, after it has changed its level; below 0 it panics, as it should.
    #[test]
    fn calls_that_fail_change_nothing(calls in proptest::collection::vec(call(), 1..12)) {
        let host = host();
        let mut request = tank(5);
        request.parameters.insert("capacity".into(), number(f64::MIN_POSITIVE));
        let driver = Driver::initialize(host.clone(), &request);
        for call in calls {
            match make(&*host, &call) {
                Err(CallError::Failed(failure)) if failure.message.contains("panicked") => return Ok(()),
                _ => prop_assert_eq!(driver.level(), START, "{:?}", call),
            }
        }
    }

    #[test]
    fn any_initialize_is_answered(
        name in ".{0,6}", value in numbers(), t_start in numbers(), known in any::<bool>(),
        inputs in proptest::collection::vec(prop_oneof![Just("f".to_owned()), ".{0,3}"], 0..4),
    ) {
        let host = host();
        let mut request = v1::InitializeRequest { t_start, inputs, ..oscillator(5, "radau5") };
        let name = if known { "m".to_owned() } else { name };
        request.parameters.insert(name, number(value));
        match host.initialize(&request) {
            Ok(_) => prop_assert!(value > 0.0 && t_start.is_finite() && host.instances() == 1),
            Err(CallError::Failed(failure)) => {
                prop_assert!(!failure.message.contains("panicked"), "{:?}", failure);
                prop_assert_eq!(host.instances(), 0);
            }
            Err(other) => panic!("{other}"),
        }
    }

    #[test]
    fn any_joint_load_is_answered(
        (model, load) in joint_load(), values in proptest::collection::vec(numbers(), 11),
    ) {
        let host = host();
        let request = joined(model, load);
        if let Err(CallError::Failed(failure)) = host.initialize(&request) {
            prop_assert!(failure.field.is_some(), "{:?}", failure);
            return Ok(());
        }
        let signals = || (0..).zip(&values).map(|(place, &value)| constant(place, value)).collect();
        let step = v1::StepRequest { instance: 5, sequence: request.sequence + 1, step: 1e-3, signals: signals(),
            ..v1::StepRequest::default() };
        for call in [look_at(signals()), Call::Step(step), look_at(signals())] {
            if let Err(CallError::Failed(failure)) = make(&*host, &call) {
                prop_assert!(!failure.message.contains("panicked"), "{:?}: {:?}", call, failure);
            }
        }
    }
}

fn look_at(signals: Vec<v1::Signal>) -> Call {
    Call::Evaluate(v1::EvaluateRequest {
        instance: 5,
        t: 0.0,
        signals,
        outputs: vec!["end_ax".into(), "end_x".into()],
        ..v1::EvaluateRequest::default()
    })
}
