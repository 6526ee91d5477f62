//! The result columns that studies judge.

use std::collections::BTreeSet;

use linchpin_master::RunError;
use linchpin_master::results::Row;
use linchpin_master::scene::Scene;
use linchpin_master::setup::multiplier_columns;
use linchpin_proto::v1::Model;

/// A result column, or the sum of several.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Its terms with ` + ` between them.
    pub name: String,
    /// What it holds.
    pub kind: Kind,
}

/// What a column holds, as far as studies judge it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Position of a marker.
    Position,
    /// Velocity of a marker.
    Velocity,
    /// Multiplier of a joint.
    Multiplier,
    /// Energy of all subsystems.
    Energy,
}

impl Column {
    /// The result columns of which it is the sum.
    pub fn terms(&self) -> impl Iterator<Item = &str> {
        terms(&self.name)
    }
}

/// What a run of the scene itself calls the columns.
pub fn names(columns: &[Column]) -> Vec<Option<String>> {
    let names = columns.iter().map(|column| Some(column.name.clone()));
    names.collect()
}

/// The result columns of which a name is the sum.
pub fn terms(name: &str) -> impl Iterator<Item = &str> {
    name.split('+').map(str::trim)
}

/// Motion of all markers, multipliers of all joints, and the energy if every subsystem with a marker tells its own.
///
/// # Errors
/// A joint that does not fit the models.
pub fn judged(scene: &Scene, models: &[Model]) -> Result<Vec<Column>, RunError> {
    let mut columns = Vec::new();
    for (subsystem, model) in scene.subsystems.iter().zip(models) {
        let positions = model.markers.iter().flat_map(|marker| &marker.position);
        let velocities = model.markers.iter().flat_map(|marker| &marker.velocity);
        let positions = positions.map(|output| (output, Kind::Position));
        let velocities = velocities.map(|output| (output, Kind::Velocity));
        let mut seen = BTreeSet::new();
        let outputs = positions.chain(velocities);
        let own = outputs.filter(|(output, _)| !output.is_empty() && seen.insert(*output));
        columns.extend(own.map(|(output, kind)| Column {
            name: format!("{}.{output}", subsystem.name),
            kind,
        }));
    }
    let multipliers = multiplier_columns(scene, models)?.into_iter();
    columns.extend(multipliers.map(|name| Column {
        name,
        kind: Kind::Multiplier,
    }));
    columns.extend(energy(scene, models));
    Ok(columns)
}

/// Output with the energy of a subsystem, as the built-in models have it.
const ENERGY: &str = "energy";

fn energy(scene: &Scene, models: &[Model]) -> Option<Column> {
    let mut terms = Vec::new();
    for (subsystem, model) in scene.subsystems.iter().zip(models) {
        if model.outputs.iter().any(|output| output.name == ENERGY) {
            terms.push(format!("{}.{ENERGY}", subsystem.name));
        } else if !model.markers.is_empty() {
            return None;
        }
    }
    (!terms.is_empty()).then(|| Column {
        name: terms.join(" + "),
        kind: Kind::Energy,
    })
}

/// Lets the scene record the columns, whatever its coupling asks for; multipliers always are.
pub fn record(scene: &mut Scene, columns: &[Column]) {
    let outputs = columns.iter().filter(|own| own.kind != Kind::Multiplier);
    let variables = scene.output.variables.get_or_insert_default();
    variables.extend(outputs.flat_map(Column::terms).map(str::to_owned));
    scene.output.every = 1;
}

/// Where the terms of a sum stand in a row; `None` if one of them is not there.
pub fn places(row: &Row, name: &str) -> Option<Vec<usize>> {
    let place = |term: &str| row.columns().iter().position(|column| column == term);
    terms(name).map(place).collect()
}

/// The sum of the values at these places.
pub fn sum(row: &Row, places: &[usize]) -> f64 {
    places.iter().map(|place| row.values()[*place]).sum()
}
