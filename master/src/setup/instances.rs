//! Instances of the subsystems at their workers.

use linchpin_proto::v1;

use super::refusal::{Refusals, refuse_setup};
use crate::error::RunError;
use crate::layout::Layout;
use crate::scene::Scene;
use crate::workers::Subsystem;

/// Starts an instance of every subsystem; mistakes in several of them are told together.
pub(super) fn initialize(
    scene: &Scene,
    models: &[v1::Model],
    requests: &[v1::InitializeRequest],
    subsystems: &mut [Subsystem],
) -> Result<(), RunError> {
    let mut refusals = Refusals::default();
    for (number, subsystem) in subsystems.iter_mut().enumerate() {
        let model = &models[number];
        let capabilities = model.capabilities.unwrap_or_default();
        subsystem.repeats_steps = capabilities.repeats_step_sequence;
        subsystem.offers_derivatives = capabilities.directional_derivatives;
        subsystem.exports_states = capabilities.exportable_snapshot;
        if let Err(error) = subsystem.initialize(requests[number].clone()) {
            refusals.collect(refuse_setup(scene, number, model, subsystem, error))?;
        }
    }
    refusals.finish()
}

/// Names of the subsystems in their order.
pub(super) fn names(scene: &Scene) -> Vec<&str> {
    let subsystems = scene.subsystems.iter();
    subsystems
        .map(|subsystem| subsystem.name.as_str())
        .collect()
}

/// What the instance of a subsystem is asked for; `recorded` are its outputs that are results beyond those that the coupling reads.
pub(super) fn initialize_request(
    scene: &Scene,
    number: usize,
    models: &[v1::Model],
    layout: &Layout,
    recorded: &[String],
) -> v1::InitializeRequest {
    let written = &scene.subsystems[number];
    v1::InitializeRequest {
        model: models[number].name.clone(),
        parameters: written.parameters.clone(),
        solver: written.solver.clone(),
        t_start: scene.t_start,
        inputs: input_names(layout, number, false),
        joint_inputs: input_names(layout, number, true),
        joint_loads: layout.joint_loads[number].clone(),
        coupling_outputs: layout.outputs[number].clone(),
        recorded_outputs: recorded.to_vec(),
        interior_outputs: layout.interior_outputs(number),
        integrated_outputs: layout.integrated_outputs(number),
        ..v1::InitializeRequest::default()
    }
}

fn input_names(layout: &Layout, number: usize, are_joint_inputs: bool) -> Vec<String> {
    let inputs = layout.inputs_of(number).iter();
    let inputs = inputs.filter(|input| input.is_joint_input == are_joint_inputs);
    inputs.map(|input| input.name.clone()).collect()
}
