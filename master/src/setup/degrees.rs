//! Degrees of the input polynomials, and who evaluates turning loads, by what the workers can.

use std::cmp::Reverse;

use linchpin_proto::polynomial::MAX_NODES;
use linchpin_proto::v1;

use super::discover::refuse_marker;
use crate::error::RunError;
use crate::layout::{
    Coupled, DrivenInput, Layout, LoadForm, MarkedConnection, MarkedJoint, Source,
};
use crate::methods::OwnCurves;
use crate::results::StepDegrees;
use crate::scene::{self, Degree, Jacobian, Loads, Scene};
use crate::signal::MAX_DEGREE;

/// Highest degree of the polynomials by which a turning load is sent to a worker that cannot evaluate it.
const LOAD_DEGREE: usize = 5;

/// The same for multipliers whose polynomials have a degree above 2: the highest that a signal can have.
const HIGHEST_LOAD_DEGREE: usize = MAX_NODES - 1;

/// How each subsystem takes loads whose direction turns with the bodies.
pub(super) fn load_forms(scene: &Scene, models: &[v1::Model]) -> Result<Vec<LoadForm>, RunError> {
    let coupling = &scene.coupling;
    // Responses to force and moment turn with the body; those to a multiplier also turn with its partner, so they grow old sooner. What the form
    // of the load adds to the error of S1's methods counts where nothing controls the error.
    let own_curves = coupling.method.parameters().own_curves();
    let wanted = match own_curves {
        Some(own) if own.multipliers > 2 => HIGHEST_LOAD_DEGREE,
        _ => LOAD_DEGREE,
    };
    let is_controlled = own_curves.is_some() || coupling.step_control.is_some();
    let turns_with_the_body = is_controlled && coupling.jacobian == Jacobian::Reuse;
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
                degree: match coupling
                    .degree
                    .highest()
                    .max(coupling.exchanged_degree.highest())
                {
                    0 => 0,
                    _ => highest(model).map_or(wanted, |highest| highest.min(wanted)),
                },
            }),
        }
    };
    scene.subsystems.iter().zip(models).map(form).collect()
}

/// The scene with an automatic degree of the method's own curves that ends where some worker takes no more: inputs of a higher degree, or to be
/// looked at inside a step. Where not even the lowest is taken it stays, to be refused.
pub(super) fn fit(
    scene: &Scene,
    models: &[v1::Model],
    joints: &[MarkedJoint],
    connections: &[MarkedConnection],
) -> Scene {
    let mut fitting = scene.clone();
    while !is_taken(&fitting, models, joints, connections) {
        if !fitting.coupling.method.lower_degree() {
            return scene.clone();
        }
        let own = fitting.coupling.method.parameters().own_curves();
        if let Some(own) = own.filter(|own| !own.follow) {
            fitting.coupling.degree = Degree::Fixed(own.multipliers);
        }
    }
    let degrees = [scene, &fitting].map(|scene| {
        let own = scene.coupling.method.parameters().own_curves();
        own.map(|own| own.multipliers)
    });
    if let [Some(highest), Some(fitting)] = degrees
        && fitting < highest
    {
        let because = "a worker takes no more";
        tracing::info!(
            degree = fitting,
            instead_of = highest,
            because,
            "highest degree"
        );
    }
    fitting
}

fn is_taken(
    scene: &Scene,
    models: &[v1::Model],
    joints: &[MarkedJoint],
    connections: &[MarkedConnection],
) -> bool {
    let Ok(forms) = load_forms(scene, models) else {
        return false;
    };
    let subsystems = scene.subsystems.iter();
    let coupled = Coupled {
        subsystems: subsystems.map(|own| own.name.as_str()).collect(),
        forms,
        joints,
        connections,
    };
    let Ok(mut layout) = layout_of(scene, &coupled) else {
        return false;
    };
    let looked = super::inside::look(scene, models, &mut layout);
    looked.is_ok() && check_degrees(scene, models, &layout).is_ok()
}

/// Where the joints and connections of a scene stand in the subsystems, and what its method reads.
pub(super) fn layout_of(scene: &Scene, coupled: &Coupled<'_>) -> Result<Layout, RunError> {
    let method = scene.coupling.method.parameters();
    let layout = match method.own_curves() {
        Some(_) => Layout::with_rates(coupled, method.level()),
        None => Layout::new(coupled, method.level()),
    };
    let mut layout = layout.map_err(|lacks| refuse_marker(scene, lacks))?;
    let coupling = &scene.coupling;
    if coupling.method.corrects() && coupling.jacobian == Jacobian::Reuse {
        layout.add_frames(coupled);
    }
    Ok(layout)
}

