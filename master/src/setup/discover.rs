//! Finds models, markers and outputs that a scene names in what the workers describe.

use std::collections::BTreeMap;
use std::sync::Arc;

use linchpin_proto::v1::{self, MarkerKind};
use linchpin_proto::version;

use super::geometry::law_of;
use super::refusal::refuse_setup;
use crate::error::RunError;
use crate::joint::Level;
use crate::layout::{Lack, MarkedConnection, MarkedJoint, MarkerLacks, column_name};
use crate::reading::nearest::nearest;
use crate::results::contact_outputs;
use crate::scene::{Connection, Joint, Scene, Side};
use crate::time::at_start;
use crate::workers::Subsystem;

/// Asks a worker for its models and chooses the one that the scene wants.
pub(super) fn model_of(
    scene: &Scene,
    number: usize,
    subsystem: &Subsystem,
) -> Result<v1::Model, RunError> {
    let written = &scene.subsystems[number];
    let description = subsystem
        .describe(None, &BTreeMap::new())
        .map_err(|error| subsystem.failed(error, at_start(scene.t_start)))?;
    version::negotiate(description.protocol.as_ref()).map_err(|source| RunError::Incompatible {
        subsystem: written.name.clone(),
        source,
    })?;
    let model = choose_model(scene, number, &description.models)?;
    // What the model offers may depend on its parameters.
    let configured = subsystem
        .describe(Some(&model.name), &written.parameters)
        .map_err(|error| refuse_setup(scene, number, model, subsystem, error))?;
    let mut configured = configured.models.into_iter();
    let same = configured.find(|configured| configured.name == model.name);
    Ok(same.unwrap_or_else(|| model.clone()))
}

/// The model that the scene names, or the only one.
fn choose_model<'a>(
    scene: &Scene,
    number: usize,
    models: &'a [v1::Model],
) -> Result<&'a v1::Model, RunError> {
    let written = &scene.subsystems[number];
    let key = format!("subsystem.{}.model", written.name);
    let names: Vec<&str> = models.iter().map(|model| model.name.as_str()).collect();
    let place = match &written.model {
        Some(name) => names
            .iter()
            .position(|known| known == name)
            .ok_or_else(|| {
                scene.error(
                    &key,
                    format!(
                        "the worker has no model \"{name}\"; it has: {}",
                        names.join(", ")
                    ),
                    did_you_mean(name, &names),
                )
            })?,
        None if names.len() == 1 => 0,
        None => {
            let message = format!(
                "the worker has {} models: {}",
                names.len(),
                names.join(", ")
            );
            return Err(scene
                .error(&key, message, Some("say which with `model = ...`".into()))
                .into());
        }
    };
    Ok(&models[place])
}

/// The markers that the joints of the scene hold.
pub(super) fn mark(scene: &Scene, models: &[v1::Model]) -> Result<Vec<MarkedJoint>, RunError> {
    let mark_one = |joint: &Joint| {
        let marker = |side: &Side, end: &str, partner: &Side| {
            let key = format!("joint.{}.{end}", joint.name);
            let kind = known_kind(partner, &models[partner.subsystem]);
            let marker = marker_of(scene, &key, (side, kind), &models[side.subsystem])?;
            Ok::<_, RunError>((side.subsystem, marker))
        };
        let (a, b) = (&joint.a, &joint.b);
        let ends = [marker(a, "a", b)?, marker(b, "b", a)?];
        let kind = kind_of(scene, joint, &ends)?;
        Ok(MarkedJoint {
            name: joint.name.clone(),
            joint: Arc::new(law_of(scene, joint, kind)?),
            ends,
        })
    };
    scene.joints.iter().map(mark_one).collect()
}

/// Names of the result columns of all multipliers of a scene whose subsystems have these models.
///
/// # Errors
/// A joint names a marker that does not exist, or one that it cannot hold.
pub fn multiplier_columns(scene: &Scene, models: &[v1::Model]) -> Result<Vec<String>, RunError> {
    let joints = mark(scene, models)?;
    let names = joints.iter().flat_map(|joint| {
        let rows = 0..joint.joint.len();
        rows.map(|row| column_name(&joint.name, "lambda", joint.joint.name(row)))
    });
    Ok(names.collect())
}

/// The kind of the marker at an end, if that is named or the only one.
fn known_kind(side: &Side, model: &v1::Model) -> Option<MarkerKind> {
    let mut markers = model.markers.iter();
    match &side.marker {
        Some(name) => markers.find(|marker| &marker.name == name),
        None => markers.next().filter(|_| model.markers.len() == 1),
    }
    .map(v1::Marker::kind)
}

