//! What can be told about a scene when only some of its workers can be asked.

use linchpin_proto::v1;

use super::discover::{find_variable, marker_of, model_of, recorded_outputs};
use super::forward_only;
use super::options::Connect;
use super::refusal::{Refusals, refuse_setup};
use super::start::connect_one;
use crate::error::RunError;
use crate::scene::{self, Scene};

/// Checks the subsystems that `can_be_asked`, each by itself: its model, parameters and solver, and the markers, outputs and inputs
/// that joints, connections and results name of it. What the others have, and whether the parts fit together, stays open.
///
/// # Errors
/// Mistakes in the scene; a worker that fails.
pub fn check_some(
    scene: &Scene,
    can_be_asked: impl Fn(&scene::Subsystem) -> bool,
    connect: &mut Connect<'_>,
) -> Result<(), RunError> {
    let mut refusals = Refusals::default();
    for (number, written) in scene.subsystems.iter().enumerate() {
        if can_be_asked(written)
            && let Err(error) = check_one(scene, number, connect)
        {
            refusals.collect(error)?;
        }
    }
    refusals.finish()
}

fn check_one(scene: &Scene, number: usize, connect: &mut Connect<'_>) -> Result<(), RunError> {
    let mut subsystem = connect_one(scene, number, connect)?;
    let model = model_of(scene, number, &subsystem)?;
    forward_only::refuse(scene, number, &model)?;
    let mut request = v1::InitializeRequest {
        model: model.name.clone(),
        parameters: scene.subsystems[number].parameters.clone(),
        solver: scene.subsystems[number].solver.clone(),
        t_start: scene.t_start,
        ..v1::InitializeRequest::default()
    };
    for connection in &scene.connections {
        if connection.from.0 == number {
            find_variable(scene, connection, "from", &model)?;
        }
        if connection.to.0 == number {
            find_variable(scene, connection, "to", &model)?;
            request.inputs.push(connection.to.1.clone());
        }
    }
    for joint in &scene.joints {
        for (side, end) in [(&joint.a, "a"), (&joint.b, "b")] {
            // The partner may choose among markers of several kinds.
            let mut kinds = model.markers.windows(2);
            let waits = side.marker.is_none() && kinds.any(|two| two[0].kind != two[1].kind);
            if side.subsystem == number && !waits {
                let key = format!("joint.{}.{end}", joint.name);
                request
                    .inputs
                    .extend(marker_of(scene, &key, (side, None), &model)?.load);
            }
        }
    }
    request.inputs.sort();
    request.inputs.dedup();
    check_recorded(scene, number, &model)?;
    subsystem
        .initialize(request)
        .map_err(|error| refuse_setup(scene, number, &model, &subsystem, error))
}

/// Checks the outputs of one subsystem that are to be recorded.
fn check_recorded(scene: &Scene, number: usize, model: &v1::Model) -> Result<(), RunError> {
    let prefix = format!("{}.", scene.subsystems[number].name);
    let mut own = scene.clone();
    if let Some(variables) = &mut own.output.variables {
        variables.retain(|variable| variable.starts_with(&prefix));
    }
    let mut models = vec![v1::Model::default(); scene.subsystems.len()];
    models[number] = model.clone();
    let nothing = vec![Vec::new(); models.len()];
    recorded_outputs(&own, &models, &nothing).map(|_| ())
}
