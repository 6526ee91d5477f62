//! The rigid mechanism: outputs and markers.

use std::sync::Arc;

use super::face::MOVING;
use super::picture::{Drawn, Picture};
use crate::nonsmooth::subsystem::observed::{Motion, Observer, PointMotion};
use crate::nonsmooth::systems::rigid_slider_crank::RigidSliderCrank;

/// A rigid mechanism with its picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Rigid {
    /// The mechanism.
    pub system: Arc<RigidSliderCrank>,
    /// How it is drawn.
    pub picture: Picture,
    /// What is drawn.
    pub drawn: Vec<Drawn>,
}

impl Observer for Rigid {
    fn own_output(&self, _output: usize, motion: Motion<'_>) -> f64 {
        let clearance = self.system.mechanism().notch.clearance;
        let [_, y] = self.system.slider(motion.q);
        share_of(y, clearance)
    }

    fn marker(&self, marker: usize, motion: Motion<'_>) -> PointMotion {
        let lengths = self.system.mechanism().lengths;
        let turn = |place: usize| [motion.q[place], motion.v[place], motion.a[place]];
        let still = [[0.0; 3]; 3];
        let pin = || along(still, lengths[0], turn(0));
        let slider = || along(pin(), lengths[1], turn(1));
        match marker {
            0 => with_angle(still, turn(0)),
            1 => with_angle(pin(), turn(1)),
            2 => with_angle(slider(), turn(2)),
            _ => {
                let centre = with_angle(slider(), turn(2))[0];
                let place = |drawn: &Drawn| self.picture.place(*drawn, centre);
                let drawn = self.drawn.get(marker - MOVING);
                [drawn.map_or(centre, place), [0.0; 3], [0.0; 3]]
            }
        }
    }
}

/// A height as a share of the clearance; itself without clearance.
pub fn share_of(y: f64, clearance: f64) -> f64 {
    if clearance > 0.0 { y / clearance } else { y }
}

/// The motion of a point at `length` in the direction of an angle from another point.
pub fn along(from: PointMotion, length: f64, [angle, rate, acceleration]: [f64; 3]) -> PointMotion {
    let (sin, cos) = angle.sin_cos();
    let [mut position, mut velocity, mut second] = from;
    position[0] += length * cos;
    position[1] += length * sin;
    velocity[0] -= length * sin * rate;
    velocity[1] += length * cos * rate;
    second[0] -= length * (sin * acceleration + cos * rate * rate);
    second[1] += length * (cos * acceleration - sin * rate * rate);
    [position, velocity, second]
}

/// The same with an angle.
pub fn with_angle(mut motion: PointMotion, turn: [f64; 3]) -> PointMotion {
    for (level, turn) in motion.iter_mut().zip(turn) {
        level[2] = turn;
    }
    motion
}
