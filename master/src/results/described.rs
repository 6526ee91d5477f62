//! What the result columns show: quantities, units and descriptions.

use linchpin_proto::v1;

use super::{Column, MarkerPart, Quantity, Row};
use crate::joint::Level;
use crate::layout::{Layout, MarkedJoint};

/// First component of the unit quaternion in the position of a spatial marker.
const FIRST_OF_ATTITUDE: usize = 3;

/// What every column of a row shows, in their order.
pub(crate) fn described(
    row: &Row,
    layout: &Layout,
    models: &[v1::Model],
    joints: &[MarkedJoint],
) -> Vec<Column> {
    let mut columns = vec![Column {
        name: row.columns()[0].clone(),
        unit: "s".into(),
        description: "time".into(),
        quantity: Quantity::Time,
        marker: None,
    }];
    for (number, model) in models.iter().enumerate() {
        let outputs = row.outputs_of(number).iter();
        columns.extend(outputs.map(|name| output(model, name)));
    }
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
    let of_joint = |place: usize, what: &str, unit: String, quantity| Column {
        name: row.columns()[place].clone(),
        unit,
        description: what.to_owned(),
        quantity,
        marker: None,
    };
    let named = |number: usize| {
        let own = &layout.rows[number];
        let part = joints[own.joint].joint.name(own.condition);
        let part = if part.is_empty() {
            String::new()
        } else {
            format!(", condition {part}")
        };
        format!("joint {}{part}", joints[own.joint].name)
    };
    for (number, [_, unit]) in conditions.iter().enumerate() {
        let what = match unit.as_str() {
            "N" => "multiplier, the force on end a",
            "N m" => "multiplier, the moment on end a",
            _ => "multiplier, the load on end a",
        };
        let what = format!("{what}: {}", named(number));
        columns.push(of_joint(
            columns.len(),
            &what,
            unit.clone(),
            Quantity::Multiplier,
        ));
    }
    for (number, [length, _]) in conditions.iter().enumerate() {
        for level in layout.level.up_to() {
            let what = format!("residual on {} level: {}", level.name(), named(number));
            let unit = rate(length, *level);
            columns.push(of_joint(columns.len(), &what, unit, Quantity::Residual));
        }
    }
    while let Some((quantity, unit, what)) = row.of_step(columns.len()) {
        columns.push(of_joint(columns.len(), what, unit.to_owned(), quantity));
    }
    columns
}

/// What the result column `SUBSYSTEM.OUTPUT` shows.
fn output(model: &v1::Model, column: &str) -> Column {
    let is_own = |own: &&v1::Variable| {
        let output = column.strip_suffix(&own.name);
        output.is_some_and(|subsystem| subsystem.ends_with('.'))
    };
    // A name may have dots: the longest that fits is the output.
    let own = { model.outputs.iter() }
        .filter(is_own)
        .max_by_key(|own| own.name.len());
    let (quantity, marker) = own.map_or((Quantity::Output, None), |own| motion(model, &own.name));
    let subsystem = own.and_then(|own| column.strip_suffix(&own.name));
    let marker = marker.map(|(marker, component)| MarkerPart {
        name: format!("{}{marker}", subsystem.unwrap_or_default()),
        component,
    });
    Column {
        name: column.to_owned(),
        unit: own.map_or_else(String::new, |own| own.unit.clone()),
        description: own.map_or_else(String::new, |own| own.description.clone()),
        quantity,
        marker,
    }
}

/// Whether an output is part of the motion of a marker, of which, and where in it.
fn motion<'a>(model: &'a v1::Model, output: &str) -> (Quantity, Option<(&'a str, usize)>) {
    for marker in &model.markers {
        let lists = [
            (Quantity::Position, &marker.position),
            (Quantity::Velocity, &marker.velocity),
            (Quantity::Acceleration, &marker.acceleration),
        ];
        for (quantity, names) in lists {
            let Some(component) = names.iter().position(|name| name == output) else {
                continue;
            };
            let is_attitude = quantity == Quantity::Position
                && marker.kind() == v1::MarkerKind::Spatial
                && component >= FIRST_OF_ATTITUDE;
            let quantity = if is_attitude {
                Quantity::Attitude
            } else {
                quantity
            };
            return (quantity, Some((&marker.name, component)));
        }
    }
    (Quantity::Output, None)
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
