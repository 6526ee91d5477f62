//! Motor and controller against closed forms and balances.

#![allow(clippy::unwrap_used)]

mod common;

use common::body::{Body, TIGHT, difference, model};
use common::{build_model, number, polynomial};
use linchpin_worker::Inputs;
use nalgebra::{Matrix4, Vector4};
use std::collections::BTreeMap;

const INERTIA: f64 = 0.083;
const RESISTANCE: f64 = 0.43;
const INDUCTANCE: f64 = 0.031;
const BACK_EMF: f64 = 0.72;
const TORQUE_CONSTANT: f64 = 0.69;
const FRICTION: f64 = 0.057;
const CRANK: f64 = 0.31;

fn motor() -> Body {
    let parameters = [
        ("inertia", INERTIA),
        ("resistance", RESISTANCE),
        ("inductance", INDUCTANCE),
        ("back_emf", BACK_EMF),
        ("torque_constant", TORQUE_CONSTANT),
        ("friction", FRICTION),
        ("crank", CRANK),
        ("shaft_x", -0.4),
        ("shaft_y", 0.6),
        ("angle0", 1.1),
        ("rate0", -4.0),
        ("current0", 1.4),
    ];
    Body::new("dc-motor", &parameters, TIGHT)
}

/// Under a constant voltage and constant moments the motor is linear: angle, rate and current by a matrix exponential.
#[test]
fn a_motor_under_constant_loads_moves_as_its_matrix_exponential() {
    let (voltage, at_shaft, at_pin) = (3.7, 0.9, -0.4);
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        0.0, 1.0, 0.0, 0.0,
        0.0, -FRICTION / INERTIA, TORQUE_CONSTANT / INERTIA, (at_shaft + at_pin) / INERTIA,
        0.0, -BACK_EMF / INDUCTANCE, -RESISTANCE / INDUCTANCE, voltage / INDUCTANCE,
        0.0, 0.0, 0.0, 0.0,
    );
    let mut motor = motor();
    motor.drive("voltage", voltage);
    motor.drive("shaft_moment", at_shaft);
    motor.drive("pin_moment", at_pin);
    // The bearing takes it.
    motor.drive("shaft_fx", 50.0);
    motor.drive("shaft_fy", -70.0);
    for _ in 0..3 {
        motor.advance(0.13);
        let exact = (matrix * motor.t).exp() * Vector4::new(1.1, -4.0, 1.4, 1.0);
        let own = motor.read(&["angle", "rate", "current"]);
        assert!(difference(&own, &exact.as_slice()[..3]) < 1e-10, "{own:?}");
        let torque = motor.read_one("torque");
        assert!((torque - TORQUE_CONSTANT * exact[2]).abs() < 1e-10);
        let alpha = motor.read_one("shaft_alpha");
        assert!((alpha - (matrix * exact)[1]).abs() < 1e-8, "{alpha}");
    }
}

/// What voltage and loads bring is stored, or lost in the resistance, in the friction, and by the difference of the two
/// constants. The pin moves on a circle about the shaft.
#[test]
fn the_power_balance_holds() {
    let mut motor = motor();
    for (input, value) in [
        ("voltage", 5.3),
        ("pin_fx", 3.1),
        ("pin_fy", -1.7),
        ("pin_moment", 0.4),
        ("shaft_moment", -0.9),
    ] {
        motor.drive(input, value);
    }
    let names = ["stored_energy", "power", "rate", "current"];
    let pin = ["pin_x", "pin_y", "pin_vx", "pin_vy"];
    motor.advance(0.21);
    let rates = motor.rates(2e-4, |motor| {
        [motor.read(&names), motor.read(&pin)].concat()
    });
    let [_, power, rate, current, x, y, vx, vy] = rates.values[..] else {
        panic!("eight values")
    };
    assert!((power - 5.3 * current).abs() < 1e-12);
    assert!(((x + 0.4).hypot(y - 0.6) - CRANK).abs() < 1e-14);
    let loads = 3.1 * vx - 1.7 * vy + (0.4 - 0.9) * rate;
    let lost = RESISTANCE * current * current
        + FRICTION * rate * rate
        + (BACK_EMF - TORQUE_CONSTANT) * rate * current;
    let error = (rates.rates[0] - (power + loads - lost)).abs();
    assert!(error < 1e-6, "{error:e} of {}", rates.rates[0]);
}

/// `v = v0 + K_i (integral of the error)` for polynomial inputs, and the control contains the error at once.
#[test]
fn a_controller_integrates_its_error() {
    let (kp, ki, v0, length) = (-2.3, 8.1, 0.7, 0.4);
    let parameters = [("proportional", kp), ("integral", ki), ("integral0", v0)];
    let mut run = build_model(&*model("pi-controller"), &parameters, TIGHT).unwrap();
    let mut inputs = Inputs::constant(&[0.0; 2]);
    inputs.replace(0, polynomial(&[1.3, -0.4, 2.0], length));
    inputs.replace(1, polynomial(&[0.2, 3.0], length));
    run.step(common::interval(0.0, length), &inputs).unwrap();
    let integral = v0
        + ki * ((1.3 - 0.2) * length - (0.4 + 3.0) * length.powi(2) / 2.0
            + 2.0 * length.powi(3) / 3.0);
    let mut values = [0.0; 3];
    run.outputs(length, &[1.7, -0.6], &[0, 1, 2], &mut values)
        .unwrap();
    let expected = [kp * 2.3 + integral, 2.3, integral];
    assert!(
        difference(&values, &expected) < 1e-12,
        "{values:?} {expected:?}"
    );
}

/// The parameter is what the input is unless something drives it.
#[test]
fn the_setpoint_is_the_default_of_its_input() {
    let default = |parameters: &BTreeMap<_, _>| {
        let model = model("pi-controller").describe_with(parameters);
        model.map(|model| model.inputs[0].default)
    };
    let mut parameters = BTreeMap::new();
    assert_eq!(default(&parameters), Ok(Some(0.0)));
    parameters.insert("setpoint".to_owned(), number(-7.3));
    assert_eq!(default(&parameters), Ok(Some(-7.3)));
    parameters.insert("setpoint".to_owned(), number(f64::NAN));
    assert_eq!(
        default(&parameters).unwrap_err().field(),
        "parameters.setpoint"
    );
}

#[test]
fn parameters_out_of_range_are_named() {
    for (name, value) in [
        ("inertia", 0.0),
        ("resistance", -0.1),
        ("inductance", 0.0),
        ("back_emf", f64::NAN),
        ("torque_constant", f64::INFINITY),
        ("friction", -1.0),
        ("crank", -0.3),
        ("shaft_x", f64::NAN),
        ("current0", f64::NAN),
    ] {
        let mut parameters = vec![
            ("inertia", INERTIA),
            ("resistance", RESISTANCE),
            ("inductance", INDUCTANCE),
            ("back_emf", BACK_EMF),
            ("torque_constant", TORQUE_CONSTANT),
        ];
        parameters.retain(|(own, _)| *own != name);
        parameters.push((name, value));
        let error = build_model(&*model("dc-motor"), &parameters, TIGHT)
            .err()
            .unwrap();
        assert_eq!(error.field(), format!("parameters.{name}"));
        assert!(error.to_string().contains("must be"), "{error}");
    }
    for missing in ["proportional", "integral"] {
        let mut parameters = vec![("proportional", 1.0), ("integral", 2.0)];
        parameters.retain(|(own, _)| *own != missing);
        let error = build_model(&*model("pi-controller"), &parameters, TIGHT)
            .err()
            .unwrap();
        assert_eq!(error.field(), format!("parameters.{missing}"));
    }
}
