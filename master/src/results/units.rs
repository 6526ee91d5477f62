//! Units of the result columns.

use linchpin_proto::v1;

use super::Row;
use crate::joint::Level;
use crate::layout::{Layout, MarkedJoint};

/// The unit of every column of a row, in their order: that which the model gives an output; of multipliers and residuals what
/// follows from the condition, and with scalar markers from their position and their load. 1 for numbers without a unit, empty
/// where a worker does not tell.
pub(crate) fn units(
    row: &Row,
    layout: &Layout,
    models: &[v1::Model],
    joints: &[MarkedJoint],
) -> Vec<String> {
    let conditions: Vec<[String; 2]> = layout
        .rows
        .iter()
        .map(|row| {
            let marked = &joints[row.joint];
            let condition = marked.joint.condition(row.condition);
            match (condition.law(), condition.is_length()) {
                (None, _) => scalar_units(marked, models),
                (Some(_), true) => ["m", "N"].map(str::to_owned),
                (Some(_), false) => ["1", "N m"].map(str::to_owned),
            }
        })
        .collect();
    let mut units = vec!["s".to_owned()];
    for (number, model) in models.iter().enumerate() {
        let outputs = row.outputs_of(number).iter();
        units.extend(outputs.map(|column| output_unit(model, column)));
    }
    units.extend(conditions.iter().map(|[_, load]| load.clone()));
    for [length, _] in &conditions {
        let levels = layout.level.up_to().iter();
        units.extend(levels.map(|level| rate(length, *level)));
    }
    // What tells of the macro step: its length, and degrees.
    let of_step = row.columns()[units.len()..].iter();
    let of_step = of_step.enumerate().map(|(place, _)| match place {
        0 if row.shows_step() => "s",
        _ => "1",
    });
    units.extend(of_step.map(str::to_owned));
    units
}

/// The unit of an output, by its result column `SUBSYSTEM.OUTPUT`.
fn output_unit(model: &v1::Model, column: &str) -> String {
    let is_own = |own: &&v1::Variable| {
        let output = column.strip_suffix(&own.name);
        output.is_some_and(|subsystem| subsystem.ends_with('.'))
    };
    // A name may have dots: the longest that fits is the output.
    let own = { model.outputs.iter() }
        .filter(is_own)
        .max_by_key(|own| own.name.len());
    own.map_or_else(String::new, |own| own.unit.clone())
}

/// Units of position and load of the scalar markers of a link.
fn scalar_units(marked: &MarkedJoint, models: &[v1::Model]) -> [String; 2] {
    let (subsystem, marker) = &marked.ends[0];
    let model = &models[*subsystem];
    let unit = |names: &[String], variables: &[v1::Variable]| {
        let own = variables
            .iter()
            .find(|own| names.first() == Some(&own.name));
        own.map_or_else(String::new, |own| own.unit.clone())
    };
    [
        unit(&marker.position, &model.outputs),
        unit(&marker.load, &model.inputs),
    ]
}

/// The unit of a time derivative of what has the unit `of`.
fn rate(of: &str, level: Level) -> String {
    let per = match level {
        Level::Position => return of.to_owned(),
        Level::Velocity => "/s",
        Level::Acceleration => "/s^2",
    };
    match of {
        "" => String::new(),
        of => format!("{of}{per}"),
    }
}
