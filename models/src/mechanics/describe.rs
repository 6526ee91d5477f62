//! Parts of a model's description.

use linchpin_proto::v1;

/// An input that is 0 unless the scene drives it.
pub fn input(name: &str, unit: &str, description: &str) -> v1::Variable {
    v1::Variable {
        default: Some(0.0),
        ..output(name, unit, description)
    }
}

/// An output.
pub fn output(name: &str, unit: &str, description: &str) -> v1::Variable {
    v1::Variable {
        name: name.to_owned(),
        unit: unit.to_owned(),
        description: description.to_owned(),
        default: None,
    }
}

/// A parameter or option that the scene must give.
pub fn needed(name: &str, unit: &str, description: &str) -> v1::Parameter {
    v1::Parameter {
        name: name.to_owned(),
        unit: unit.to_owned(),
        description: description.to_owned(),
        default: None,
    }
}

/// A parameter or option with a default.
pub fn optional(name: &str, unit: &str, description: &str, default: f64) -> v1::Parameter {
    v1::Parameter {
        default: Some(default),
        ..needed(name, unit, description)
    }
}

/// A parameter that is 0 unless the scene gives it.
pub fn at_zero(name: &str, unit: &str, description: &str) -> v1::Parameter {
    optional(name, unit, description, 0.0)
}

/// The acceleration of gravity along the negative `axis`.
pub fn gravity(axis: &str) -> v1::Parameter {
    let description = format!("acceleration of gravity in the direction of -{axis}");
    optional("gravity", "m/s^2", &description, STANDARD_GRAVITY)
}

/// Acceleration of gravity (m/s^2) unless the scene gives another.
const STANDARD_GRAVITY: f64 = 9.81;

/// A state that is read as `output` and set at the start by the parameter `initial`.
pub fn state(output: &str, initial: &str) -> v1::StateVariable {
    v1::StateVariable {
        output: output.to_owned(),
        initial: initial.to_owned(),
    }
}
