//! Reads `[[joint]]`.

use super::error_kind::{Names, SceneErrorKind};
use super::names::Registry;
use super::nearest::nearest;
use super::reader::{FINITE, Field, Problems, Section};
use super::resolved::{Joint, JointKind, Side};
use super::written::Value;

const KEYS: [&str; 5] = ["name", "kind", "a", "b", "multiplier"];
const KINDS: [(&str, JointKind); 2] = [
    ("rigid-link", JointKind::RigidLink),
    ("atpoint", JointKind::AtPoint),
];

pub(super) fn read(
    section: &Section<'_>,
    subsystems: &Registry<'_>,
    problems: &mut Problems<'_>,
) -> Option<Joint> {
    section.allow_only(&KEYS, problems);
    let name = section
        .require("name", "name = \"link\"", problems)
        .and_then(|field| field.name(problems));
    let kind = section
        .require("kind", "kind = \"rigid-link\"", problems)
        .and_then(|field| field.choice(&KINDS, problems));
    let a = section
        .require("a", "a = \"mass1\"", problems)
        .and_then(|field| read_side(&field, subsystems, problems));
    let b_field = section.require("b", "b = \"mass2\"", problems);
    let b = b_field
        .as_ref()
        .and_then(|field| read_side(field, subsystems, problems));
    let multiplier = match section.get("multiplier") {
        Some(field) => read_multipliers(&field, problems).map(Some),
        None => Some(None),
    };
    let joint = Joint {
        name: name?.to_owned(),
        kind: kind?,
        a: a?,
        b: b?,
        multiplier: multiplier?,
    };
    if joint.a.subsystem == joint.b.subsystem {
        let kind = SceneErrorKind::JoinedToItself {
            joint: joint.name,
            subsystem: subsystems.name(joint.a.subsystem),
        };
        b_field?.report(kind, problems);
        return None;
    }
    Some(joint)
}

/// One number, or a list of them.
fn read_multipliers(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
    if !matches!(field.node.value, Value::List(_)) {
        return field.number(&FINITE, problems).map(|number| vec![number]);
    }
    let fields = field.items("a number or a list of numbers", problems)?;
    fields
        .iter()
        .map(|field| field.number(&FINITE, problems))
        .collect()
}

fn read_side(
    field: &Field<'_>,
    subsystems: &Registry<'_>,
    problems: &mut Problems<'_>,
) -> Option<Side> {
    let text = field.text(problems)?;
    let (name, marker) = match text.split_once('.') {
        Some((name, marker)) => (name, Some(marker)),
        None => (text, None),
    };
    if marker.is_some_and(str::is_empty) {
        let kind = SceneErrorKind::InvalidReference {
            key: field.key.clone(),
            found: text.to_owned(),
            allowed: "SUBSYSTEM or SUBSYSTEM.MARKER",
        };
        field.report(kind, problems);
        return None;
    }
    Some(Side {
        subsystem: find_subsystem(name, field, subsystems, problems)?,
        marker: marker.map(str::to_owned),
    })
}

/// The place of a subsystem that a field refers to by name.
pub(super) fn find_subsystem(
    name: &str,
    field: &Field<'_>,
    subsystems: &Registry<'_>,
    problems: &mut Problems<'_>,
) -> Option<usize> {
    let found = subsystems.position(name);
    if found.is_none() {
        let known: Vec<&str> = subsystems.names().collect();
        let kind = SceneErrorKind::UnknownName {
            key: field.key.clone(),
            name: name.to_owned(),
            nearest: nearest(name, known.iter().copied()),
            known: Names::from(known.as_slice()),
        };
        field.report(kind, problems);
    }
    found
}
