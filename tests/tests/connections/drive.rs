//! Motor and controller alone: no joint, no multiplier. The drive is linear, so its motion is a matrix exponential.

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;
use nalgebra::{Matrix4, Vector4};

use crate::{TIGHT, error_of};
use linchpin_tests::convergence::assert_all_orders;

const INERTIA: f64 = 0.083;
const RESISTANCE: f64 = 0.43;
const INDUCTANCE: f64 = 0.031;
const BACK_EMF: f64 = 0.72;
const TORQUE_CONSTANT: f64 = 0.69;
const FRICTION: f64 = 0.057;
const PROPORTIONAL: f64 = 1.3;
const INTEGRAL: f64 = 8.1;
const SETPOINT: f64 = 7.0;
/// Rate, current and integral part of the control at the start.
const START: [f64; 3] = [1.9, 1.4, -0.2];

pub fn text() -> String {
    let [rate, current, integral] = START;
    format!(
        r#"
[scene]
name = "drive"
t_end = 0.5
[coupling]
method = "weighted"
macro_step = 1e-2
[[subsystem]]
name = "controller"
model = "pi-controller"
parameters = {{ setpoint = {SETPOINT:?}, proportional = {PROPORTIONAL}, integral = {INTEGRAL}, integral0 = {integral} }}
[[subsystem]]
name = "motor"
model = "dc-motor"
parameters = {{ inertia = {INERTIA}, resistance = {RESISTANCE}, inductance = {INDUCTANCE}, back_emf = {BACK_EMF}, torque_constant = {TORQUE_CONSTANT}, friction = {FRICTION}, rate0 = {rate}, current0 = {current} }}
[[connection]]
name = "speed"
from = "motor.rate"
to = "controller.measured"
[[connection]]
name = "voltage"
from = "controller.control"
to = "motor.voltage"
[output]
variables = ["motor.current", "controller.integral"]
"#
    )
}

/// The two subsystems alone.
pub fn without_connections() -> String {
    let text = text();
    let (head, tail) = text.split_once("[[connection]]").unwrap();
    let (_, output) = tail.split_once("[output]").unwrap();
    format!("{head}[output]{output}")
}

fn scene(coupling: &str) -> Scene {
    with_settings(&text(), coupling, &[TIGHT])
}

/// Rate, current, integral part and control at times `t`.
fn exact(times: &[f64]) -> Vec<[f64; 4]> {
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        -FRICTION / INERTIA, TORQUE_CONSTANT / INERTIA, 0.0, 0.0,
        -(PROPORTIONAL + BACK_EMF) / INDUCTANCE, -RESISTANCE / INDUCTANCE, 1.0 / INDUCTANCE, PROPORTIONAL * SETPOINT / INDUCTANCE,
        -INTEGRAL, 0.0, 0.0, INTEGRAL * SETPOINT,
        0.0, 0.0, 0.0, 0.0,
    );
    let start = Vector4::new(START[0], START[1], START[2], 1.0);
    let at = |t: &f64| {
        let state = (matrix * *t).exp() * start;
        let control = PROPORTIONAL * (SETPOINT - state[0]) + state[2];
        [state[0], state[1], state[2], control]
    };
    times.iter().map(at).collect()
}

const COLUMNS: [&str; 4] = [
    "motor.rate",
    "motor.current",
    "controller.integral",
    "controller.control",
];

/// Errors of the states, and of the control.
fn errors(trajectory: &Trajectory) -> [f64; 2] {
    let exact = exact(&trajectory.column("t"));
    let pair = |place: usize| {
        let exact = exact.iter().map(|row| row[place]).collect();
        (trajectory.column(COLUMNS[place]), exact)
    };
    [error_of(&[0, 1, 2].map(pair)), error_of(&[pair(3)])]
}

/// Polynomials of degree k interpolate the signals with errors of order k + 1; the first step limits that to 3.
#[test]
fn orders_of_convergence() {
    let cases = [
        ("method=weighted exchanged_degree=0", [1.0; 2]),
        ("method=weighted exchanged_degree=1", [2.0; 2]),
        ("method=weighted exchanged_degree=2", [3.0; 2]),
        ("method=weighted exchanged_degree=3", [3.0; 2]),
        ("method=baumgarte exchanged_degree=2", [3.0; 2]),
    ];
    assert_all_orders(&cases, &[5e-3, 2.5e-3, 1.25e-3, 6.25e-4], |coupling, h| {
        let coupling = format!("{coupling} macro_step={h}");
        errors(&run(&scene(&coupling), Place::InProcess))
    });
}

/// The first corrector is linear for every degree above 0, which leaves an error of order 3 in the states.
#[test]
fn orders_after_the_first_step() {
    let cases = [
        ("exchanged_degree=0", [2.0]),
        ("exchanged_degree=1", [3.0]),
        ("exchanged_degree=2", [3.0]),
        ("exchanged_degree=3", [3.0]),
    ];
    assert_all_orders(&cases, &[1e-3, 5e-4, 2.5e-4, 1.25e-4], |coupling, h| {
        let end = format!("scene.t_end={h}");
        let coupling = format!("{coupling} macro_step={h}");
        let scene = with_settings(&text(), &coupling, &[TIGHT, &end]);
        let [states, _] = errors(&run(&scene, Place::InProcess));
        [states]
    });
}

