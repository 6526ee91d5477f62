//! Reads the studies over a scene: `[[case]]`, `[converge]` and `[stability]`.

use super::assign::Assignment;
use super::resolved::{Axis, Case, ConvergeSettings, Reference, StabilitySettings, toml_number};
use super::step_control::read_equal_step;
use crate::reading::key::{FINITE, Key, POSITIVE, Takes, texts};
use crate::reading::overrides::Override;
use crate::reading::reader::{Field, Problems, Section, choice, collect, given};
use crate::reading::written::{Node, Table, Value};

pub(super) const CASE: [Key; 2] = [
    Key::new("name", Takes::Text)
        .required("name = \"index 1\"")
        .means("names the case and its folder"),
    SET,
];
pub(super) const SET: Key = Key::new("set", Takes::Open(&[])).default("nothing").means(
    "dotted keys and their values, as in [changes from the command \
     line](scene.md#changes-from-the-command-line)",
);
pub(super) const MACRO_STEPS: Key = Key::new(
    "macro_steps",
    Takes::List(
        &Takes::Number(POSITIVE),
        "a list of two or more different macro steps",
    ),
)
.required("macro_steps = [1e-2, 1e-3, 1e-4]")
.means("two or more different macro steps, s");
pub(super) const CONVERGE: [Key; 2] = [
    MACRO_STEPS,
    Key::new("reference", Takes::Choice(&texts(&REFERENCES)))
        .default_first()
        .means("what is compared with; `\"automatic\"`: the first of the others that there is"),
];
const REFERENCES: [(&str, Reference); 4] = [
    ("automatic", Reference::Automatic),
    ("closed-form", Reference::ClosedForm),
    ("monolithic", Reference::Monolithic),
    ("finest", Reference::Finest),
];
pub(super) const STABILITY: [Key; 2] = [map_axis("x"), map_axis("y")];

const fn map_axis(name: &'static str) -> Key {
    Key::new(name, Takes::Table(|| AXIS.to_vec()))
        .required("{ key = \"coupling.macro_step\", from = 1e-4, to = 1e-2, points = 25 }")
        .means("an axis of the map")
}

const AXIS: [Key; 7] = [
    Key::new(
        "key",
        Takes::Either(&[
            Takes::Text,
            Takes::List(
                &Takes::Text,
                "a key such as \"coupling.beta\", or a list of keys",
            ),
        ]),
    )
    .required("key = \"coupling.macro_step\"")
    .means("the dotted keys that vary, all with one value"),
    Key::new("label", Takes::Text)
        .default("last part of `key`")
        .means("label of the axis"),
    Key::new(
        "values",
        Takes::List(&Takes::Number(FINITE), "a list of two or more numbers"),
    )
    .default("")
    .means("the values; or else"),
    LINEAR_GRID[0].default(WITHOUT_VALUES),
    LINEAR_GRID[1].default(WITHOUT_VALUES),
    LINEAR_GRID[2].default(WITHOUT_VALUES),
    SCALE,
];
const WITHOUT_VALUES: &str = "required without `values`";
/// Values from the first to the last at equal distances.
pub(super) const LINEAR_GRID: [Key; 3] = [
    Key::new("from", Takes::Number(FINITE))
        .required("from = 1e2")
        .means("the first value"),
    Key::new("to", Takes::Number(FINITE))
        .required("to = 1e6")
        .means("the last value"),
    Key::new("points", Takes::Whole(2, MOST_POINTS))
        .required("points = 25")
        .means("how many there are"),
];
const SCALE: Key = Key::new("scale", Takes::Choice(&texts(&SCALES)))
    .default_first()
    .means("`\"linear\"`: equal distances; `\"log\"`: equal ratios");
const SCALES: [(&str, Scale); 2] = [("linear", Scale::Linear), ("log", Scale::Log)];
/// A map has at most this many points along an axis.
const MOST_POINTS: usize = 1000;

pub(super) fn read_case(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Case> {
    let [name, set] = section.read(&CASE, problems);
    let name = name.and_then(|field| field.filled_text(problems));
    let overrides = given(set, |field| {
        let over_ride = |(key, field): (&str, Field<'_>)| Override {
            key: key.to_owned(),
            value: field.node.to_toml().to_string(),
        };
        Some(field.section(problems)?.entries().map(over_ride).collect())
    });
    Some(Case {
        name: name?,
        overrides: overrides?.unwrap_or_default(),
    })
}

/// What the key `set` of a table sets, with the places in the file.
pub(super) fn set_assignments(table: &Table) -> Vec<Assignment> {
    let Some(Value::Table(set)) = table.get(SET.name).map(|entry| &entry.node.value) else {
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
    let [macro_steps, reference] = section.read(&CONVERGE, problems);
    let macro_steps = macro_steps.and_then(|field| read_macro_steps(&field, duration, problems));
    let reference = choice(reference, &REFERENCES, problems);
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
    let steps = collect(&field.items(problems)?, |item| {
        read_equal_step(item, duration, problems)
    })?;
    let mut different = steps.clone();
    different.sort_by(f64::total_cmp);
    different.dedup();
    if steps.len() < 2 || different.len() < steps.len() {
        return field.refuse(&field.list().1, problems);
    }
    Some(steps)
}

pub(super) fn read_stability(
    section: &Section<'_>,
    problems: &mut Problems<'_>,
) -> Option<StabilitySettings> {
    let [x, y] = section.read(&STABILITY, problems);
    let mut axis = |field: Option<Field<'_>>| {
        let axis = field?.section(problems)?;
        read_axis(&axis, problems)
    };
    let (x, y) = (axis(x), axis(y));
    Some(StabilitySettings { x: x?, y: y? })
}

fn read_axis(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Axis> {
    let [key, label, values, ..] = section.fields(&AXIS, problems);
    let keys = key.and_then(|field| read_keys(&field, problems));
    let label = given(label, |field| field.text(problems).map(str::to_owned));
    let values = match values {
        Some(field) => {
            section.allow_only(&AXIS[..3], problems);
            read_values(&field, problems)
        }
        None => {
            section.allow_only(&AXIS, problems);
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
    let keys = field.texts(problems)?;
    collect(&keys, |key| key.text(problems).map(str::to_owned))
}

fn read_values(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
    if field.items(problems)?.len() < 2 {
        return field.refuse(&field.list().1, problems);
    }
    field.numbers(problems)
}

#[derive(Clone, Copy, PartialEq)]
enum Scale {
    Linear,
    Log,
}

fn read_range(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
    let [from, to_field, points] = section.fields(&LINEAR_GRID, problems);
    let scale = choice(section.get(&SCALE), &SCALES, problems);
    let range = match scale {
        Some(Scale::Log) => &POSITIVE,
        _ => &FINITE,
    };
    let from = from.and_then(|field| field.number_within(range, problems));
    let to = to_field
        .as_ref()
        .and_then(|field| field.number_within(range, problems));
    let points = points.and_then(|field| field.whole(problems));
    let (from, to, points, scale) = (from?, to?, points?, scale?);
    if from == to || !(to - from).is_finite() || !(to / from.abs().max(1.0)).is_finite() {
        return to_field?.refuse("another number than `from`, at a finite distance", problems);
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
    section.allow_only(&LINEAR_GRID, problems);
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
