//! Users' mistakes: place, value and what is allowed.

#![allow(clippy::unwrap_used)]

mod common;

use std::collections::BTreeSet;

use common::body::{Body, model};
use common::cases::CASES;
use common::{EXACT, RADAU5, Solver, build, build_model};
use linchpin_proto::v1::MarkerKind;

fn message(parameters: &[(&str, f64)], solver: Solver) -> (String, String) {
    let error = build(parameters, solver).err().unwrap();
    (error.field().to_owned(), error.to_string())
}

#[test]
fn parameters_out_of_range_are_named() {
    for (name, value) in [
        ("m", 0.0),
        ("m", -1.0),
        ("m", f64::NAN),
        ("c", -1e-3),
        ("d", -2.0),
        ("x0", f64::INFINITY),
        ("v0", f64::NAN),
        ("partner_stiffness", -1.0),
        ("partner_damping", -1.0),
    ] {
        let parameters: Vec<_> = if name == "m" {
            vec![(name, value)]
        } else {
            vec![("m", 1.0), (name, value)]
        };
        let (field, message) = message(&parameters, EXACT);
        assert_eq!(field, format!("parameters.{name}"));
        assert!(
            message.contains(&format!("{value}")) && message.contains("must be"),
            "{message}"
        );
    }
}

#[test]
fn what_is_missing_or_unknown_is_named() {
    assert_eq!(message(&[("c", 1.0)], EXACT).0, "parameters.m");
    assert_eq!(
        message(&[("m", 1.0), ("mass", 1.0)], EXACT).0,
        "parameters.mass"
    );
    let (field, message) = message(&[("m", 1.0)], Solver("euler", &[]));
    assert!(
        field == "solver.kind"
            && message.contains("euler")
            && message.contains("exact, radau5, rk4"),
        "{message}"
    );
}

#[test]
fn options_of_solvers_are_checked() {
    let m = [("m", 1.0)];
    assert_eq!(message(&m, Solver("rk4", &[])).0, "solver.step");
    assert_eq!(
        message(&m, Solver("rk4", &[("step", 0.0)])).0,
        "solver.step"
    );
    assert_eq!(
        message(&m, Solver("radau5", &[("rtol", -1e-8)])).0,
        "solver.rtol"
    );
    assert_eq!(
        message(&m, Solver("radau5", &[("atol", 0.0)])).0,
        "solver.atol"
    );
    assert_eq!(
        message(&m, Solver("exact", &[("rtol", 1e-8)])).0,
        "solver.rtol"
    );
}

#[test]
fn parameters_of_bodies_out_of_range_are_named() {
    for (case, mistakes) in [
        (
            CASES[1],
            [
                ("m", 0.0),
                ("inertia", 0.0),
                ("length", -0.9),
                ("spring", -1.0),
                ("damping", -1e-3),
                ("angle0", f64::NAN),
            ]
            .as_slice(),
        ),
        (
            CASES[2],
            &[
                ("m", -1.0),
                ("inertia", 0.0),
                ("length", 0.0),
                ("gravity", f64::INFINITY),
                ("vx0", f64::NAN),
            ],
        ),
        (
            CASES[3],
            &[
                ("m", 0.0),
                ("j1", 0.0),
                ("j2", -0.1),
                ("j2", 0.41),
                ("j3", 0.47),
                ("end_z", f64::NAN),
                ("rx0", f64::INFINITY),
            ],
        ),
    ] {
        for &(wrong, value) in mistakes {
            let altered = |&(name, own): &(&'static str, f64)| {
                (name, if name == wrong { value } else { own })
            };
            let mut parameters: Vec<_> = case.parameters.iter().map(altered).collect();
            if !parameters.iter().any(|(name, _)| *name == wrong) {
                parameters.push((wrong, value));
            }
            let error = build_model(&*model(case.model), &parameters, RADAU5).err();
            let error = error.unwrap_or_else(|| panic!("{} {wrong} = {value}", case.model));
            assert_eq!(error.field(), format!("parameters.{wrong}"));
            let message = error.to_string();
            assert!(
                message.contains(&format!("{value}")) && message.contains("must"),
                "{message}"
            );
        }
    }
}

/// The moments of a flat body add up exactly, but not always in floating point.
#[test]
fn a_flat_body_is_allowed() {
    let flat = [("m", 1.0), ("j1", 0.7), ("j2", 0.1), ("j3", 0.8)];
    let [_, (_, j1), (_, j2), (_, j3)] = flat;
    assert!(j1 + j2 < j3);
    assert!(build_model(&*model("spatial-body"), &flat, RADAU5).is_ok());
}

#[test]
fn descriptions_name_only_what_they_have() {
    for model in linchpin_models::models() {
        let model = model.describe();
        let outputs: Vec<_> = model.outputs.iter().map(|own| &own.name).collect();
        let inputs: Vec<_> = model.inputs.iter().map(|own| &own.name).collect();
        let parameters: Vec<_> = model.parameters.iter().map(|own| &own.name).collect();
        for names in [&outputs, &inputs, &parameters] {
            let different: BTreeSet<_> = names.iter().collect();
            assert_eq!(different.len(), names.len(), "{}", model.name);
        }
        for marker in &model.markers {
            let motion = [&marker.position, &marker.velocity, &marker.acceleration];
            assert!(
                motion
                    .into_iter()
                    .flatten()
                    .all(|name| outputs.contains(&name))
            );
            assert!(marker.load.iter().all(|name| inputs.contains(&name)));
            let lengths = match marker.kind() {
                MarkerKind::Scalar => [1, 1, 1, 1],
                MarkerKind::Planar => [3, 3, 3, 3],
                MarkerKind::Spatial => [7, 6, 6, 6],
                MarkerKind::Unspecified => panic!("{} {}", model.name, marker.name),
            };
            let [position, velocity, acceleration] = motion.map(Vec::len);
            // What is empty is not offered.
            for (own, whole) in [position, velocity, acceleration, marker.load.len()]
                .into_iter()
                .zip(lengths)
            {
                assert!(own == 0 || own == whole, "{} {}", model.name, marker.name);
            }
        }
        for state in &model.states {
            assert!(outputs.contains(&&state.output) && parameters.contains(&&state.initial));
        }
        for variable in model.inputs.iter().chain(&model.outputs) {
            assert!(!variable.unit.is_empty() && !variable.description.is_empty());
        }
    }
}

/// A state is what its parameter sets it to.
#[test]
fn states_start_at_their_parameters() {
    let has_states = |case: &common::cases::Case| !case.description().states.is_empty();
    for case in CASES.into_iter().filter(has_states) {
        let mut body = Body::of(case, RADAU5);
        for state in body.model.states.clone() {
            let given = case
                .parameters
                .iter()
                .find(|(name, _)| *name == state.initial);
            let expected = given.map_or(0.0, |(_, value)| *value);
            let error = (body.read_one(&state.output) - expected).abs();
            assert!(
                error < 1e-15 * expected.abs().max(1.0),
                "{case:?} {}",
                state.output
            );
        }
    }
}