/// The kind of the two markers of a joint, which must be the same.
fn kind_of(
    scene: &Scene,
    joint: &Joint,
    [(_, a), (_, b)]: &[(usize, v1::Marker); 2],
) -> Result<MarkerKind, RunError> {
    if a.kind == b.kind {
        return Ok(a.kind());
    }
    let message = format!("it joins a {} and a {} marker", kind_name(a), kind_name(b));
    let help = "both markers must be of the same kind";
    let key = format!("joint.{}", joint.name);
    Err(scene.error(&key, message, Some(help.into())).into())
}

/// The signal connections of the scene, with outputs and inputs that the models have.
pub(super) fn connect_signals(
    scene: &Scene,
    models: &[v1::Model],
) -> Result<Vec<MarkedConnection>, RunError> {
    let mut driven: Vec<&(usize, String)> = Vec::new();
    let mut connections = Vec::new();
    for connection in &scene.connections {
        find_variable(scene, connection, "from", &models[connection.from.0])?;
        find_variable(scene, connection, "to", &models[connection.to.0])?;
        if driven.contains(&&connection.to) {
            let (subsystem, input) = &connection.to;
            let subsystem = &scene.subsystems[*subsystem].name;
            let message =
                format!("\"{subsystem}.{input}\" is driven by another connection already");
            let help = "an input takes one signal";
            let key = format!("connection.{}.to", connection.name);
            return Err(scene.error(&key, message, Some(help.into())).into());
        }
        driven.push(&connection.to);
        connections.push(MarkedConnection {
            from: connection.from.clone(),
            to: connection.to.clone(),
            start: start_of(scene, models, connection)?,
        });
    }
    Ok(connections)
}

/// Where the search for the signal of a connection begins: as the scene says, or at the first default of an input that takes it, if that is
/// not 0.
fn start_of(
    scene: &Scene,
    models: &[v1::Model],
    connection: &Connection,
) -> Result<Option<f64>, RunError> {
    let of_one = |other: &&Connection| other.from == connection.from;
    let all: Vec<&Connection> = scene.connections.iter().filter(of_one).collect();
    let given = all.iter().find_map(|one| Some((&one.name, one.start?)));
    if let Some((name, start)) = given {
        if connection.start.is_some_and(|own| own != start) {
            let message = format!(
                "another start value than in connection \"{name}\", which takes the same output"
            );
            let key = format!("connection.{}.start", connection.name);
            let help = "give one of them, or both the same";
            return Err(scene.error(&key, message, Some(help.into())).into());
        }
        return Ok(Some(start));
    }
    let default_of = |one: &&Connection| {
        let (subsystem, input) = &one.to;
        let inputs = &models[*subsystem].inputs;
        let described = inputs.iter().find(|variable| variable.name == *input)?;
        described.default.filter(|value| *value != 0.0)
    };
    Ok(all.iter().find_map(default_of))
}

/// Checks that the model at an end of a connection has the variable that is named there.
pub(super) fn find_variable(
    scene: &Scene,
    connection: &Connection,
    end: &str,
    model: &v1::Model,
) -> Result<(), RunError> {
    let is_source = end == "from";
    let (_, name) = match is_source {
        true => &connection.from,
        false => &connection.to,
    };
    let (what, variables) = match is_source {
        true => ("output", &model.outputs),
        false => ("input", &model.inputs),
    };
    let known: Vec<&str> = variables
        .iter()
        .map(|variable| variable.name.as_str())
        .collect();
    if known.contains(&name.as_str()) {
        return Ok(());
    }
    let message = format!(
        "model \"{}\" has no {what} \"{name}\"; it has: {}",
        model.name,
        known.join(", ")
    );
    let key = format!("connection.{}.{end}", connection.name);
    Err(scene
        .error(&key, message, did_you_mean(name, &known))
        .into())
}

fn kind_name(marker: &v1::Marker) -> &'static str {
    match marker.kind() {
        MarkerKind::Scalar => "scalar",
        MarkerKind::Planar => "planar",
        MarkerKind::Spatial => "spatial",
        MarkerKind::Unspecified => "unspecified",
    }
}