/// There are no joints, so no level of their conditions matters.
#[test]
fn index_and_method_make_no_difference() {
    let expected = run(
        &scene("method=weighted exchanged_degree=2"),
        Place::InProcess,
    );
    for coupling in [
        "method=weighted index=3",
        "method=weighted index=2 a=1",
        "method=baumgarte index=1 beta=0.2 gamma=0.01",
        "method=baumgarte index=3 degree=0",
    ] {
        let found = run(
            &scene(&format!("{coupling} exchanged_degree=2")),
            Place::InProcess,
        );
        let control = [&found, &expected].map(|run| run.column("controller.control"));
        for (found, expected) in control[0].iter().zip(&control[1]) {
            assert!((found - expected).abs() < 1e-11, "{coupling}");
        }
    }
}

/// Signals are extrapolated; in the first step they are held, which leaves an error of order 2 in the states.
#[test]
fn penalty_coupling_extrapolates_signals() {
    let cases = [
        ("method=penalty stiffness=1 exchanged_degree=0", [1.0]),
        ("method=penalty stiffness=1 exchanged_degree=1", [2.0]),
        ("method=penalty stiffness=1 exchanged_degree=2", [2.0]),
        (
            "method=penalty order=gauss-seidel stiffness=1 exchanged_degree=2",
            [2.0],
        ),
    ];
    assert_all_orders(&cases, &[2e-3, 1e-3, 5e-4, 2.5e-4], |coupling, h| {
        let scene = scene(&format!("{coupling} macro_step={h}"));
        let [states, _] = errors(&run(&scene, Place::InProcess));
        [states]
    });
}

/// The explicit method holds the signals over every step.
#[test]
fn the_explicit_method_has_order_one() {
    let cases = [("method=explicit mu=10H", [1.0; 2])];
    assert_all_orders(&cases, &[2e-3, 1e-3, 5e-4, 2.5e-4], |coupling, h| {
        let coupling = format!("{coupling} macro_step={h}");
        errors(&run(&scene(&coupling), Place::InProcess))
    });
}

/// The control at the start contains the error of the rate at once.
#[test]
fn the_first_row_is_consistent() {
    for coupling in ["method=weighted", "method=explicit mu=10H"] {
        let first = run(&scene(coupling), Place::InProcess);
        let control = first.column("controller.control")[0];
        let expected = PROPORTIONAL * (SETPOINT - START[0]) + START[2];
        assert!((control - expected).abs() < 1e-13, "{control} {expected}");
    }
}

/// Nobody reads the motor, and nothing drives the controller: its control is a ramp, which a polynomial of degree 2 repeats
/// exactly and the explicit method holds over every step.
#[test]
fn a_signal_that_only_goes_forward() {
    let text = text();
    let (head, tail) = text.split_once("[[connection]]").unwrap();
    let (_, tail) = tail.split_once("[[connection]]").unwrap();
    let text = format!("{head}[[connection]]{tail}");
    let record = "output.variables=[\"motor.rate\"]";
    let ramp = |t: f64| SETPOINT * (PROPORTIONAL + INTEGRAL * t) + START[2];
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        -FRICTION / INERTIA, TORQUE_CONSTANT / INERTIA, 0.0, 0.0,
        -BACK_EMF / INDUCTANCE, -RESISTANCE / INDUCTANCE, 1.0 / INDUCTANCE, 0.0,
        0.0, 0.0, 0.0, SETPOINT * INTEGRAL,
        0.0, 0.0, 0.0, 0.0,
    );
    let start = Vector4::new(START[0], START[1], ramp(0.0), 1.0);
    for (coupling, worst) in [("method=weighted", 1e-9), ("method=explicit mu=10H", 0.5)] {
        let scene = with_settings(&text, coupling, &[TIGHT, record]);
        let forward = run(&scene, Place::InProcess);
        let columns = ["t", "controller.control", "motor.rate"].map(|name| forward.column(name));
        for (row, t) in columns[0].iter().enumerate() {
            let exact = (matrix * *t).exp() * start;
            let [control, rate] = [columns[1][row], columns[2][row]];
            assert!((control - ramp(*t)).abs() < 1e-9, "{control} at {t}");
            assert!((rate - exact[0]).abs() < worst, "{coupling}: {rate} at {t}");
        }
    }
}

/// Subsystems that nothing couples run side by side.
#[test]
fn no_joints_and_no_connections() {
    let text = without_connections();
    for coupling in [
        "method=weighted",
        "method=explicit mu=10H",
        "method=penalty stiffness=1.0",
    ] {
        let alone = run(&with_settings(&text, coupling, &[TIGHT]), Place::InProcess);
        let integral = alone.column("controller.integral");
        let expected = START[2] + INTEGRAL * SETPOINT * 0.5;
        assert!((integral.last().unwrap() - expected).abs() < 1e-10);
    }
}