/// Refuses polynomials of a degree that a worker cannot take; the highest degrees that all workers take, where they follow the estimates.
pub(super) fn check_degrees(
    scene: &Scene,
    models: &[v1::Model],
    layout: &Layout,
) -> Result<StepDegrees, RunError> {
    let [multipliers, exchanged] = groups(&scene.coupling);
    let own_curves = scene.coupling.method.parameters().own_curves();
    let highest_of_method = own_curves.map_or(MAX_DEGREE, |own| own.multipliers);
    let mut limits = [multipliers, exchanged].map(|group| match group.degree {
        Degree::Automatic => Some(highest_of_method),
        Degree::Fixed(_) => None,
    });
    for input in &layout.inputs {
        let model = &models[input.subsystem];
        let Some(highest) = highest(model) else {
            continue;
        };
        for sent in sent(&scene.coupling, layout, input) {
            match (sent.degree, sent.group) {
                (Degree::Automatic, Some(group)) => {
                    limits[group] = limits[group].map(|limit| limit.min(highest));
                }
                (Degree::Fixed(degree), _) if degree > highest => {
                    return Err(refuse_degree(
                        scene, model, input, sent.key, degree, highest,
                    ));
                }
                _ => {}
            }
        }
    }
    let [multipliers, exchanged] = limits;
    Ok(StepDegrees {
        multipliers,
        exchanged,
    })
}

fn refuse_degree(
    scene: &Scene,
    model: &v1::Model,
    input: &DrivenInput,
    key: &str,
    degree: usize,
    highest: usize,
) -> RunError {
    let message = format!(
        "the model \"{}\" of subsystem \"{}\" takes inputs of degree {highest} at most, found {degree}",
        model.name, scene.subsystems[input.subsystem].name
    );
    let help = match scene.coupling.method.parameters().own_curves() {
        Some(own) if own.key == key => {
            "choose a lower degree, another variant or another method".to_owned()
        }
        _ => format!("choose {key} = {highest}"),
    };
    scene.error(key, message, Some(help)).into()
}

/// A degree of polynomials that an input is sent.
#[derive(Debug, Clone, Copy)]
struct Sent {
    degree: Degree,
    /// The key that determines it.
    key: &'static str,
    /// 0 for that of multipliers, 1 for that of exchanged variables; absent if neither says it.
    group: Option<usize>,
}

fn groups(coupling: &scene::Coupling) -> [Sent; 2] {
    let group = |group, degree, key| Sent {
        degree,
        key,
        group: Some(group),
    };
    [
        group(0, coupling.degree, "coupling.degree"),
        group(1, coupling.exchanged_degree, "coupling.exchanged_degree"),
    ]
}

/// The degrees of the polynomials that an input is sent, the highest first; none for what is constant on a step.
fn sent(coupling: &scene::Coupling, layout: &Layout, input: &DrivenInput) -> Vec<Sent> {
    let exchanged = layout.rows.len()..layout.variables();
    let mut groups = groups(coupling);
    let own_curves = coupling.method.parameters().own_curves();
    let of_own = |degree, key| Sent {
        degree: Degree::Fixed(degree),
        key,
        group: None,
    };
    let terms = match &input.source {
        Source::Attitude { .. } => return Vec::new(),
        Source::Sum(terms) => terms,
        Source::Load(_) => {
            if let Some(OwnCurves { motion, key, .. }) = own_curves {
                return vec![of_own(motion, key)];
            }
            // The direction of a load is no polynomial; of a lower degree it would spoil the order of the method.
            groups.sort_by_key(|sent| Reverse(sent.degree.highest()));
            return groups.to_vec();
        }
    };
    let is_exchanged = terms
        .iter()
        .all(|(variable, _)| exchanged.contains(variable));
    let is_signal = terms
        .iter()
        .any(|(variable, _)| layout.is_signal(*variable));
    let [of_multipliers, of_exchanged] = groups;
    vec![match own_curves {
        Some(own) if is_signal && own.signals && layout.inside.is_told() => {
            of_own(own.multipliers, own.key)
        }
        Some(_) if is_signal => of_exchanged,
        Some(own) if is_exchanged => of_own(own.motion, own.key),
        Some(own) => of_own(own.multipliers, own.key),
        None if is_exchanged => of_exchanged,
        None => of_multipliers,
    }]
}

/// Highest degree of a polynomial that the worker takes, if there is a limit.
fn highest(model: &v1::Model) -> Option<usize> {
    let degree = model.capabilities?.max_input_degree?;
    Some(degree as usize)
}
