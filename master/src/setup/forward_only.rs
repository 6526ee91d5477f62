//! Models that cannot go back to a state before, where a scene would ask them to.

use linchpin_proto::v1;

use crate::error::RunError;
use crate::scene::Scene;

/// Refuses the model of a subsystem that only goes forward if the method looks ahead, or if results between macro points are wanted.
pub(super) fn refuse(scene: &Scene, number: usize, model: &v1::Model) -> Result<(), RunError> {
    let Some(reason) = &model.forward_only else {
        return Ok(());
    };
    let subsystem = &scene.subsystems[number].name;
    let (key, needs, help) = if scene.coupling.method.corrects() {
        let needs = format!(
            "coupling.method = \"{}\" takes steps that do not stay",
            scene.coupling.method.name()
        );
        let help = "choose coupling.method = \"explicit\", \"jacobi\" or \"gauss-seidel\"";
        ("coupling.method", needs, help)
    } else if scene.output.interval.is_some() {
        let needs = "output.interval takes steps that do not stay".to_owned();
        ("output.interval", needs, "use output.every")
    } else {
        return Ok(());
    };
    let message = format!("{needs}, and subsystem \"{subsystem}\" cannot go back: {reason}");
    Err(scene.error(key, message, Some(help.into())).into())
}
