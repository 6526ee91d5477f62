//! Reads the tree of a description.

use std::collections::BTreeMap;

use super::xml::Element;
use super::{Abilities, Description, Kind, Role, Variable, Version};

/// Factor and offset to SI by the name of a unit, and the units of declared types.
struct Units<'a> {
    scales: BTreeMap<&'a str, [f64; 2]>,
    types: BTreeMap<&'a str, &'a str>,
}

pub(super) fn description(root: &Element) -> Result<Description, String> {
    if root.name != "fmiModelDescription" {
        return Err(format!(
            "its root is <{}>, and must be <fmiModelDescription>",
            root.name
        ));
    }
    let version = version(needed(root, "fmiVersion")?)?;
    let simulation = root.child("CoSimulation").ok_or_else(|| {
        let others = ["ModelExchange", "ScheduledExecution"];
        let others: Vec<&str> = { others.into_iter() }
            .filter(|name| root.child(name).is_some())
            .collect();
        format!(
            "it is not for co-simulation: there is no <CoSimulation>, only {}; export it for co-simulation",
            match others[..] {
                [] => "nothing that could be run".to_owned(),
                _ => others.join(", "),
            }
        )
    })?;
    let token = match version {
        Version::Two => needed(root, "guid")?,
        Version::Three => needed(root, "instantiationToken")?,
    };
    let library = needed(simulation, "modelIdentifier")?;
    if library.is_empty() || library.contains(['/', '\\', '\0']) || library == ".." {
        return Err(format!(
            "modelIdentifier = \"{library}\" is no name of a library"
        ));
    }
    let tolerance = root
        .child("DefaultExperiment")
        .and_then(|own| own.attribute("tolerance"));
    Ok(Description {
        version,
        name: needed(root, "modelName")?.to_owned(),
        text: optional(root, "description"),
        token: token.to_owned(),
        library: library.to_owned(),
        abilities: abilities(version, simulation),
        tolerance: tolerance
            .and_then(|text| text.trim().parse().ok())
            .filter(|value| *value > 0.0 && f64::is_finite(*value)),
        variables: variables(root, version)?,
    })
}

fn version(text: &str) -> Result<Version, String> {
    match text.split('.').next() {
        Some("2") => Ok(Version::Two),
        Some("3") => Ok(Version::Three),
        _ => Err(format!("fmiVersion = \"{text}\"; 2.0 and 3.0 are served")),
    }
}

fn abilities(version: Version, simulation: &Element) -> Abilities {
    let flag = |name| matches!(simulation.attribute(name), Some("true" | "1"));
    Abilities {
        keeps_states: flag("canGetAndSetFMUstate") || flag("canGetAndSetFMUState"),
        serializes_states: flag("canSerializeFMUstate") || flag("canSerializeFMUState"),
        takes_input_derivatives: version == Version::Two && flag("canInterpolateInputs"),
        updates_inside: version == Version::Three && flag("providesIntermediateUpdate"),
        varies_steps: flag("canHandleVariableCommunicationStepSize"),
        once_per_process: flag("canBeInstantiatedOnlyOncePerProcess"),
    }
}

fn variables(root: &Element, version: Version) -> Result<Vec<Variable>, String> {
    let units = Units::of(root, version);
    let all = root.inside("ModelVariables").iter();
    all.filter_map(|element| match version {
        Version::Two => variable_of_2(element, &units).transpose(),
        Version::Three => variable_of_3(element, &units).transpose(),
    })
    .collect()
}

/// `<ScalarVariable name=.. valueReference=..><Real start=../></ScalarVariable>`.
fn variable_of_2(element: &Element, units: &Units<'_>) -> Result<Option<Variable>, String> {
    let kinds = [
        ("Real", Kind::Real),
        ("Integer", Kind::Integer),
        ("Enumeration", Kind::Integer),
        ("Boolean", Kind::Boolean),
        ("String", Kind::Text),
    ];
    let typed =
        { kinds.iter() }.find_map(|(name, kind)| element.child(name).map(|typed| (typed, *kind)));
    match typed {
        Some((typed, kind)) => variable(element, typed, kind, units).map(Some),
        None => Ok(None),
    }
}

/// `<Float64 name=.. valueReference=.. start=../>`; arrays are left out.
fn variable_of_3(element: &Element, units: &Units<'_>) -> Result<Option<Variable>, String> {
    let kind = match element.name.as_str() {
        "Float64" => Kind::Real,
        "Int32" => Kind::Integer,
        "Int64" | "Enumeration" => Kind::Long,
        "Boolean" => Kind::Boolean,
        "String" => Kind::Text,
        _ => return Ok(None),
    };
    if element.child("Dimension").is_some() {
        return Ok(None);
    }
    let mut own = variable(element, element, kind, units)?;
    if let Some(start) = element.child("Start").filter(|_| kind == Kind::Text) {
        own.start = start.attribute("value").map(str::to_owned);
    }
    Ok(Some(own))
}

fn variable(
    element: &Element,
    typed: &Element,
    kind: Kind,
    units: &Units<'_>,
) -> Result<Variable, String> {
    let name = needed(element, "name")?.to_owned();
    let reference = needed(element, "valueReference")?;
    let reference = reference.trim().parse().map_err(|_| {
        format!("valueReference = \"{reference}\" of {name} is no number of 32 bits")
    })?;
    let variability = element.attribute("variability");
    let role = match element.attribute("causality") {
        Some("input") => Role::Input,
        Some("output") => Role::Output,
        Some("parameter") => Role::Parameter,
        _ => Role::Local,
    };
    let is_exact = element.attribute("initial") == Some("exact") && variability != Some("constant");
    let unit = { typed.attribute("unit") }
        .or_else(|| units.types.get(typed.attribute("declaredType")?).copied())
        .unwrap_or_default();
    Ok(Variable {
        name,
        reference,
        kind,
        role,
        is_settable: role == Role::Parameter || is_exact,
        start: typed.attribute("start").map(str::to_owned),
        unit: unit.to_owned(),
        scale: units.scales.get(unit).copied(),
        description: optional(element, "description"),
        is_updated_inside: element.attribute("intermediateUpdate") == Some("true"),
    })
}

impl<'a> Units<'a> {
    fn of(root: &'a Element, version: Version) -> Self {
        let units = root.inside("UnitDefinitions").iter();
        let scales = units.filter_map(|unit| {
            let base = unit.child("BaseUnit")?;
            let number = |name: &str, default| match base.attribute(name) {
                Some(text) => text.trim().parse().unwrap_or(default),
                None => default,
            };
            let scale = [number("factor", 1.0), number("offset", 0.0)];
            (scale != [1.0, 0.0]).then_some((unit.attribute("name")?, scale))
        });
        let types = root.inside("TypeDefinitions").iter();
        let types = types.filter_map(|own| {
            let unit = match version {
                Version::Two => own.child("Real")?.attribute("unit")?,
                Version::Three => own.attribute("unit")?,
            };
            Some((own.attribute("name")?, unit))
        });
        Self {
            scales: scales.collect(),
            types: types.collect(),
        }
    }
}

fn needed<'a>(element: &'a Element, attribute: &str) -> Result<&'a str, String> {
    element
        .attribute(attribute)
        .ok_or_else(|| format!("<{}> has no {attribute}", element.name))
}

fn optional(element: &Element, attribute: &str) -> String {
    element.attribute(attribute).unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests;
