//! What the model tells a master about itself.

use linchpin_proto::v1;

use crate::mechanics::describe::{at_zero, input, needed, output, state};
use crate::mechanics::solvers::{capabilities, descriptions, kind};

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

pub fn model() -> v1::Model {
    v1::Model {
        name: "oscillator".to_owned(),
        description: "One mass on a spring and a damper, with a second spring and damper to a partner: \
                      m a = -c x - d v + f + partner_stiffness (partner_x - x) + partner_damping (partner_v - v), \
                      and + load from t = load_from on"
            .to_owned(),
        inputs: inputs(),
        outputs: outputs(),
        parameters: parameters(),
        markers: vec![mass_marker()],
        solvers: solvers(),
        states: vec![state("x", "x0"), state("v", "v0")],
        capabilities: Some(v1::Capabilities {
            joint_loads: false,
            directional_derivatives: true,
            ..capabilities()
        }),
        ..v1::Model::default()
    }
}

fn inputs() -> Vec<v1::Variable> {
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

fn parameters() -> Vec<v1::Parameter> {
    vec![
        needed("m", "kg", "mass, greater than 0"),
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
        at_zero("load", "N", "constant force on the mass from load_from on"),
        at_zero("load_from", "s", "time at which the load sets in"),
    ]
}

fn mass_marker() -> v1::Marker {
    v1::Marker {
        name: "mass".to_owned(),
        kind: v1::MarkerKind::Scalar.into(),
        position: vec!["x".to_owned()],
        velocity: vec!["v".to_owned()],
        acceleration: vec!["a".to_owned()],
        load: vec!["f".to_owned()],
    }
}

fn solvers() -> Vec<v1::SolverKind> {
    let exact = kind(
        EXACT,
        "matrix exponential with polynomial inputs, exact up to rounding",
        vec![],
    );
    std::iter::once(exact).chain(descriptions()).collect()
}
