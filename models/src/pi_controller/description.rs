//! What the model tells a master about itself.

use std::collections::BTreeMap;

use linchpin_proto::v1;
use linchpin_worker::setup::{SetupError, Values};

use crate::mechanics::describe::{at_zero, input, needed, output, state};
use crate::mechanics::solvers;

/// Place of the control among the outputs.
pub const CONTROL: usize = 0;
/// Place of the error.
pub const ERROR: usize = 1;
/// Place of the integral part.
pub const INTEGRAL: usize = 2;

/// Unit of a quantity that is up to the scene.
const ANY: &str = "any";

const SETPOINT: &str = "setpoint";

/// The model with the parameters of a scene: the parameter `setpoint` is what the input is that nothing drives.
///
/// # Errors
/// [`SetupError`] if the setpoint is not a finite number.
pub fn configured(parameters: &BTreeMap<String, v1::Value>) -> Result<v1::Model, SetupError> {
    let setpoint = match parameters.contains_key(SETPOINT) {
        true => Values::parameters(parameters).number(SETPOINT)?,
        false => 0.0,
    };
    Ok(model(setpoint))
}

/// The model with a default of the setpoint.
pub fn model(setpoint: f64) -> v1::Model {
    v1::Model {
        name: "pi-controller".to_owned(),
        description: "Proportional-integral controller without limits".to_owned(),
        inputs: vec![
            v1::Variable {
                default: Some(setpoint),
                ..input(SETPOINT, ANY, "value that is wanted")
            },
            input("measured", ANY, "value that is measured, in the same unit"),
        ],
        outputs: vec![
            output("control", ANY, "proportional part and integral part"),
            output("error", ANY, "setpoint minus measured value"),
            output("integral", ANY, "integral part of the control"),
        ],
        parameters: vec![
            needed("proportional", ANY, "control per error"),
            needed("integral", ANY, "rate of the control per error"),
            at_zero(
                SETPOINT,
                ANY,
                "value of the input setpoint unless it is connected",
            ),
            at_zero(
                "integral0",
                ANY,
                "integral part of the control at the start",
            ),
        ],
        markers: Vec::new(),
        solvers: solvers::descriptions(),
        states: vec![state("integral", "integral0")],
        capabilities: Some(v1::Capabilities {
            joint_loads: false,
            directional_derivatives: true,
            ..solvers::capabilities()
        }),
        ..v1::Model::default()
    }
}
