//! Users' mistakes: place, value and what is allowed.

#![allow(clippy::unwrap_used)]

mod common;

use common::{EXACT, Solver, build};
use linchpin_models::oscillator::Oscillator;
use linchpin_worker::Model;

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
fn the_description_names_only_what_it_has() {
    let model = Oscillator.describe();
    let inputs: Vec<_> = model
        .inputs
        .iter()
        .map(|input| input.name.as_str())
        .collect();
    let outputs: Vec<_> = model
        .outputs
        .iter()
        .map(|output| output.name.as_str())
        .collect();
    let parameters: Vec<_> = model
        .parameters
        .iter()
        .map(|parameter| parameter.name.as_str())
        .collect();
    let marker = &model.markers[0];
    let spring = marker.spring.as_ref().unwrap();
    for output in [
        Some(&marker.position),
        marker.velocity.as_ref(),
        marker.acceleration.as_ref(),
    ] {
        assert!(outputs.contains(&output.unwrap().as_str()));
    }
    for input in [
        &marker.load,
        &spring.partner_position,
        &spring.partner_velocity,
    ] {
        assert!(inputs.contains(&input.as_str()));
    }
    for parameter in [&spring.stiffness, &spring.damping] {
        assert!(parameters.contains(&parameter.as_str()));
    }
    for state in &model.states {
        assert!(
            outputs.contains(&state.output.as_str())
                && parameters.contains(&state.initial.as_str())
        );
    }
    for description in model.inputs.iter().chain(&model.outputs) {
        assert!(!description.unit.is_empty() && !description.description.is_empty());
    }
}
