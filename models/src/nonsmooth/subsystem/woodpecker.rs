//! The model `woodpecker`: the toy that slides down a pole, jams, and is freed by the stroke of its beak.
//!
//! * [`parameters`]: what a scene gives; [`picture`]: what a master sees.

mod parameters;
mod picture;

use std::collections::BTreeMap;
use std::sync::Arc;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use super::keys::Parameters;
use super::model::{describe, started};
use crate::nonsmooth::system::MechanicalSystem;
use crate::nonsmooth::systems::woodpecker;
use parameters::{KEYS, pole, start, toy};
use picture::{Picture, face};

const NAME: &str = "woodpecker";
const WHAT: &str =
    "Woodpecker toy: a bird on a spring at a sleeve that slides down a pole, jams and is freed";

/// The woodpecker toy of Glocker.
#[derive(Debug, Clone, Copy, Default)]
pub struct Woodpecker;

impl Model for Woodpecker {
    fn describe(&self) -> v1::Model {
        // The defaults are in their ranges.
        self.describe_with(&BTreeMap::new()).unwrap_or_default()
    }

    fn describe_with(
        &self,
        parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::Model, SetupError> {
        let parameters = Parameters::new(KEYS, parameters)?;
        let system = woodpecker::Woodpecker::new(toy(&parameters)?);
        Ok(describe(
            NAME,
            WHAT,
            &parameters,
            system.contacts(),
            &face(),
        ))
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let parameters = Parameters::new(KEYS, setup.all_parameters())?;
        let toy = toy(&parameters)?;
        let system = Arc::new(woodpecker::Woodpecker::new(toy));
        let [q, v] = start(&parameters, &*system)?;
        let picture = Picture {
            toy,
            pole: pole(&parameters)?,
        };
        started(system, picture, &face(), [&q, &v], setup)
    }
}
