//! What nonsmooth models have in common towards a master.

use std::collections::BTreeMap;
use std::sync::Arc;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use super::face::Face;
use super::keys::{Key, Parameters};
use super::observed::Observer;
use super::options;
use super::run::Run;
use crate::nonsmooth::system::{Contact, MechanicalSystem, Side};

/// What a master sees of a system, and its contacts.
pub type Seen = Result<(Face, Vec<Contact>), SetupError>;

/// A system at its start.
pub type Started = Result<Box<dyn Subsystem>, SetupError>;

/// A model of a mechanical system, by what it has of its own.
#[derive(Debug, Clone, Copy)]
pub struct NonsmoothModel {
    /// Its name in scenes.
    pub(super) name: &'static str,
    /// What it is.
    pub(super) what: &'static str,
    /// Its parameters.
    pub(super) keys: &'static [Key],
    /// Face and contacts with these parameters.
    pub(super) seen: fn(&Parameters<'_>) -> Seen,
    /// The system with these parameters.
    pub(super) start: fn(&Parameters<'_>, &Setup) -> Started,
}

impl Model for NonsmoothModel {
    fn describe(&self) -> v1::Model {
        // The defaults are in their ranges.
        self.describe_with(&BTreeMap::new()).unwrap_or_default()
    }

    fn describe_with(
        &self,
        parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::Model, SetupError> {
        let parameters = Parameters::new(self.keys, parameters)?;
        let (face, contacts) = (self.seen)(&parameters)?;
        let outputs = face.outputs(&contacts).into_iter();
        let mut sides = contacts.iter().map(|contact| contact.side);
        let collides = sides.any(|side| side == Side::Unilateral);
        Ok(v1::Model {
            name: self.name.to_owned(),
            description: self.what.to_owned(),
            outputs: outputs.map(|(_, variable)| variable).collect(),
            parameters: parameters.described(),
            markers: face.markers(),
            inputs: face.inputs,
            solvers: options::descriptions(),
            states: Vec::new(),
            capabilities: Some(v1::Capabilities {
                repeats_step_sequence: true,
                exportable_snapshot: true,
                impulses: !collides,
                impacts: collides,
                ..v1::Capabilities::default()
            }),
            ..v1::Model::default()
        })
    }

    fn initialize(&self, setup: &Setup) -> Started {
        let parameters = Parameters::new(self.keys, setup.all_parameters())?;
        (self.start)(&parameters, setup)
    }
}

/// A system as a subsystem at its start.
pub fn started(
    system: Arc<impl MechanicalSystem + Sync + 'static>,
    observer: impl Observer + 'static,
    face: &Face,
    start: [&[f64]; 2],
    setup: &Setup,
) -> Started {
    let run = Run::new(system, Box::new(observer), face, start, setup)?;
    Ok(Box::new(run))
}
