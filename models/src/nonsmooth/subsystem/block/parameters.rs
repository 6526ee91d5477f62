//! Parameters of the block.

use std::f64::consts::FRAC_PI_2;

use linchpin_worker::setup::SetupError;

use crate::nonsmooth::subsystem::keys::{Key, Parameters, absent, number, refused};
use crate::nonsmooth::systems::body_on_planes::Body;
use crate::nonsmooth::systems::notch::CornerLaw;

/// All of them.
pub const KEYS: &[Key] = &[
    number(
        "half_width",
        "m",
        0.1,
        "half the side that lies on the plane at tilt 0, greater than 0",
    ),
    number(
        "half_height",
        "m",
        0.05,
        "half the other side, greater than 0",
    ),
    number("m", "kg", 1.0, "mass, greater than 0"),
    absent(
        "inertia",
        "kg m^2",
        "moment of inertia about the centre, greater than 0; if absent the block is homogeneous",
    ),
    number("gravity", "m/s^2", 9.81, "acceleration of gravity along -y"),
    number(
        "slope",
        "rad",
        0.0,
        "angle of the plane, which contains the origin: it rises along x where positive; between -pi/2 and pi/2",
    ),
    number(
        "friction",
        "1",
        0.5,
        "Coulomb's coefficient of the corners, 0 or greater",
    ),
    number(
        "restitution",
        "1",
        0.0,
        "Newton's coefficient of the corners in normal direction, 0 to 1",
    ),
    number(
        "tangential_restitution",
        "1",
        0.0,
        "the same in tangential direction, 0 to 1",
    ),
    number(
        "way0",
        "m",
        0.0,
        "place of the centre along the plane at the start, from the origin",
    ),
    number(
        "gap0",
        "m",
        0.0,
        "distance of the lowest corner from the plane at the start, 0 or greater",
    ),
    number(
        "tilt0",
        "rad",
        0.0,
        "angle of the block against the plane at the start, counterclockwise",
    ),
    number(
        "speed0",
        "m/s",
        0.0,
        "velocity of the lowest corner along the plane at the start",
    ),
    number(
        "lift0",
        "m/s",
        0.0,
        "velocity of the lowest corner away from the plane at the start",
    ),
    number(
        "rate0",
        "rad/s",
        0.0,
        "angular velocity at the start, about the lowest corner",
    ),
    absent(
        "plane_from",
        "m",
        "where the plane begins in the animation, along it; by default somewhat behind the block",
    ),
    absent(
        "plane_to",
        "m",
        "where the plane ends in the animation, along it; by default somewhat before the block",
    ),
];

/// Half width and half height (m).
pub fn half_sizes(parameters: &Parameters<'_>) -> Result<[f64; 2], SetupError> {
    Ok([
        parameters.positive("half_width")?,
        parameters.positive("half_height")?,
    ])
}

/// Mass, moment of inertia, weight.
pub fn body(parameters: &Parameters<'_>, half: [f64; 2]) -> Result<Body, SetupError> {
    let gravity = parameters.number("gravity")?;
    let mut body = Body::rectangle(parameters.positive("m")?, half, gravity);
    if parameters.has("inertia") {
        body.inertia = parameters.positive("inertia")?;
    }
    Ok(body)
}

/// Angle of the plane (rad).
pub fn slope(parameters: &Parameters<'_>) -> Result<f64, SetupError> {
    let allowed = "it must be between -pi/2 and pi/2";
    parameters.number_in("slope", allowed, |slope| slope.abs() < FRAC_PI_2)
}

/// Laws of the corners.
pub fn law(parameters: &Parameters<'_>) -> Result<CornerLaw, SetupError> {
    Ok(CornerLaw {
        normal_restitution: parameters.restitution("restitution")?,
        tangential_restitution: parameters.restitution("tangential_restitution")?,
        friction: parameters.non_negative("friction")?,
    })
}

/// Ends of the plane as it is drawn, along it (m); by default one and a half diagonals of the block on both sides of
/// its start.
pub fn plane_ends(
    parameters: &Parameters<'_>,
    way: f64,
    [half_width, half_height]: [f64; 2],
) -> Result<[f64; 2], SetupError> {
    let margin = 3.0 * half_width.hypot(half_height);
    let end = |name: &str, default: f64| {
        if parameters.has(name) {
            parameters.number(name)
        } else {
            Ok(default)
        }
    };
    let [from, to] = [
        end("plane_from", way - margin)?,
        end("plane_to", way + margin)?,
    ];
    if from >= to {
        let reason = format!("the plane would end at {to} m, where it has not begun");
        return Err(refused("plane_from", reason));
    }
    Ok([from, to])
}
