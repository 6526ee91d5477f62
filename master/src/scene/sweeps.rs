//! Reads the studies over a scene: `[[case]]`, `[converge]` and `[stability]`.

use super::assign::Assignment;
use super::resolved::{Axis, Case, ConvergeSettings, Reference, StabilitySettings, toml_number};
use super::step_control::read_step;
use crate::reading::overrides::Override;
use crate::reading::reader::{FINITE, Field, POSITIVE, Problems, Section};
use crate::reading::written::{Node, Table, Value};

const REFERENCES: [(&str, Reference); 4] = [
    ("automatic", Reference::Automatic),
    ("closed-form", Reference::ClosedForm),
    ("monolithic", Reference::Monolithic),
    ("finest", Reference::Finest),
];
/// A map has at most this many points along an axis.
const MOST_POINTS: usize = 1000;
const KEYS_OF_AXIS: &str = "a key such as \"coupling.beta\", or a list of keys";
const STEPS: &str = "a list of two or more different macro steps";
const VALUES: &str = "a list of two or more numbers";

pub(super) fn read_case(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Case> {
    section.allow_only(&["name", "set"], problems);
    let name_field = section.require("name", "name = \"index 1\"", problems);
    let name = name_field.and_then(|field| match field.text(problems)? {
        "" => field.wrong_type("a text that is not empty", problems),
        name => Some(name.to_owned()),
    });
    let overrides = match section.get("set") {
        Some(field) => field.section(problems).map(|set| {
            let over_ride = |(key, field): (&str, Field<'_>)| Override {
                key: key.to_owned(),
                value: field.node.to_toml().to_string(),
            };
            set.fields().map(over_ride).collect()
        }),
        None => Some(Vec::new()),
    };
    Some(Case {
        name: name?,
        overrides: overrides?,
    })
}

/// What the key `set` of a table sets, with the places in the file.
pub(super) fn set_assignments(table: &Table) -> Vec<Assignment> {
    let Some(Value::Table(set)) = table.get("set").map(|entry| &entry.node.value) else {
        return Vec::new();
    };
    set.iter()
        .map(|(key, entry)| Assignment {
            key: key.clone(),
            key_spot: entry.key_spot.clone(),
            node: entry.node.clone(),
        })
        .collect()
}

pub(super) fn read_converge(
    section: &Section<'_>,
    duration: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<ConvergeSettings> {
    section.allow_only(&["macro_steps", "reference"], problems);
    let macro_steps = section
        .require("macro_steps", "macro_steps = [1e-2, 1e-3, 1e-4]", problems)
        .and_then(|field| read_macro_steps(&field, duration, problems));
    let reference = section
        .get("reference")
        .map_or(Some(Reference::Automatic), |field| {
            field.choice(&REFERENCES, problems)
        });
    Some(ConvergeSettings {
        macro_steps: macro_steps?,
        reference: reference?,
    })
}

pub(super) fn read_macro_steps(
    field: &Field<'_>,
    duration: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<Vec<f64>> {
    let steps: Vec<Option<f64>> = field
        .items(STEPS, problems)?
        .iter()
        .map(|item| read_step(item, duration, problems))
        .collect();
    let steps = steps.into_iter().collect::<Option<Vec<f64>>>()?;
    let mut different = steps.clone();
    different.sort_by(f64::total_cmp);
    different.dedup();
    if steps.len() < 2 || different.len() < steps.len() {
        return field.wrong_type(STEPS, problems);
    }
    Some(steps)
}

pub(super) fn read_stability(
    section: &Section<'_>,
    problems: &mut Problems<'_>,
) -> Option<StabilitySettings> {
    section.allow_only(&["x", "y"], problems);
    let example = "{ key = \"coupling.macro_step\", from = 1e-4, to = 1e-2, points = 25 }";
    let mut axis = |name| {
        let field = section.require(name, example, problems)?;
        let axis = field.section(problems)?;
        read_axis(&axis, problems)
    };
    let (x, y) = (axis("x"), axis("y"));
    Some(StabilitySettings { x: x?, y: y? })
}

fn read_axis(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Axis> {
    let keys = section
        .require("key", "key = \"coupling.macro_step\"", problems)
        .and_then(|field| read_keys(&field, problems));
    let label = match section.get("label") {
        Some(field) => field.text(problems).map(|text| Some(text.to_owned())),
        None => Some(None),
    };
    let values = match section.get("values") {
        Some(field) => {
            section.allow_only(&["key", "label", "values"], problems);
            read_values(&field, problems)
        }
        None => {
            let allowed = ["key", "label", "values", "from", "to", "points", "scale"];
            section.allow_only(&allowed, problems);
            read_range(section, problems)
        }
    };
    let keys = keys?;
    let last_part = keys[0].rsplit('.').next().unwrap_or_default();
    Some(Axis {
        label: label?.unwrap_or_else(|| last_part.to_owned()),
        values: values?,
        keys,
    })
}

fn read_keys(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<String>> {
    if let Some(key) = field.peek_text() {
        return Some(vec![key.to_owned()]);
    }
    let keys = field.texts(KEYS_OF_AXIS, problems)?;
    Some(
        keys.iter()
            .filter_map(Field::peek_text)
            .map(str::to_owned)
            .collect(),
    )
}

fn read_values(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
    let items = field.items(VALUES, problems)?;
    if items.len() < 2 {
        return field.wrong_type(VALUES, problems);
    }
    let values: Vec<_> = items
        .iter()
        .map(|item| item.number(&FINITE, problems))
        .collect();
    values.into_iter().collect()
}

#[derive(Clone, Copy, PartialEq)]
enum Scale {
    Linear,
    Log,
}

fn read_range(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
    let scale = section.get("scale").map_or(Some(Scale::Linear), |field| {
        field.choice(&[("linear", Scale::Linear), ("log", Scale::Log)], problems)
    });
    let range = match scale {
        Some(Scale::Log) => &POSITIVE,
        _ => &FINITE,
    };
    let from = section
        .require("from", "from = 1e2", problems)
        .and_then(|field| field.number(range, problems));
    let to_field = section.require("to", "to = 1e6", problems);
    let to = to_field
        .as_ref()
        .and_then(|field| field.number(range, problems));
    let points = section
        .require("points", "points = 25", problems)
        .and_then(|field| field.whole(2, MOST_POINTS, problems));
    let (from, to, points, scale) = (from?, to?, points?, scale?);
    if from == to || !(to - from).is_finite() || !(to / from.abs().max(1.0)).is_finite() {
        return to_field?
            .out_of_range("another number than `from`, at a finite distance", problems);
    }
    Some(
        (0..points)
            .map(|i| grid_value(from, to, i, points - 1, scale))
            .collect(),
    )
}

/// Values from `from` up to `to` at equal distances; the keys may come in any order.
pub(super) fn read_linear_grid(
    section: &Section<'_>,
    problems: &mut Problems<'_>,
) -> Option<Vec<f64>> {
    section.allow_only(&["from", "to", "points"], problems);
    let mut values = read_range(section, problems)?;
    values.sort_by(f64::total_cmp);
    Some(values)
}

/// Values from `from` to `to`, both positive, at equal ratios.
pub(super) fn log_grid(from: f64, to: f64, points: usize) -> Vec<f64> {
    let value = |i| match i {
        0 => from,
        i => grid_value(from, to, i, points - 1, Scale::Log),
    };
    (0..points).map(value).collect()
}

fn grid_value(from: f64, to: f64, i: usize, last: usize, scale: Scale) -> f64 {
    if i == last {
        return to;
    }
    let part = i as f64 / last as f64;
    match scale {
        Scale::Linear => from + (to - from) * part,
        Scale::Log => (from.ln() * (1.0 - part) + to.ln() * part).exp(),
    }
}

/// What an axis sets to give its quantity a value; all at the place of the axis.
pub(super) fn axis_assignments(axis: &Axis, node: &Node, value: f64) -> Vec<Assignment> {
    let value = match toml_number(value) {
        toml::Value::Integer(whole) => Value::Integer(whole),
        _ => Value::Float(value),
    };
    let assignment = |key: &String| Assignment {
        key: key.clone(),
        key_spot: node.spot.clone(),
        node: Node {
            spot: node.spot.clone(),
            value: value.clone(),
        },
    };
    axis.keys.iter().map(assignment).collect()
}
