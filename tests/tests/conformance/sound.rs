//! No built-in model is accused, with any of its solvers.

use linchpin::conformance::verdict::Grade;
use serde_json::{Value as Json, json};

use crate::subjects::{built_in, examine, settings};

/// Smooth solvers of the built-in models: adaptive, and with several internal steps in the macro step, one, or fewer than one.
const SMOOTH: [&str; 4] = ["radau5", "rk4 step=1e-4", "rk4 step=1e-3", "rk4 step=1"];

/// Schemes with contacts, one internal step in a macro step as is their default, and several.
const NONSMOOTH: [&str; 8] = [
    "",
    "newmark-alpha",
    "bathe",
    "ed-alpha",
    "moreau",
    "hets",
    "generalized-alpha step=1e-4",
    "moreau step=1e-4",
];

const STEPS: [f64; 2] = [1e-3, 1e-2];

fn smooth() -> Vec<(&'static str, Json)> {
    let link =
        json!({"m": 2.0, "inertia": 0.3, "length": 1.1, "angle0": 0.7, "rate0": 1.3, "vx0": 0.4});
    let hanging = json!({"m": 2.0, "inertia": 0.3, "length": 1.1, "offset": 0.1, "angle0": 0.7, "spring": 3.0, "damping": 0.4});
    let body = json!({
        "m": 1.3, "j1": 0.021, "j2": 0.027, "j3": 0.034, "start_x": 0.1, "start_y": -0.05, "start_z": -0.17, "end_x": -0.2,
        "end_y": 0.07, "rx0": 0.75, "ry0": 0.27, "rz0": -0.95, "omega1_0": 1.0, "omega2_0": -2.0, "omega3_0": 0.5
    });
    let motor = json!({
        "inertia": 0.01, "resistance": 1.2, "inductance": 0.02, "back_emf": 0.3, "torque_constant": 0.3, "crank": 0.2,
        "friction": 0.01, "angle0": 0.4, "rate0": 2.0
    });
    vec![
        ("oscillator", json!({"m": 2.0})),
        (
            "oscillator",
            json!({"m": 2.0, "c": 1000.0, "d": 10.0, "v0": 1.0, "partner_stiffness": 100.0}),
        ),
        ("pendulum", hanging),
        ("planar-body", link),
        ("spatial-body", body),
        ("dc-motor", motor),
        (
            "pi-controller",
            json!({"proportional": 2.0, "integral": 30.0}),
        ),
        ("planar-multibody", two_links("minimal")),
        ("planar-multibody", two_links("absolute")),
        ("planar-multibody", undriven()),
        ("spatial-multibody", top("minimal")),
        ("spatial-multibody", top("absolute")),
    ]
}

/// Two links on hinges and a spring; the second one has a marker that is turned.
fn two_links(formulation: &str) -> Json {
    json!({
        "formulation": formulation, "gravity": [0.7, -9.3],
        "body.upper.m": 1.3, "body.upper.inertia": 0.17, "body.upper.position": [0.6, -0.8], "body.upper.angle": 0.3,
        "body.lower.m": 0.7, "body.lower.inertia": 0.09, "body.lower.position": [1.5, -1.7],
        "joint.hinge.kind": "revolute", "joint.hinge.a": "ground", "joint.hinge.b": "upper", "joint.hinge.point": [0.0, 0.0],
        "joint.knee.kind": "revolute", "joint.knee.a": "upper", "joint.knee.b": "lower", "joint.knee.point": [1.2, -1.6],
        "spring.s.a": "ground", "spring.s.b": "lower", "spring.s.stiffness": 40.0, "spring.s.damping": 1.0,
        "marker.tip.body": "lower", "marker.tip.point": [0.3, -0.1], "marker.tip.angle": 0.4, "marker.middle.body": "upper"
    })
}

/// Two links that nothing drives.
pub fn undriven() -> Json {
    let mut parameters = two_links("minimal");
    let all = parameters.as_object_mut().unwrap();
    all.retain(|name, _| !name.starts_with("marker."));
    parameters
}

/// A top on a spherical joint.
fn top(formulation: &str) -> Json {
    json!({
        "formulation": formulation,
        "body.top.m": 1.3, "body.top.inertia": [0.021, 0.027, 0.034], "body.top.position": [0.1, 0.2, 0.3],
        "body.top.attitude": [0.9, 0.3, -0.2, 0.1],
        "joint.tip.kind": "spherical", "joint.tip.a": "ground", "joint.tip.b": "top", "joint.tip.point": [0.0, 0.0, 0.0],
        "marker.head.body": "top", "marker.head.point": [0.1, 0.0, 0.2], "marker.head.attitude": [0.7, 0.7, 0.1, 0.0]
    })
}

fn nonsmooth() -> Vec<(&'static str, Json)> {
    vec![
        ("slider-crank", json!({})),
        (
            "slider-crank",
            json!({"omega1_0": 150.0, "omega2_0": -75.0}),
        ),
        ("mass-chain", json!({})),
        ("bouncing-ball", json!({})),
        ("bouncing-ball", json!({"height0": 0.0, "speed0": -1.0})),
        ("block", json!({})),
        ("block", json!({"gap0": 1.0, "tilt0": 0.3, "rate0": 2.0})),
        (
            "block",
            json!({"slope": 0.6, "friction": 0.1, "speed0": -0.5}),
        ),
        ("woodpecker", json!({})),
    ]
}

#[test]
fn smooth_models_are_not_accused() {
    accuse_none(smooth(), &SMOOTH);
    let stiff = json!({"m": 0.01, "c": 1e6, "d": 1.0, "x0": 0.01, "v0": 1.0});
    let exact = json!({"m": 2.0, "c": 1000.0, "d": 10.0, "v0": 1.0});
    accuse_none(vec![("oscillator", exact)], &["exact"]);
    // Explicit solvers need steps that are short against its period.
    accuse_none(
        vec![("oscillator", stiff)],
        &["exact", "radau5", "rk4 step=1e-5"],
    );
}

#[test]
fn models_with_contacts_are_not_accused() {
    accuse_none(nonsmooth(), &NONSMOOTH);
    // Its rod is too stiff for the explicit schemes.
    let flexible = json!({"elements": 4, "omega1_0": 15.0, "omega2_0": -7.5});
    accuse_none(
        vec![("slider-crank", flexible)],
        &["", "newmark-alpha", "bathe", "ed-alpha"],
    );
}

fn accuse_none(subjects: Vec<(&str, Json)>, solvers: &[&str]) {
    let mut accused = Vec::new();
    for (model, parameters) in subjects {
        for solver in solvers {
            let settings = settings(model, &parameters, solver, &STEPS);
            let report = examine(built_in(), &settings);
            let warned = report.names(Grade::Warn);
            println!("{model:<18}{solver:<28}warnings {warned:?}");
            if !report.is_sound() {
                accused.push(format!("{model} {parameters} {solver}\n{report}"));
            }
        }
    }
    assert!(
        accused.is_empty(),
        "{} accused\n{}",
        accused.len(),
        accused.join("\n")
    );
}
