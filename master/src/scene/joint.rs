//! Reads `[[joint]]`.

use super::resolved::{Geometry, Joint, JointKind, Side};
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::lists::collect;
use crate::reading::names::Registry;
use crate::reading::reader::{FINITE, Field, Problems, Section};
use crate::reading::reference::find_name;
use crate::reading::written::Value;

const KEYS: [&str; 11] = [
    "name",
    "kind",
    "a",
    "b",
    "point_a",
    "point_b",
    "axis_a",
    "axis_b",
    "attitude",
    "angle",
    "multiplier",
];
const KINDS: [(&str, JointKind); 12] = [
    ("rigid-link", JointKind::RigidLink),
    ("atpoint", JointKind::AtPoint),
    ("inplane", JointKind::InPlane),
    ("perpendicular", JointKind::Perpendicular),
    ("universal", JointKind::Universal),
    ("revolute", JointKind::Revolute),
    ("cylindrical", JointKind::Cylindrical),
    ("planar", JointKind::Planar),
    ("inline", JointKind::Inline),
    ("orientation", JointKind::Orientation),
    ("translational", JointKind::Translational),
    ("weld", JointKind::Weld),
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
    let geometry = read_geometry(section, problems);
    let joint = Joint {
        geometry: geometry?,
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

fn read_geometry(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Geometry> {
    let mut list = |key: &str| match section.get(key) {
        Some(field) => read_vector(&field, problems).map(Some),
        None => Some(None),
    };
    let points = [list("point_a"), list("point_b")];
    let axes = [list("axis_a"), list("axis_b")];
    let attitude = list("attitude");
    let angle = match section.get("angle") {
        Some(field) => field.number(&FINITE, problems).map(Some),
        None => Some(None),
    };
    let [point_a, point_b] = points;
    let [axis_a, axis_b] = axes;
    Some(Geometry {
        points: [point_a?, point_b?],
        axes: [axis_a?, axis_b?],
        attitude: attitude?,
        angle: angle?,
    })
}

fn read_vector(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
    let components = field.items("a list of numbers such as [0.5, 0.0]", problems)?;
    collect(&components, |component| component.number(&FINITE, problems))
}

/// One number, or a list of them.
fn read_multipliers(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
    if !matches!(field.node.value, Value::List(_)) {
        return field.number(&FINITE, problems).map(|number| vec![number]);
    }
    let fields = field.items("a number or a list of numbers", problems)?;
    collect(&fields, |field| field.number(&FINITE, problems))
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
        subsystem: find_name(name, field, subsystems, problems)?,
        marker: marker.map(str::to_owned),
    })
}