/// The marker of a model that one end of a joint names.
pub(super) fn marker_of(
    scene: &Scene,
    key: &str,
    (side, kind): (&Side, Option<MarkerKind>),
    model: &v1::Model,
) -> Result<v1::Marker, RunError> {
    let names: Vec<&str> = model
        .markers
        .iter()
        .map(|marker| marker.name.as_str())
        .collect();
    let subsystem = &scene.subsystems[side.subsystem].name;
    match &side.marker {
        None => {
            let of_kind = |marker: &&v1::Marker| {
                model.markers.len() == 1 || kind.is_some_and(|kind| marker.kind() == kind)
            };
            let mut fitting = model.markers.iter().filter(of_kind);
            if let (Some(only), None) = (fitting.next(), fitting.next()) {
                return Ok(only.clone());
            }
            let message = format!(
                "subsystem \"{subsystem}\" (model \"{}\") has {} markers: {}",
                model.name,
                names.len(),
                names.join(", ")
            );
            let help = format!("write \"{subsystem}.MARKER\"");
            Err(scene.error(key, message, Some(help)).into())
        }
        Some(name) => {
            let found = model.markers.iter().find(|marker| &marker.name == name);
            found.cloned().ok_or_else(|| {
                let message = format!(
                    "model \"{}\" has no marker \"{name}\"; it has: {}",
                    model.name,
                    names.join(", ")
                );
                scene.error(key, message, did_you_mean(name, &names)).into()
            })
        }
    }
}

/// The error for a marker that cannot take part in a joint.
pub(super) fn refuse_marker(scene: &Scene, lacks: MarkerLacks) -> RunError {
    let joint = &scene.joints[lacks.joint];
    let (side, end) = if lacks.end == 0 {
        (&joint.a, "a")
    } else {
        (&joint.b, "b")
    };
    let subsystem = &scene.subsystems[side.subsystem].name;
    let (what, help) = match lacks.what {
        Lack::Output(Level::Acceleration) => (
            "the acceleration that an index-1 or explicit coupling needs",
            "choose coupling.index = 2 or 3",
        ),
        Lack::Output(Level::Velocity) => (
            "the velocity that the coupling needs",
            "choose coupling.index = 3",
        ),
        Lack::Output(Level::Position) => ("a position", "the worker must describe one"),
        Lack::Load => (
            "an input for the joint's load",
            "the worker must describe one",
        ),
    };
    let message = format!("the marker of subsystem \"{subsystem}\" does not offer {what}");
    scene
        .error(
            &format!("joint.{}.{end}", joint.name),
            message,
            Some(help.into()),
        )
        .into()
}

/// The outputs to record of each subsystem beyond `coupling`, as `output.variables` lists them.
pub(super) fn recorded_outputs(
    scene: &Scene,
    models: &[v1::Model],
    coupling: &[Vec<String>],
) -> Result<Vec<Vec<String>>, RunError> {
    let mut recorded = vec![Vec::new(); models.len()];
    for variable in scene.output.variables.iter().flatten() {
        let refuse = |message: String, help| scene.error("output.variables", message, help);
        let Some((subsystem, output)) = variable.split_once('.') else {
            let message = format!("\"{variable}\" is not SUBSYSTEM.OUTPUT");
            return Err(refuse(message, None).into());
        };
        let names: Vec<&str> = scene.subsystems.iter().map(|s| s.name.as_str()).collect();
        let number = names
            .iter()
            .position(|name| *name == subsystem)
            .ok_or_else(|| {
                let message = format!("\"{variable}\": there is no subsystem \"{subsystem}\"");
                refuse(message, did_you_mean(subsystem, &names))
            })?;
        let outputs: Vec<&str> = models[number]
            .outputs
            .iter()
            .map(|output| output.name.as_str())
            .collect();
        if !outputs.contains(&output) {
            let message = format!(
                "\"{variable}\": model \"{}\" has no output \"{output}\"; it has: {}",
                models[number].name,
                outputs.join(", ")
            );
            return Err(refuse(message, did_you_mean(output, &outputs)).into());
        }
        let output = output.to_owned();
        if !coupling[number].contains(&output) && !recorded[number].contains(&output) {
            recorded[number].push(output);
        }
    }
    Ok(recorded)
}

/// Adds what a picture of the moving mechanism needs to the outputs to record, as far as it is not there and not in
/// `coupling`: the positions of all markers, and what their contacts do.
pub(super) fn record_markers(
    models: &[v1::Model],
    coupling: &[Vec<String>],
    recorded: &mut [Vec<String>],
) {
    for (number, model) in models.iter().enumerate() {
        let positions = model.markers.iter().flat_map(|marker| &marker.position);
        for output in positions.cloned().chain(contact_outputs(model)) {
            if !coupling[number].contains(&output) && !recorded[number].contains(&output) {
                recorded[number].push(output);
            }
        }
    }
}

pub(super) fn did_you_mean(name: &str, known: &[&str]) -> Option<String> {
    nearest(name, known.iter().copied()).map(|near| format!("did you mean \"{near}\"?"))
}
