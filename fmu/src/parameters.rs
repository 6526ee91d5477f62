//! Parameters of an FMU: variables that may be set before the start.

use std::collections::BTreeMap;

use linchpin_proto::v1::{self, value::Kind as Written};
use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;

use crate::description::{Description, Kind, Variable};
use crate::library::StartValue;
use crate::markers::TABLE;
use crate::names;

/// All parameters, without a scene.
pub fn all(description: &Description) -> Vec<v1::Parameter> {
    settable(description).map(described).collect()
}

/// The parameters of a scene that gives these: a text that it leaves out keeps its start value.
pub fn given(
    description: &Description,
    parameters: &BTreeMap<String, v1::Value>,
) -> Vec<v1::Parameter> {
    let is_given = |name: &str| parameters.contains_key(name);
    let own = settable(description).filter(|own| own.number().is_some() || is_given(&own.name));
    let markers = parameters.keys().filter(|name| name.starts_with(TABLE));
    let markers = markers.map(|name| v1::Parameter {
        name: name.clone(),
        ..Default::default()
    });
    own.map(described).chain(markers).collect()
}

fn settable(description: &Description) -> impl Iterator<Item = &Variable> {
    description.variables.iter().filter(|own| own.is_settable)
}

fn described(own: &Variable) -> v1::Parameter {
    let kind = match (own.kind, &own.start) {
        (Kind::Real, _) => String::new(),
        (Kind::Integer | Kind::Long, _) => "a whole number".to_owned(),
        (Kind::Boolean, _) => "true or false".to_owned(),
        (Kind::Text, Some(start)) => format!("a text; \"{start}\" if absent"),
        (Kind::Text, None) => "a text".to_owned(),
    };
    let parts = [own.description.as_str(), &kind];
    let parts: Vec<&str> = { parts.into_iter() }
        .filter(|part| !part.is_empty())
        .collect();
    v1::Parameter {
        name: own.name.clone(),
        unit: own.unit.clone(),
        description: parts.join("; "),
        default: own.number(),
    }
}

/// Refuses names that cannot be set.
pub fn check(
    description: &Description,
    parameters: &BTreeMap<String, v1::Value>,
) -> Result<(), SetupError> {
    for name in parameters.keys().filter(|name| !name.starts_with(TABLE)) {
        let reason = match description.variable(name) {
            Some(variable) if variable.is_settable => continue,
            Some(_) => "this variable of the FMU cannot be set: it is neither a parameter nor has initial = \"exact\"".to_owned(),
            None => {
                let near = names::known(name, settable(description).map(|own| own.name.as_str()));
                format!("the FMU has no such parameter; {near}")
            }
        };
        let field = format!("parameters.{name}");
        return Err(SetupError::Refused { field, reason });
    }
    Ok(())
}

/// What has to be set before the start: what is not at its start value.
pub fn start_values(
    description: &Description,
    setup: &Setup,
) -> Result<Vec<StartValue>, SetupError> {
    let mut values = Vec::new();
    for variable in settable(description) {
        let Some(written) = setup.all_parameters().get(&variable.name) else {
            continue;
        };
        let value = start_value(variable, written.kind.as_ref())?;
        let is_start = match variable.kind {
            Kind::Text => variable.start.as_deref() == Some(&value.text),
            _ => variable.number() == Some(value.number),
        };
        if !is_start {
            values.push(value);
        }
    }
    Ok(values)
}

fn start_value(variable: &Variable, written: Option<&Written>) -> Result<StartValue, SetupError> {
    let field = || format!("parameters.{}", variable.name);
    let mut value = StartValue {
        reference: variable.reference,
        kind: variable.kind,
        number: 0.0,
        text: String::new(),
    };
    let expected = match (variable.kind, written) {
        (Kind::Text, Some(Written::Text(text))) => {
            value.text.clone_from(text);
            return Ok(value);
        }
        (Kind::Text, _) => "a text",
        (Kind::Boolean, Some(Written::Flag(flag))) => {
            value.number = f64::from(u8::from(*flag));
            return Ok(value);
        }
        (Kind::Boolean, Some(Written::Number(number))) if [0.0, 1.0].contains(number) => {
            value.number = *number;
            return Ok(value);
        }
        (Kind::Boolean, _) => "true or false",
        (Kind::Real, Some(Written::Number(number))) if number.is_finite() => {
            value.number = *number;
            return Ok(value);
        }
        (Kind::Real, _) => "a finite number",
        (kind, Some(Written::Number(number))) if number.fract() == 0.0 => {
            let largest = match kind {
                Kind::Integer => f64::from(i32::MAX),
                // The largest size up to which a number of double precision tells whole numbers apart.
                _ => 9_007_199_254_740_992.0,
            };
            if number.abs() <= largest {
                value.number = *number;
                return Ok(value);
            }
            return Err(SetupError::OutOfRange {
                field: field(),
                value: *number,
                allowed: "it is too large for the integer type of the FMU",
            });
        }
        _ => "a whole number",
    };
    Err(SetupError::WrongType {
        field: field(),
        expected,
    })
}
