//! What a master sees of rod and slider.

use std::sync::Arc;

use linchpin_worker::setup::SetupError;

use crate::mechanics::describe::input;
use crate::nonsmooth::subsystem::face::{Coordinate, Face, FaceMarker};
use crate::nonsmooth::subsystem::keys::Parameters;
use crate::nonsmooth::subsystem::observed::{Motion, Observer, PointMotion};
use crate::nonsmooth::subsystem::slider_crank::face::{contacts, slider_share};
use crate::nonsmooth::subsystem::slider_crank::parameters::guide;
use crate::nonsmooth::subsystem::slider_crank::picture::{Drawn, Picture, drawn};
use crate::nonsmooth::subsystem::slider_crank::rigid::{along, share_of, with_angle};
use crate::nonsmooth::systems::rod_slider::RodSlider;

/// Markers with rates: pin, slider.
const MOVING: usize = 2;

/// Load of the pin.
const LOAD: [[&str; 3]; 3] = [
    ["pin_fx", "N", "force on the rod at the pin in x"],
    ["pin_fy", "N", "force on the rod at the pin in y"],
    ["pin_moment", "N m", "moment on the rod"],
];

/// Names, units and numbers of everything.
pub fn face(parameters: &Parameters<'_>) -> Result<Face, SetupError> {
    let guide = guide(parameters)?;
    let moving = |name: &str, load: &[[&str; 3]]| FaceMarker {
        name: name.to_owned(),
        load: load.iter().map(|[name, ..]| (*name).to_owned()).collect(),
        has_rates: true,
    };
    let mut markers = vec![moving("pin", &LOAD), moving("slider", &[])];
    let drawn = drawn(guide, 0).into_iter();
    markers.extend(drawn.map(|(name, _)| FaceMarker::drawn(&name)));
    Ok(Face {
        coordinates: vec![
            Coordinate::length("x", "vx", "place of the pin"),
            Coordinate::length("y", "vy", "place of the pin"),
            Coordinate::angle("theta2", "omega2", "angle of the rod from the x axis"),
            Coordinate::angle("theta3", "omega3", "angle of the slider"),
        ],
        contacts: contacts(guide),
        inputs: LOAD
            .map(|[name, unit, what]| input(name, unit, what))
            .to_vec(),
        own: vec![slider_share()],
        markers,
    })
}

/// Rod and slider with their picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Shown {
    /// The system.
    pub system: Arc<RodSlider>,
    /// How it is drawn.
    pub picture: Picture,
    /// What is drawn.
    pub drawn: Vec<Drawn>,
}

impl Observer for Shown {
    fn own_output(&self, _output: usize, motion: Motion<'_>) -> f64 {
        let [_, y] = self.system.slider(motion.q);
        share_of(y, self.system.bodies().notch.clearance)
    }

    fn marker(&self, marker: usize, motion: Motion<'_>) -> PointMotion {
        let turn = |place: usize| [motion.q[place], motion.v[place], motion.a[place]];
        let pin = [motion.q, motion.v, motion.a].map(|level| [level[0], level[1], 0.0]);
        let slider = || along(pin, self.system.bodies().length, turn(2));
        match marker {
            0 => with_angle(pin, turn(2)),
            1 => with_angle(slider(), turn(3)),
            _ => {
                let centre = with_angle(slider(), turn(3))[0];
                let place = |drawn: &Drawn| self.picture.place(*drawn, centre);
                let drawn = self.drawn.get(marker - MOVING);
                [drawn.map_or(centre, place), [0.0; 3], [0.0; 3]]
            }
        }
    }
}
