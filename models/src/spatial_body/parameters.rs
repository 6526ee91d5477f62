//! Parameters of the body.

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;
use nalgebra::{UnitQuaternion, Vector3};

use crate::mechanics::spatial::{BodyMotion, BodyPoint};

/// A moment of inertia may exceed the sum of the other two by this part: the rounding of a flat body's.
const ROUNDING: f64 = 1e-12;

/// Mass, inertia and markers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyParameters {
    /// Mass (kg).
    pub mass: f64,
    /// Principal moments of inertia (kg m^2).
    pub inertia: Vector3<f64>,
    /// Acceleration of gravity along -z (m/s^2).
    pub gravity: f64,
    /// Markers `start` and `end`.
    pub markers: [BodyPoint; 2],
}

/// Mass, inertia and markers of a setup.
///
/// # Errors
/// [`SetupError`] if one is missing or out of its range.
pub fn body(setup: &Setup) -> Result<BodyParameters, SetupError> {
    Ok(BodyParameters {
        mass: setup.positive_parameter("m")?,
        inertia: inertia(setup)?,
        gravity: setup.parameter("gravity")?,
        markers: [
            BodyPoint(vector(setup, ["start_x", "start_y", "start_z"])?),
            BodyPoint(vector(setup, ["end_x", "end_y", "end_z"])?),
        ],
    })
}

/// The motion at the start of a setup.
///
/// # Errors
/// [`SetupError`] if a parameter is missing or not finite.
pub fn start(setup: &Setup) -> Result<BodyMotion, SetupError> {
    let turn = vector(setup, ["rx0", "ry0", "rz0"])?;
    Ok(BodyMotion {
        position: vector(setup, ["x0", "y0", "z0"])?,
        attitude: UnitQuaternion::from_scaled_axis(turn).into_inner(),
        velocity: vector(setup, ["vx0", "vy0", "vz0"])?,
        omega: vector(setup, ["omega1_0", "omega2_0", "omega3_0"])?,
    })
}

fn vector(setup: &Setup, [x, y, z]: [&str; 3]) -> Result<Vector3<f64>, SetupError> {
    Ok(Vector3::new(
        setup.parameter(x)?,
        setup.parameter(y)?,
        setup.parameter(z)?,
    ))
}

fn inertia(setup: &Setup) -> Result<Vector3<f64>, SetupError> {
    let names = ["j1", "j2", "j3"];
    for name in names {
        setup.positive_parameter(name)?;
    }
    let inertia = vector(setup, names)?;
    let allowed = "it must not be greater than the sum of the other two moments of inertia";
    for name in names {
        setup.parameter_in(name, allowed, |own| own * (2.0 - ROUNDING) <= inertia.sum())?;
    }
    Ok(inertia)
}
