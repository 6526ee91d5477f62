//! The mechanism with a flexible rod: outputs and markers.

use std::sync::Arc;

use super::face::MOVING;
use super::picture::{Drawn, Picture};
use super::rigid::{along, share_of, with_angle};
use crate::nonsmooth::subsystem::observed::{Motion, Observer, PointMotion};
use crate::nonsmooth::system::MechanicalSystem;
use crate::nonsmooth::systems::flexible_slider_crank::FlexibleSliderCrank;

/// A flexible mechanism with its picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Flexible {
    /// The mechanism.
    pub system: Arc<FlexibleSliderCrank>,
    /// How it is drawn.
    pub picture: Picture,
    /// What is drawn.
    pub drawn: Vec<Drawn>,
}

impl Flexible {
    /// All coordinates from the three angles: the rod is not deformed.
    pub fn undeformed(&self, angles: [f64; 3]) -> Vec<f64> {
        let mut all = vec![0.0; self.system.shape().order()];
        all[..3].copy_from_slice(&angles);
        all
    }

    fn slider(&self, motion: Motion<'_>) -> PointMotion {
        let Motion { q, v, a } = motion;
        let [x, y] = self.system.slider(q);
        let [vx, vy] = self.system.slider_velocity(q, v);
        let [ax, ay] = self.system.slider_acceleration(q, v, a);
        [[x, y, q[2]], [vx, vy, v[2]], [ax, ay, a[2]]]
    }
}

impl Observer for Flexible {
    fn own_output(&self, output: usize, motion: Motion<'_>) -> f64 {
        let q = motion.q;
        match output {
            0 => {
                let clearance = self.system.mechanism().notch.clearance;
                let [_, y] = self.system.slider(q);
                share_of(y, clearance)
            }
            1 => self.system.end_displacement(q)[0],
            2 => self.system.end_displacement(q)[1],
            _ => self.system.root_moment(q),
        }
    }

    fn marker(&self, marker: usize, motion: Motion<'_>) -> PointMotion {
        let [crank, _] = self.picture.lengths;
        let turn = |place: usize| [motion.q[place], motion.v[place], motion.a[place]];
        let still = [[0.0; 3]; 3];
        let pin = || along(still, crank, turn(0));
        match marker {
            0 => with_angle(still, turn(0)),
            1 => with_angle(pin(), turn(1)),
            2 => self.slider(motion),
            _ => {
                let [x, y] = self.system.slider(motion.q);
                let centre = [x, y, motion.q[2]];
                let place = match self.drawn.get(marker - MOVING) {
                    Some(&Drawn::Node(node)) => {
                        let [x, y] = self.system.node(motion.q, node, self.picture.bending);
                        [x, y, motion.q[1]]
                    }
                    Some(&drawn) => self.picture.place(drawn, centre),
                    None => centre,
                };
                [place, [0.0; 3], [0.0; 3]]
            }
        }
    }
}
