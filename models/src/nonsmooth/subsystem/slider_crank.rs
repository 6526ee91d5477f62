//! The model `slider-crank`: crank, rod and slider in a notch with clearance, rigid or with a flexible rod.
//!
//! * [`parameters`]: what a scene gives; [`face`]: what a master sees;
//! * [`rigid`], [`flexible`]: outputs and markers of the two systems; [`picture`]: markers that are only drawn.

pub mod face;
mod flexible;
pub mod parameters;
pub mod picture;
pub mod rigid;

use std::sync::Arc;

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;

use super::keys::{Parameters, refused};
use super::model::{NonsmoothModel, Seen, Started, started};
use crate::nonsmooth::system::{Contact, MechanicalSystem};
use crate::nonsmooth::systems::flexible_slider_crank::FlexibleSliderCrank;
use crate::nonsmooth::systems::rigid_slider_crank::RigidSliderCrank;
use face::face;
use flexible::Flexible;
use parameters::{KEYS, START, mechanism, numbers};
use picture::{Picture, drawn};
use rigid::Rigid;

/// The slider-crank mechanism of Flores, Leine & Glocker and of S2.
pub const SLIDER_CRANK: NonsmoothModel = NonsmoothModel {
    name: "slider-crank",
    what: "Slider-crank mechanism, rigid or with a flexible rod; the slider impacts and rubs in its notch",
    keys: KEYS,
    seen,
    start,
};

/// Only what a scene needs is assembled.
enum System {
    Rigid(Rigid),
    Flexible(Flexible),
}

impl System {
    fn of(parameters: &Parameters<'_>) -> Result<Self, SetupError> {
        let (mechanism, guide) = (mechanism(parameters)?, parameters::guide(parameters)?);
        let picture = Picture::new(
            mechanism.notch,
            mechanism.lengths,
            parameters::magnifications(parameters)?,
            guide,
        );
        let drawn = drawn(guide, parameters::elements(parameters)?);
        let drawn = drawn.into_iter().map(|(_, drawn)| drawn).collect();
        Ok(match parameters::flexible(parameters, &mechanism)? {
            None => Self::Rigid(Rigid {
                system: Arc::new(RigidSliderCrank::new(mechanism, guide)),
                picture,
                drawn,
            }),
            Some(flexible) => {
                let system = FlexibleSliderCrank::new(flexible, guide);
                Self::Flexible(Flexible {
                    system: Arc::new(system.map_err(|error| refused("elements", error))?),
                    picture,
                    drawn,
                })
            }
        })
    }

    fn contacts(&self) -> &[Contact] {
        match self {
            Self::Rigid(rigid) => rigid.system.contacts(),
            Self::Flexible(flexible) => flexible.system.contacts(),
        }
    }
}

fn seen(parameters: &Parameters<'_>) -> Seen {
    let face = face(parameters)?;
    Ok((face, System::of(parameters)?.contacts().to_vec()))
}

fn start(parameters: &Parameters<'_>, setup: &Setup) -> Started {
    let face = face(parameters)?;
    let [q, v] = [
        numbers(parameters, START[0])?,
        numbers(parameters, START[1])?,
    ];
    match System::of(parameters)? {
        System::Rigid(rigid) => started(Arc::clone(&rigid.system), rigid, &face, [&q, &v], setup),
        System::Flexible(flexible) => {
            let (q, v) = (flexible.undeformed(q), flexible.undeformed(v));
            let system = Arc::clone(&flexible.system);
            started(system, flexible, &face, [&q, &v], setup)
        }
    }
}
