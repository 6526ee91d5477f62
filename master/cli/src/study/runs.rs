//! What all studies need to know about a scene and its runs.

use std::collections::BTreeSet;

use linchpin_master::RunError;
use linchpin_master::cosimulation::{Connect, describe, multiplier_columns};
use linchpin_master::scene::Scene;
use linchpin_proto::contract::CallError;
use linchpin_proto::v1::{Model, Severity};

use super::StudyError;
use crate::connect::{Connector, Place};

/// A variant of the scene that is studied on its own.
pub struct Variant {
    /// Name of the case; that of the scene if it has no cases.
    pub name: String,
    /// The scene with what the case changes.
    pub scene: Scene,
}

impl Variant {
    /// The cases of the scene, or the scene itself if it has none.
    pub fn all(scene: &Scene) -> Result<Vec<Self>, StudyError> {
        if scene.cases.is_empty() {
            let name = scene.name.clone();
            let scene = scene.clone();
            return Ok(vec![Self { name, scene }]);
        }
        let variant = |case| {
            let scene = scene.with_case(case)?;
            let name = case.name.clone();
            Ok(Self { name, scene })
        };
        scene.cases.iter().map(variant).collect()
    }

    /// For messages.
    pub fn in_words(&self) -> String {
        format!("\"{}\"", self.name)
    }

    /// The error of a run of this variant.
    pub fn failed(&self, source: RunError) -> StudyError {
        StudyError::Run {
            case: self.in_words(),
            source,
        }
    }

    /// The result columns that studies judge; `models` are those of [`Variant::models`].
    pub fn judged_columns(&self, models: &[Model]) -> Result<Vec<(String, Kind)>, StudyError> {
        judged_columns(&self.scene, models).map_err(|source| self.failed(source))
    }

    /// The models of all subsystems.
    pub fn models(&self) -> Result<Vec<Model>, StudyError> {
        in_process(|connect| describe(&self.scene, connect)).map_err(|source| self.failed(source))
    }
}

/// Gives `action` connections to built-in models in this process; they end with it.
pub fn in_process<T>(action: impl FnOnce(&mut Connect<'_>) -> T) -> T {
    let connector = Connector::new(Place::InProcess);
    action(&mut |scene, subsystem| connector.connect(scene, subsystem))
}

/// How a run diverged; an error that has nothing to do with the numbers is given back.
pub fn divergence(error: RunError) -> Result<String, RunError> {
    let has_diverged = match &error {
        RunError::Diverged { .. }
        | RunError::Grown { .. }
        | RunError::NotFinite { .. }
        | RunError::Singular { .. } => true,
        RunError::Worker { source, .. } => matches!(
            &**source,
            CallError::Failed(failure) if failure.severity() == Severity::Recoverable
        ),
        _ => false,
    };
    if has_diverged {
        Ok(error.to_string())
    } else {
        Err(error)
    }
}

/// What a result column holds, as far as studies judge it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Position of a marker.
    Position,
    /// Velocity of a marker.
    Velocity,
    /// Multiplier of a joint.
    Multiplier,
}

/// The result columns that studies judge: motion of all markers, multipliers of all joints.
fn judged_columns(scene: &Scene, models: &[Model]) -> Result<Vec<(String, Kind)>, RunError> {
    let mut columns = Vec::new();
    for (subsystem, model) in scene.subsystems.iter().zip(models) {
        let positions = model.markers.iter().flat_map(|marker| &marker.position);
        let velocities = model.markers.iter().flat_map(|marker| &marker.velocity);
        let positions = positions.map(|output| (output, Kind::Position));
        let velocities = velocities.map(|output| (output, Kind::Velocity));
        let mut seen = BTreeSet::new();
        columns.extend(
            positions
                .chain(velocities)
                .filter(|(output, _)| !output.is_empty() && seen.insert(*output))
                .map(|(output, kind)| (format!("{}.{output}", subsystem.name), kind)),
        );
    }
    let multipliers = multiplier_columns(scene, models)?;
    columns.extend(multipliers.into_iter().map(|name| (name, Kind::Multiplier)));
    Ok(columns)
}

/// Lets the scene record the outputs among `columns`, whatever its coupling asks for.
pub fn record(scene: &mut Scene, columns: &[(String, Kind)]) {
    let outputs = columns.iter().filter(|(_, kind)| *kind != Kind::Multiplier);
    let variables = scene.output.variables.get_or_insert_default();
    variables.extend(outputs.map(|(column, _)| column.clone()));
}
