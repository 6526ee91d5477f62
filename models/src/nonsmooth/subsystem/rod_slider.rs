//! The model `rod-slider`: rod and slider of a slider-crank whose crank is another subsystem, joined at the pin.
//!
//! * [`parameters`]: what a scene gives; [`face`]: what a master sees.

mod face;
mod parameters;

use std::sync::Arc;

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;

use super::keys::Parameters;
use super::model::{NonsmoothModel, Seen, Started, started};
use super::slider_crank::parameters::{guide, magnification, numbers};
use super::slider_crank::picture::{Picture, drawn};
use crate::nonsmooth::system::MechanicalSystem;
use crate::nonsmooth::systems::rod_slider::RodSlider;
use face::{Shown, face};
use parameters::{KEYS, START, bodies};

/// Rod and slider of the slider-crank mechanism of Flores, Leine & Glocker and of S2.
pub const ROD_SLIDER: NonsmoothModel = NonsmoothModel {
    name: "rod-slider",
    what: "Rod and slider of a slider-crank without its crank; the slider impacts and rubs in its notch",
    keys: KEYS,
    seen,
    start,
};

fn system(parameters: &Parameters<'_>) -> Result<RodSlider, SetupError> {
    Ok(RodSlider::new(bodies(parameters)?, guide(parameters)?))
}

fn seen(parameters: &Parameters<'_>) -> Seen {
    let system = system(parameters)?;
    Ok((face(parameters)?, system.contacts().to_vec()))
}

fn start(parameters: &Parameters<'_>, setup: &Setup) -> Started {
    let [q, v] = [
        numbers(parameters, START[0])?,
        numbers(parameters, START[1])?,
    ];
    let (system, guide) = (Arc::new(system(parameters)?), guide(parameters)?);
    let bodies = *system.bodies();
    let shown = Shown {
        system: Arc::clone(&system),
        picture: Picture::new(
            bodies.notch,
            // The pin goes round the origin as at the start.
            [q[0].hypot(q[1]), bodies.length],
            [magnification(parameters)?, 1.0],
            guide,
        ),
        drawn: drawn(guide, 0)
            .into_iter()
            .map(|(_, drawn)| drawn)
            .collect(),
    };
    started(system, shown, &face(parameters)?, [&q, &v], setup)
}
