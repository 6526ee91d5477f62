//! The tables and keys of a composition.

use super::dimension::Dimension;

/// One key of one table. Plain keys stand in the table `""`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// Name of the table.
    pub table: &'static str,
    /// Name of the key.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Meaning, range and default.
    pub description: &'static str,
}

const fn key(
    table: &'static str,
    name: &'static str,
    unit: &'static str,
    description: &'static str,
) -> Key {
    Key {
        table,
        name,
        unit,
        description,
    }
}

/// Keys that mean the same in the plane and in space.
const COMMON: [Key; 34] = [
    key(
        "",
        "formulation",
        "",
        "\"absolute\" (default): coordinates of every body and reactions of every joint; \"minimal\": coordinates of the joints, for trees",
    ),
    key("body", "m", "kg", "required; mass, greater than 0"),
    key(
        "body",
        "position",
        "m",
        "centre of mass at the start; zeros if absent",
    ),
    key(
        "body",
        "velocity",
        "m/s",
        "velocity of the centre of mass at the start; zeros if absent",
    ),
    key(
        "marker",
        "body",
        "",
        "required; name of a body, or \"ground\"",
    ),
    key(
        "marker",
        "point",
        "m",
        "place in the axes of the body, from its centre of mass; zeros if absent",
    ),
    key("joint", "a", "", "required; name of a body, or \"ground\""),
    key(
        "joint",
        "b",
        "",
        "required; name of another body, or \"ground\"",
    ),
    key(
        "joint",
        "point",
        "m",
        "place of the joint in inertial axes at the start",
    ),
    key(
        "joint",
        "point_a",
        "m",
        "instead of point, with point_b: place on a in its axes, from its centre of mass",
    ),
    key(
        "joint",
        "point_b",
        "m",
        "instead of point, with point_a: place on b in its axes, from its centre of mass",
    ),
    key(
        "joint",
        "axis",
        "",
        "direction in inertial axes at the start, of any length",
    ),
    key("spring", "a", "", "required; name of a body, or \"ground\""),
    key(
        "spring",
        "b",
        "",
        "required; name of another body, or \"ground\"",
    ),
    key(
        "spring",
        "point_a",
        "m",
        "end on a in its axes, from its centre of mass; zeros if absent",
    ),
    key(
        "spring",
        "point_b",
        "m",
        "end on b in its axes, from its centre of mass; zeros if absent",
    ),
    key("spring", "stiffness", "N/m", "0 or greater; 0 if absent"),
    key("spring", "damping", "N s/m", "0 or greater; 0 if absent"),
    key(
        "spring",
        "rest_length",
        "m",
        "distance at which the spring is relaxed, 0 or greater; that at the start if absent",
    ),
    key(
        "torsion-spring",
        "stiffness",
        "N m/rad",
        "0 or greater; 0 if absent",
    ),
    key(
        "torsion-spring",
        "damping",
        "N m s/rad",
        "0 or greater; 0 if absent",
    ),
    key(
        "motion",
        "joint",
        "",
        "a revolute or prismatic joint whose angle (rad) or displacement (m) is offset + speed t + amplitude sin(2 pi frequency t + phase)",
    ),
    key(
        "motion",
        "body",
        "",
        "instead of joint: a body of which a point moves so along direction",
    ),
    key(
        "motion",
        "point",
        "m",
        "that point in the axes of the body, from its centre of mass; zeros if absent",
    ),
    key(
        "motion",
        "direction",
        "",
        "that direction in inertial axes, of any length; what moves so is the component of the point's position",
    ),
    key(
        "motion",
        "offset",
        "m or rad",
        "if absent: what makes the motion fit the start",
    ),
    key("motion", "speed", "m/s or rad/s", "0 if absent"),
    key("motion", "amplitude", "m or rad", "0 if absent"),
    key("motion", "frequency", "Hz", "0 or greater; 0 if absent"),
    key("motion", "phase", "rad", "0 if absent"),
    key("joint", "kind", "", "required"),
    key("body", "inertia", "kg m^2", "required; greater than 0"),
    key(
        "torsion-spring",
        "rest_angle",
        "rad",
        "angle at which the spring is relaxed; 0 if absent",
    ),
    key(
        "",
        "gravity",
        "m/s^2",
        "acceleration of gravity: its size, along the last axis downwards, or all components; 9.81 if absent",
    ),
];

/// Keys that only the plane has.
const PLANE: [Key; 5] = [
    key(
        "body",
        "angle",
        "rad",
        "from the x axis at the start; 0 if absent",
    ),
    key(
        "body",
        "rate",
        "rad/s",
        "rate of the angle at the start; 0 if absent",
    ),
    key(
        "marker",
        "angle",
        "rad",
        "from the body's x axis to that of the marker; 0 if absent",
    ),
    key(
        "torsion-spring",
        "a",
        "",
        "required; name of a body, or \"ground\". The spring feels the angle of b minus that of a",
    ),
    key(
        "torsion-spring",
        "b",
        "",
        "required; name of another body, or \"ground\"",
    ),
];

/// Keys that only space has.
const SPACE: [Key; 5] = [
    key(
        "body",
        "attitude",
        "1",
        "quaternion w, x, y, z from the principal axes to inertial ones at the start, of any length; no turn if absent",
    ),
    key(
        "body",
        "omega",
        "rad/s",
        "angular velocity about the principal axes at the start; zeros if absent",
    ),
    key(
        "marker",
        "attitude",
        "1",
        "quaternion w, x, y, z from the axes of the marker to those of the body, of any length; no turn if absent",
    ),
    key(
        "joint",
        "second_axis",
        "",
        "of a universal joint: the axis that b holds, in inertial axes at the start; axis is that of a",
    ),
    key(
        "torsion-spring",
        "joint",
        "",
        "required; the revolute joint whose angle, 0 at the start, the spring feels",
    ),
];

impl Dimension {
    /// All keys of a composition.
    pub fn keys(self) -> impl Iterator<Item = &'static Key> {
        let own = match self {
            Self::Plane => &PLANE,
            Self::Space => &SPACE,
        };
        COMMON.iter().chain(own)
    }

    /// Names of the keys of a table.
    pub fn keys_of(self, table: &str) -> Vec<&'static str> {
        let own = self.keys().filter(|key| key.table == table);
        own.map(|key| key.name).collect()
    }
}

impl Key {
    /// Its dotted name with this entry, or with NAME in its place.
    pub fn dotted(&self, entry: Option<&str>) -> String {
        match (self.table, entry) {
            ("", _) => self.name.to_owned(),
            (table, entry) => format!("{table}.{}.{}", entry.unwrap_or("NAME"), self.name),
        }
    }
}
