//! Markers of an FMU, which has none of its own: the scene says which variables are their components.
//!
//! Parameters `marker.NAME.kind`, `marker.NAME.names` and `marker.NAME.COMPONENT`, all of them texts.

use std::collections::BTreeMap;

use linchpin_proto::v1::{self, MarkerKind, value::Kind as Written};
use linchpin_worker::setup::SetupError;

use crate::description::{Description, Kind, Role, Variable};
use crate::names;

/// What the names of parameters of markers begin with.
pub const TABLE: &str = "marker.";

/// The place of a component's name in `names`.
const COMPONENT: &str = "*";

/// The components of a kind of markers, by position, velocity, acceleration and load, in the order of [`v1::Marker`].
struct Form {
    name: &'static str,
    kind: MarkerKind,
    components: [&'static [&'static str]; 4],
}

const FORMS: [Form; 3] = [
    Form {
        name: "scalar",
        kind: MarkerKind::Scalar,
        components: [&["x"], &["v"], &["a"], &["f"]],
    },
    Form {
        name: "planar",
        kind: MarkerKind::Planar,
        components: [
            &["x", "y", "angle"],
            &["vx", "vy", "rate"],
            &["ax", "ay", "alpha"],
            &["fx", "fy", "moment"],
        ],
    },
    Form {
        name: "spatial",
        kind: MarkerKind::Spatial,
        components: [
            &["x", "y", "z", "qw", "qx", "qy", "qz"],
            &["vx", "vy", "vz", "omega_x", "omega_y", "omega_z"],
            &["ax", "ay", "az", "alpha_x", "alpha_y", "alpha_z"],
            &["fx", "fy", "fz", "moment_x", "moment_y", "moment_z"],
        ],
    },
];

/// Place of loads among the components.
const LOAD: usize = 3;

/// The keys of a marker, for a description without one.
pub fn keys() -> Vec<v1::Parameter> {
    let key = |name: &str, description: &str| v1::Parameter {
        name: format!("{TABLE}NAME.{name}"),
        description: description.to_owned(),
        ..Default::default()
    };
    vec![
        key("kind", "\"scalar\", \"planar\" or \"spatial\""),
        key(
            "names",
            "names of variables with * for the component, e.g. \"tip_*\"; those that there are, are mapped",
        ),
        key(
            "COMPONENT",
            "name of the variable that is this component. scalar: x, v, a, f; planar: x, y, angle, vx, vy, rate, ax, ay, alpha, fx, fy, moment; \
             spatial: x, y, z, qw, qx, qy, qz, vx, vy, vz, omega_x, .., ax, ay, az, alpha_x, .., fx, fy, fz, moment_x, ..",
        ),
    ]
}

/// The markers that the parameters of a scene describe.
///
/// # Errors
/// [`SetupError`] with the place of what is wrong.
pub fn markers(
    description: &Description,
    parameters: &BTreeMap<String, v1::Value>,
) -> Result<Vec<v1::Marker>, SetupError> {
    let mut tables: BTreeMap<&str, BTreeMap<&str, &str>> = BTreeMap::new();
    for (name, value) in parameters {
        let Some(rest) = name.strip_prefix(TABLE) else {
            continue;
        };
        let field = format!("parameters.{name}");
        let Some((marker, key)) = rest.split_once('.') else {
            let reason = "it must be marker.NAME.KEY, with KEY kind, names or a component";
            return Err(refused(field, reason.to_owned()));
        };
        let Some(Written::Text(text)) = &value.kind else {
            return Err(SetupError::WrongType {
                field,
                expected: "a text",
            });
        };
        tables.entry(marker).or_default().insert(key, text);
    }
    { tables.iter() }
        .map(|(name, keys)| marker(description, name, keys))
        .collect()
}

