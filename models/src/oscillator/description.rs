//! What the model tells a master about itself.

use linchpin_proto::v1;

/// Place of the applied force among the inputs.
pub const F: usize = 0;
/// Place of the partner's position among the inputs.
pub const PARTNER_X: usize = 1;
/// Place of the partner's velocity among the inputs.
pub const PARTNER_V: usize = 2;

/// Place of the position among the outputs.
pub const X: usize = 0;
/// Place of the velocity among the outputs.
pub const V: usize = 1;
/// Place of the acceleration among the outputs.
pub const A: usize = 2;

/// Solver without error: matrix exponential.
pub const EXACT: &str = "exact";
/// Solver with step-size control: Radau IIA of order 5.
pub const RADAU5: &str = "radau5";
/// Solver with fixed steps: the classical Runge-Kutta method of order 4.
pub const RK4: &str = "rk4";
/// All solvers; the first one is the default.
pub const SOLVERS: [&str; 3] = [EXACT, RADAU5, RK4];

pub fn model() -> v1::Model {
    v1::Model {
        name: "oscillator".to_owned(),
        description: "One mass on a spring and a damper, with a second spring and damper to a partner: \
                      m a = -c x - d v + f + partner_stiffness (partner_x - x) + partner_damping (partner_v - v)"
            .to_owned(),
        inputs: inputs(),
        outputs: outputs(),
        parameters: parameters(),
        markers: vec![mass_marker()],
        solvers: solvers(),
        states: vec![state("x", "x0"), state("v", "v0")],
        capabilities: Some(v1::Capabilities {
            repeats_step_sequence: true,
            ..v1::Capabilities::default()
        }),
    }
}

fn inputs() -> Vec<v1::Variable> {
    let input = |name, unit, description| variable(name, unit, description, Some(0.0));
    vec![
        input("f", "N", "force applied to the mass"),
        input(
            "partner_x",
            "m",
            "position of the partner behind the second spring",
        ),
        input(
            "partner_v",
            "m/s",
            "velocity of the partner behind the second damper",
        ),
    ]
}

fn outputs() -> Vec<v1::Variable> {
    let output = |name, unit, description| variable(name, unit, description, None);
    vec![
        output("x", "m", "position of the mass"),
        output("v", "m/s", "velocity of the mass"),
        output(
            "a",
            "m/s^2",
            "acceleration of the mass under the present inputs",
        ),
    ]
}

fn variable(name: &str, unit: &str, description: &str, default: Option<f64>) -> v1::Variable {
    v1::Variable {
        name: name.to_owned(),
        unit: unit.to_owned(),
        description: description.to_owned(),
        default,
    }
}

fn parameters() -> Vec<v1::Parameter> {
    let at_zero = |name, unit, description| parameter(name, unit, description, Some(0.0));
    vec![
        parameter("m", "kg", "mass, greater than 0", None),
        at_zero(
            "c",
            "N/m",
            "stiffness of the spring to ground, 0 or greater",
        ),
        at_zero("d", "N s/m", "damping to ground, 0 or greater"),
        at_zero(
            "x0",
            "m",
            "position at the start; the spring is relaxed at 0",
        ),
        at_zero("v0", "m/s", "velocity at the start"),
        at_zero(
            "partner_stiffness",
            "N/m",
            "stiffness of the spring to the partner, 0 or greater",
        ),
        at_zero(
            "partner_damping",
            "N s/m",
            "damping to the partner, 0 or greater",
        ),
    ]
}

fn parameter(name: &str, unit: &str, description: &str, default: Option<f64>) -> v1::Parameter {
    v1::Parameter {
        name: name.to_owned(),
        unit: unit.to_owned(),
        description: description.to_owned(),
        default,
    }
}

fn mass_marker() -> v1::Marker {
    v1::Marker {
        name: "mass".to_owned(),
        kind: v1::MarkerKind::Scalar.into(),
        position: "x".to_owned(),
        velocity: Some("v".to_owned()),
        acceleration: Some("a".to_owned()),
        load: "f".to_owned(),
        spring: Some(v1::Spring {
            partner_position: "partner_x".to_owned(),
            partner_velocity: "partner_v".to_owned(),
            stiffness: "partner_stiffness".to_owned(),
            damping: "partner_damping".to_owned(),
        }),
    }
}

fn solvers() -> Vec<v1::SolverKind> {
    vec![
        solver(
            EXACT,
            "matrix exponential with polynomial inputs, exact up to rounding",
            vec![],
        ),
        solver(
            RADAU5,
            "Radau IIA of order 5 with step-size control; perturbed steps repeat its internal steps",
            vec![
                parameter(
                    "rtol",
                    "",
                    "relative error tolerance, greater than 0",
                    Some(1e-8),
                ),
                parameter(
                    "atol",
                    "",
                    "absolute error tolerance in m and m/s, greater than 0",
                    Some(1e-8),
                ),
            ],
        ),
        solver(
            RK4,
            "classical Runge-Kutta method of order 4 with fixed steps",
            vec![parameter(
                "step",
                "s",
                "longest internal step, greater than 0; a macro step is cut into equal parts",
                None,
            )],
        ),
    ]
}

fn solver(name: &str, description: &str, options: Vec<v1::Parameter>) -> v1::SolverKind {
    v1::SolverKind {
        name: name.to_owned(),
        description: description.to_owned(),
        options,
    }
}

fn state(output: &str, initial: &str) -> v1::StateVariable {
    v1::StateVariable {
        output: output.to_owned(),
        initial: initial.to_owned(),
    }
}
