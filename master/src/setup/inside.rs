//! What the workers tell of the inside of a step.

use linchpin_proto::v1;

use crate::error::RunError;
use crate::layout::Layout;
use crate::methods::{Served, WantedInside};
use crate::scene::Scene;

/// Lets the workers tell what the method wants to know of the inside of a step, if all that are read can.
///
/// # Errors
/// The first worker that cannot, where the scene or the method needs it.
pub(super) fn look(
    scene: &Scene,
    models: &[v1::Model],
    layout: &mut Layout,
) -> Result<(), RunError> {
    let method = scene.coupling.method.parameters();
    let Some(wanted) = method.inside(layout.has_signals()) else {
        return Ok(());
    };
    let offers = |subsystem: usize| models[subsystem].capabilities.unwrap_or_default();
    let integrates = |subsystem: usize| match wanted.moments {
        Served::Automatic => offers(subsystem).output_integrals,
        Served::Integrals => true,
        Served::Instants => false,
    };
    let WantedInside {
        shares, weights, ..
    } = &wanted;
    layout.read_inside(shares, *weights, &integrates);
    let inside = &layout.inside;
    let mut subsystems = 0..models.len();
    if let Some(subsystem) = subsystems
        .clone()
        .find(|&one| !inside.integrated[one].is_empty() && !offers(one).output_integrals)
    {
        let message = format!(
            "the model \"{}\" of subsystem \"{}\" offers no integrals of outputs over a step",
            models[subsystem].name, scene.subsystems[subsystem].name
        );
        let help = "choose coupling.moments = \"automatic\"";
        let error = scene.error("coupling.moments", message, Some(help.into()));
        return Err(error.into());
    }
    let cannot = |one: &usize| !inside.places[*one].is_empty() && !offers(*one).interior_outputs;
    match subsystems.find(cannot) {
        None => {}
        Some(subsystem) if wanted.is_needed => {
            let message = format!(
                "the model \"{}\" of subsystem \"{}\" tells no outputs inside a step",
                models[subsystem].name, scene.subsystems[subsystem].name
            );
            let help = "choose coupling.degree = 2";
            let error = scene.error("coupling.degree", message, Some(help.into()));
            return Err(error.into());
        }
        Some(_) => layout.inside = Default::default(),
    }
    Ok(())
}
