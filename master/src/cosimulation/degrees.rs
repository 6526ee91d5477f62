//! Degrees of the input polynomials, and who evaluates turning loads, by what the workers can.

use linchpin_proto::v1;

use crate::coupling::layout::input::Source;
use crate::coupling::layout::{Layout, LoadForm};
use crate::error::RunError;
use crate::scene::{self, Loads, Scene};

/// Highest degree of the polynomials by which a turning load is sent to a worker that cannot evaluate it.
const LOAD_DEGREE: usize = 5;

/// How each subsystem takes loads whose direction turns with the bodies.
pub(super) fn load_forms(scene: &Scene, models: &[v1::Model]) -> Result<Vec<LoadForm>, RunError> {
    let coupling = &scene.coupling;
    let form = |(written, model): (&scene::Subsystem, &v1::Model)| {
        let capabilities = model.capabilities.unwrap_or_default();
        match coupling.loads {
            Loads::Automatic | Loads::Worker if capabilities.joint_loads => Ok(LoadForm::Joint),
            Loads::Worker => {
                let message = format!(
                    "the model \"{}\" of subsystem \"{}\" cannot evaluate loads of joints",
                    model.name, written.name
                );
                let help = "choose coupling.loads = \"automatic\"";
                Err(scene
                    .error("coupling.loads", message, Some(help.into()))
                    .into())
            }
            Loads::Automatic | Loads::Master => Ok(LoadForm::Wrench {
                degree: match (coupling.degree, coupling.exchanged_degree) {
                    (0, 0) => 0,
                    _ => highest(model).map_or(LOAD_DEGREE, |highest| highest.min(LOAD_DEGREE)),
                },
            }),
        }
    };
    scene.subsystems.iter().zip(models).map(form).collect()
}

/// Refuses polynomials of a degree that a worker cannot take.
pub(super) fn check_degrees(
    scene: &Scene,
    models: &[v1::Model],
    layout: &Layout,
) -> Result<(), RunError> {
    let coupling = &scene.coupling;
    let exchanged = layout.rows.len()..layout.variables();
    for input in &layout.inputs {
        let (degree, key) = match &input.source {
            Source::Attitude { .. } => continue,
            Source::Sum(terms)
                if terms
                    .iter()
                    .all(|(variable, _)| exchanged.contains(variable)) =>
            {
                (coupling.exchanged_degree, "coupling.exchanged_degree")
            }
            Source::Sum(_) => (coupling.degree, "coupling.degree"),
            // The direction of a load is no polynomial; of a lower degree it would spoil the order of the method.
            Source::Load(_) if coupling.exchanged_degree > coupling.degree => {
                (coupling.exchanged_degree, "coupling.exchanged_degree")
            }
            Source::Load(_) => (coupling.degree, "coupling.degree"),
        };
        let model = &models[input.subsystem];
        if let Some(highest) = highest(model).filter(|highest| *highest < degree) {
            let message = format!(
                "the model \"{}\" of subsystem \"{}\" takes inputs of degree {highest} at most, found {degree}",
                model.name, scene.subsystems[input.subsystem].name
            );
            let help = format!("choose {key} = {highest}");
            return Err(scene.error(key, message, Some(help)).into());
        }
    }
    Ok(())
}

/// Highest degree of a polynomial that the worker takes, if there is a limit.
fn highest(model: &v1::Model) -> Option<usize> {
    let degree = model.capabilities?.max_input_degree?;
    Some(degree as usize)
}
