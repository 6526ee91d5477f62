//! Parameters of the model.

use linchpin_worker::setup::SetupError;

use crate::nonsmooth::subsystem::keys::{Key, Parameters, number};
use crate::nonsmooth::subsystem::slider_crank::parameters::{key, notch};
use crate::nonsmooth::systems::rod_slider::RodWithSlider;

/// Place of the pin and angles, and their rates, at the start.
pub const START: [[&str; 4]; 2] = [
    ["x_0", "y_0", "theta2_0", "theta3_0"],
    ["vx_0", "vy_0", "omega2_0", "omega3_0"],
];

/// Defaults are those of S2 Table 1.
pub const KEYS: &[Key] = &[
    key("l2"),
    key("a"),
    key("b"),
    key("c"),
    key("m2"),
    key("m3"),
    key("j2"),
    key("j3"),
    key("gravity"),
    key("restitution"),
    key("tangential_restitution"),
    key("friction"),
    key("guide"),
    key("magnification"),
    number("x_0", "m", 0.153, "place of the pin at the start"),
    number("y_0", "m", 0.0, "place of the pin at the start"),
    key("theta2_0"),
    key("theta3_0"),
    number("vx_0", "m/s", 0.0, "velocity of the pin at the start"),
    number("vy_0", "m/s", 0.0, "velocity of the pin at the start"),
    key("omega2_0"),
    key("omega3_0"),
];

/// Length, masses, weight, notch.
pub fn bodies(parameters: &Parameters<'_>) -> Result<RodWithSlider, SetupError> {
    let positive = |name| parameters.positive(name);
    Ok(RodWithSlider {
        length: positive("l2")?,
        masses: [positive("m2")?, positive("m3")?],
        inertias: [positive("j2")?, positive("j3")?],
        gravity: parameters.number("gravity")?,
        notch: notch(parameters)?,
    })
}
