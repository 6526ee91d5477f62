//! What nonsmooth models have in common towards a master.

use std::sync::Arc;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Setup, Subsystem};

use super::face::Face;
use super::keys::Parameters;
use super::observed::Observer;
use super::options;
use super::run::Run;
use crate::nonsmooth::system::{Contact, MechanicalSystem};

/// The description of a model with these parameters.
pub fn describe(
    name: &str,
    what: &str,
    parameters: &Parameters<'_>,
    contacts: &[Contact],
    face: &Face,
) -> v1::Model {
    let outputs = face.outputs(contacts);
    v1::Model {
        name: name.to_owned(),
        description: what.to_owned(),
        inputs: face.inputs.clone(),
        outputs: outputs.into_iter().map(|(_, variable)| variable).collect(),
        parameters: parameters.described(),
        markers: face.markers(),
        solvers: options::descriptions(),
        states: Vec::new(),
        capabilities: Some(v1::Capabilities {
            repeats_step_sequence: true,
            ..v1::Capabilities::default()
        }),
    }
}

/// A system as a subsystem at its start.
pub fn started(
    system: Arc<impl MechanicalSystem + Sync + 'static>,
    observer: impl Observer + 'static,
    face: &Face,
    start: [&[f64]; 2],
    setup: &Setup,
) -> Result<Box<dyn Subsystem>, SetupError> {
    let run = Run::new(system, Box::new(observer), face, start, setup)?;
    Ok(Box::new(run))
}
