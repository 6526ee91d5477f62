//! The model `woodpecker`: the toy that slides down a pole, jams, and is freed by the stroke of its beak.
//!
//! * [`parameters`]: what a scene gives; [`picture`]: what a master sees.

mod parameters;
mod picture;

use std::sync::Arc;

use linchpin_worker::Setup;

use super::keys::Parameters;
use super::model::{NonsmoothModel, Seen, Started, started};
use crate::nonsmooth::system::MechanicalSystem;
use crate::nonsmooth::systems::woodpecker;
use parameters::{KEYS, pole, toy};
use picture::{Picture, face};

/// The woodpecker toy of Glocker.
pub const WOODPECKER: NonsmoothModel = NonsmoothModel {
    name: "woodpecker",
    what: "Woodpecker toy: a bird on a spring at a sleeve that slides down a pole, jams and is freed",
    keys: KEYS,
    seen,
    start,
};

fn seen(parameters: &Parameters<'_>) -> Seen {
    let system = woodpecker::Woodpecker::new(toy(parameters)?);
    Ok((face(), system.contacts().to_vec()))
}

fn start(parameters: &Parameters<'_>, setup: &Setup) -> Started {
    let toy = toy(parameters)?;
    let system = Arc::new(woodpecker::Woodpecker::new(toy));
    let [q, v] = parameters::start(parameters, &*system)?;
    let picture = Picture {
        toy,
        pole: pole(parameters)?,
    };
    started(system, picture, &face(), [&q, &v], setup)
}
