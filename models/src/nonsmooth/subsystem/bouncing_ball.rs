//! The model `bouncing-ball`: a ball above a floor, with Newton's law of impact.

use std::f64::consts::TAU;
use std::sync::Arc;

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;

use super::face::{Coordinate, Face, FaceContact, FaceMarker};
use super::keys::{Key, Parameters, number};
use super::model::{NonsmoothModel, Seen, Started, started};
use super::observed::{Motion, Observer, PointMotion};
use crate::mechanics::describe::input;
use crate::nonsmooth::system::MechanicalSystem;
use crate::nonsmooth::systems::point_mass;

/// A ball that bounces on a floor until it rests.
pub const BOUNCING_BALL: NonsmoothModel = NonsmoothModel {
    name: "bouncing-ball",
    what: "Ball above a floor at the height 0; it bounces with Newton's coefficient of restitution",
    keys: KEYS,
    seen,
    start,
};

const KEYS: &[Key] = &[
    number("m", "kg", 1.0, "mass, greater than 0"),
    number(
        "gravity",
        "m/s^2",
        9.81,
        "acceleration of gravity towards the floor",
    ),
    number(
        "height0",
        "m",
        1.0,
        "height of the lowest point at the start, 0 or greater",
    ),
    number(
        "speed0",
        "m/s",
        0.0,
        "velocity at the start, upwards positive",
    ),
    number(
        "restitution",
        "1",
        0.7,
        "Newton's coefficient of restitution, 0 to 1",
    ),
    number(
        "radius",
        "m",
        0.05,
        "radius of the ball in the animation only, 0 or greater",
    ),
];

fn seen(parameters: &Parameters<'_>) -> Seen {
    Ok((face(), ball(parameters)?.contacts().to_vec()))
}

fn start(parameters: &Parameters<'_>, setup: &Setup) -> Started {
    let system = Arc::new(ball(parameters)?);
    let picture = Picture {
        radius: parameters.non_negative("radius")?,
    };
    let height = parameters.non_negative("height0")?;
    let speed = parameters.number("speed0")?;
    started(system, picture, &face(), [&[height], &[speed]], setup)
}

fn ball(parameters: &Parameters<'_>) -> Result<point_mass::BouncingBall, SetupError> {
    Ok(point_mass::BouncingBall::new(
        parameters.positive("m")?,
        parameters.number("gravity")?,
        parameters.restitution("restitution")?,
    ))
}

/// Sides of the polygon that is drawn for the ball.
const SIDES: usize = 16;
/// Its corners; the last one is the first, so that it is closed.
const CORNERS: usize = SIDES + 1;
/// Half the length of the floor over the radius of the ball.
const FLOOR: f64 = 4.0;

fn face() -> Face {
    let mut markers = vec![FaceMarker {
        has_rates: true,
        ..FaceMarker::drawn("ball")
    }];
    markers.extend((1..=CORNERS).map(|corner| FaceMarker::drawn(&format!("circle{corner}"))));
    markers.extend((1..=2).map(|end| FaceMarker::drawn(&format!("floor{end}"))));
    Face {
        coordinates: vec![Coordinate::length(
            "height",
            "speed",
            "height of the lowest point above the floor",
        )],
        contacts: vec![FaceContact::at_point("ball")],
        inputs: vec![input("force", "N", "force on the ball, upwards positive")],
        markers,
        ..Face::default()
    }
}

/// Where markers are: the ball's lowest point, its circle, the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Picture {
    radius: f64,
}

impl Observer for Picture {
    fn marker(&self, marker: usize, motion: Motion<'_>) -> PointMotion {
        let &[height] = motion.q else {
            return [[f64::NAN; 3]; 3];
        };
        let radius = self.radius;
        match marker {
            0 => [height, motion.v[0], motion.a[0]].map(|value| [0.0, value, 0.0]),
            1..=CORNERS => {
                let (sin, cos) = (TAU * (marker - 1) as f64 / SIDES as f64).sin_cos();
                still([radius * sin, height + radius * (1.0 - cos)])
            }
            _ if marker == CORNERS + 1 => still([-FLOOR * radius, 0.0]),
            _ => still([FLOOR * radius, 0.0]),
        }
    }
}

/// A place without an angle and without rates.
fn still([x, y]: [f64; 2]) -> PointMotion {
    [[x, y, 0.0], [0.0; 3], [0.0; 3]]
}
