//! Reads `[[joint]]`.

use super::resolved::{Geometry, Joint, JointKind, Side};
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::key::{FINITE, Key, Takes, texts};
use crate::reading::names::Registry;
use crate::reading::reader::{Field, Problems, Section, given};
use crate::reading::reference::find_name;
use crate::reading::written::Value;

pub(super) const KEYS: [Key; 11] = [
    Key::new("name", Takes::Name)
        .required("name = \"link\"")
        .means("names the result columns `NAME.lambda`, `NAME.residual.*`"),
    Key::new("kind", Takes::Choice(&texts(&KINDS)))
        .required("kind = \"rigid-link\"")
        .means("see below"),
    Key::new("a", Takes::Text)
        .required("a = \"mass1\"")
        .means(SIDE),
    Key::new("b", Takes::Text)
        .required("b = \"mass2\"")
        .means(SIDE),
    Key::new("point_a", VECTOR)
        .default("the marker")
        .means(POINT),
    Key::new("point_b", VECTOR)
        .default("the marker")
        .means(POINT),
    Key::new("axis_a", VECTOR)
        .default("required where it has one")
        .means(AXIS),
    Key::new("axis_b", VECTOR)
        .default("required where it has one")
        .means(AXIS),
    Key::new("attitude", VECTOR)
        .default("`[1, 0, 0, 0]`")
        .means(
            "orientation, translational, weld in space: attitude of marker a in the axes of \
             marker b, a quaternion `[w, x, y, z]`",
        ),
    Key::new("angle", Takes::Number(FINITE))
        .default("0")
        .means("the same in the plane: angle of a minus angle of b, rad"),
    Key::new(
        "multiplier",
        Takes::Either(&[
            Takes::Number(FINITE),
            Takes::List(&Takes::Number(FINITE), "a number or a list of numbers"),
        ]),
    )
    .default("computed")
    .means(
        "lambda at the start, one for each condition of the joint; all joints give it, or \
         none",
    ),
];
const VECTOR: Takes = Takes::List(
    &Takes::Number(FINITE),
    "a list of numbers such as [0.5, 0.0]",
);
const SIDE: &str = "`\"SUBSYSTEM\"`, or `\"SUBSYSTEM.MARKER\"` if it has several markers of the partner's kind; `\"ground\"`, \
                    which needs no `[[subsystem]]`, is the origin of the inertial axes";
const POINT: &str = "point of the joint in the axes of its marker, m";
const AXIS: &str = "axis of the joint in the axes of its marker, of any length";
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
    let [
        name,
        kind,
        a,
        b_field,
        point_a,
        point_b,
        axis_a,
        axis_b,
        attitude,
        angle,
        multiplier,
    ] = section.read(&KEYS, problems);
    let name = name.and_then(|field| field.name(problems));
    let kind = kind.and_then(|field| field.choice(&KINDS, problems));
    let a = a.and_then(|field| read_side(&field, subsystems, problems));
    let b = b_field
        .as_ref()
        .and_then(|field| read_side(field, subsystems, problems));
    let multiplier = given(multiplier, |field| match field.node.value {
        Value::List(_) => field.numbers(problems),
        _ => field.number(problems).map(|number| vec![number]),
    });
    let [point_a, point_b, axis_a, axis_b, attitude] = [point_a, point_b, axis_a, axis_b, attitude]
        .map(|field| given(field, |field| field.numbers(problems)));
    let angle = given(angle, |field| field.number(problems));
    let geometry = Geometry {
        points: [point_a?, point_b?],
        axes: [axis_a?, axis_b?],
        attitude: attitude?,
        angle: angle?,
    };
    let joint = Joint {
        geometry,
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

/// Whether a joint of these tables has this end.
pub(super) fn any_to(name: &str, tables: &[Section<'_>]) -> bool {
    let mut ends = tables
        .iter()
        .flat_map(|table| ["a", "b"].map(|end| table.find(end)));
    ends.any(|end| {
        let text = end.as_ref().and_then(Field::peek_text);
        text.is_some_and(|text| text.split('.').next() == Some(name))
    })
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
