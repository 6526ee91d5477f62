//! Degrees of the input polynomials, and who evaluates turning loads, by what the workers can.

use linchpin_proto::v1;

use crate::coupling::layout::{DrivenInput, Layout, LoadForm, Source};
use crate::error::RunError;
use crate::scene::{self, Jacobian, Loads, Method, Scene};

/// Highest degree of the polynomials by which a turning load is sent to a worker that cannot evaluate it.
const LOAD_DEGREE: usize = 5;

/// How each subsystem takes loads whose direction turns with the bodies.
pub(super) fn load_forms(scene: &Scene, models: &[v1::Model]) -> Result<Vec<LoadForm>, RunError> {
    let coupling = &scene.coupling;
    // Responses to force and moment turn with the body; those to a multiplier also turn with its partner, so they grow old sooner.
    let turns_with_the_body =
        coupling.method.keeps_columns() && coupling.jacobian == Jacobian::Reuse;
    let form = |(written, model): (&scene::Subsystem, &v1::Model)| {
        let capabilities = model.capabilities.unwrap_or_default();
        match coupling.loads {
            Loads::Automatic if capabilities.joint_loads && !turns_with_the_body => {
                Ok(LoadForm::Joint)
            }
            Loads::Worker if capabilities.joint_loads => Ok(LoadForm::Joint),
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
    for input in &layout.inputs {
        let Some((degree, key)) = sent_degree(&scene.coupling, layout, input) else {
            continue;
        };
        let model = &models[input.subsystem];
        if let Some(highest) = highest(model).filter(|highest| *highest < degree) {
            let message = format!(
                "the model \"{}\" of subsystem \"{}\" takes inputs of degree {highest} at most, found {degree}",
                model.name, scene.subsystems[input.subsystem].name
            );
            let help = match key {
                VARIANT => "choose another variant or method".to_owned(),
                key => format!("choose {key} = {highest}"),
            };
            return Err(scene.error(key, message, Some(help)).into());
        }
    }
    Ok(())
}

/// The key that determines the degrees of Hermite coupling.
const VARIANT: &str = "coupling.variant";

/// Degree of the polynomials that an input is sent, and the key that determines it; `None` for what is constant on a step.
fn sent_degree(
    coupling: &scene::Coupling,
    layout: &Layout,
    input: &DrivenInput,
) -> Option<(usize, &'static str)> {
    let exchanged = layout.rows.len()..layout.variables();
    let of_multipliers = (coupling.degree, "coupling.degree");
    let of_exchanged = (coupling.exchanged_degree, "coupling.exchanged_degree");
    let is_exchanged = match &input.source {
        Source::Attitude { .. } => return None,
        Source::Sum(terms) => terms
            .iter()
            .all(|(variable, _)| exchanged.contains(variable)),
        // The direction of a load is no polynomial; of a lower degree it would spoil the order of the method.
        Source::Load(_) => coupling.exchanged_degree > coupling.degree,
    };
    let Method::Hermite { variant } = coupling.method else {
        return Some(if is_exchanged {
            of_exchanged
        } else {
            of_multipliers
        });
    };
    let is_signal = match &input.source {
        Source::Sum(terms) => terms
            .iter()
            .any(|(variable, _)| layout.is_signal(*variable)),
        Source::Attitude { .. } | Source::Load(_) => false,
    };
    let is_load_of_fixed_direction = matches!(input.source, Source::Sum(_)) && !is_exchanged;
    Some(match (is_signal, is_load_of_fixed_direction) {
        (true, _) => of_exchanged,
        (_, true) => (variant.degree(), VARIANT),
        (false, false) => (variant.motion_degree(), VARIANT),
    })
}

/// Highest degree of a polynomial that the worker takes, if there is a limit.
fn highest(model: &v1::Model) -> Option<usize> {
    let degree = model.capabilities?.max_input_degree?;
    Some(degree as usize)
}
