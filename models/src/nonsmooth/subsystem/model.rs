//! What nonsmooth models have in common towards a master.

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Setup, Subsystem};

use super::face::Face;
use super::keys::Parameters;
use super::observed::Observed;
use super::options;
use super::run::Run;

/// The description of a model with these parameters.
pub fn describe(
    name: &str,
    what: &str,
    parameters: &Parameters<'_>,
    system: &impl Observed,
    face: &Face,
) -> v1::Model {
    let outputs = face.outputs(system.contacts());
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
    system: impl Observed + 'static,
    face: &Face,
    start: [&[f64]; 2],
    setup: &Setup,
) -> Result<Box<dyn Subsystem>, SetupError> {
    Ok(Box::new(Run::new(system, face, start, setup)?))
}