fn marker(
    description: &Description,
    name: &str,
    keys: &BTreeMap<&str, &str>,
) -> Result<v1::Marker, SetupError> {
    let place = |key: &str| format!("parameters.{TABLE}{name}.{key}");
    let kind = keys.get("kind").ok_or_else(|| SetupError::Missing {
        field: place("kind"),
    })?;
    let form = FORMS.iter().find(|form| form.name == *kind);
    let form = form.ok_or_else(|| SetupError::UnknownText {
        field: place("kind"),
        value: (*kind).to_owned(),
        known: "scalar, planar, spatial".to_owned(),
    })?;
    let components = form.components.iter().flat_map(|list| list.iter().copied());
    let known: Vec<&str> = ["kind", "names"].into_iter().chain(components).collect();
    if let Some(key) = keys.keys().find(|key| !known.contains(*key)) {
        let near = names::known(key, known.iter().copied());
        let reason = format!("a {kind} marker has no \"{key}\"; {near}");
        return Err(refused(place(key), reason));
    }
    let pattern = keys.get("names").copied();
    if pattern.is_some_and(|pattern| pattern.matches(COMPONENT).count() != 1) {
        let reason = "it must have one * for the component, as in \"tip_*\"";
        return Err(refused(place("names"), reason.to_owned()));
    }
    let mut lists: [Vec<String>; 4] = Default::default();
    for (number, components) in form.components.iter().enumerate() {
        let mut gap = None;
        for component in *components {
            let found = match (keys.get(component), pattern) {
                (Some(written), _) => Some(
                    find(description, written, number == LOAD)
                        .map_err(|reason| refused(place(component), reason))?,
                ),
                (None, Some(pattern)) => {
                    let written = pattern.replace(COMPONENT, component);
                    match description.variable(&written) {
                        Some(_) => {
                            let found = find(description, &written, number == LOAD);
                            Some(found.map_err(|reason| refused(place("names"), reason))?)
                        }
                        None => None,
                    }
                }
                (None, None) => None,
            };
            match (found, gap) {
                (Some(variable), None) => lists[number].push(variable.name.clone()),
                (Some(_), Some(missing)) => {
                    let reason = format!(
                        "{component} is mapped and {missing} before it is not; map it as well"
                    );
                    return Err(refused(place(component), reason));
                }
                (None, _) => gap = gap.or(Some(*component)),
            }
        }
    }
    let [position, velocity, acceleration, load] = lists;
    if position.is_empty() {
        let first = form.components[0][0];
        let reason = match pattern {
            Some(pattern) => {
                let wanted = pattern.replace(COMPONENT, first);
                let near = names::known(&wanted, reals(description, false));
                format!("this FMU has no variable \"{wanted}\"; {near}")
            }
            None => "the marker has no position; map it, or write names".to_owned(),
        };
        let key = if pattern.is_some() { "names" } else { first };
        return Err(refused(place(key), reason));
    }
    Ok(v1::Marker {
        name: name.to_owned(),
        kind: form.kind.into(),
        position,
        velocity,
        acceleration,
        load,
    })
}

/// The variable of a component.
fn find<'a>(
    description: &'a Description,
    name: &str,
    is_load: bool,
) -> Result<&'a Variable, String> {
    let variable = description.variable(name).ok_or_else(|| {
        let near = names::known(name, reals(description, is_load));
        format!("this FMU has no variable \"{name}\"; {near}")
    })?;
    if variable.kind != Kind::Real {
        return Err(format!("\"{name}\" is no Real or Float64"));
    }
    if is_load && variable.role != Role::Input {
        let near = names::known(name, reals(description, true));
        return Err(format!(
            "\"{name}\" is no input, and a load must act on one; {near}"
        ));
    }
    match variable.scale {
        None => Ok(variable),
        Some([factor, offset]) => Err(format!(
            "\"{name}\" has the unit {}, which is {factor} of the SI unit{}; markers take SI units: convert it in the FMU",
            variable.unit,
            match offset {
                0.0 => String::new(),
                offset => format!(" with an offset of {offset}"),
            }
        )),
    }
}

fn reals(description: &Description, are_inputs: bool) -> impl Iterator<Item = &str> {
    let all = description.variables.iter();
    all.filter(move |own| own.kind == Kind::Real && (own.role == Role::Input) == are_inputs)
        .map(|own| own.name.as_str())
}

fn refused(field: String, reason: String) -> SetupError {
    SetupError::Refused { field, reason }
}
