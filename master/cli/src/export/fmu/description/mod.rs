//! `modelDescription.xml` of an exported scene.

mod three;
mod two;

use std::fmt::Write;

use clap::ValueEnum;
use quick_xml::escape::escape;

use super::variables::{Exported, Variable};

/// Name of the library in the archive, without its ending.
const IDENTIFIER: &str = "linchpin_scene";

/// Versions of FMI.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Version {
    /// FMI 2.0
    #[value(name = "2")]
    Two,
    /// FMI 3.0
    #[value(name = "3")]
    Three,
}

impl Version {
    /// The text of the description.
    pub(super) fn describe(self, exported: &Exported) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = match self {
            Self::Two => two::write(exported, &mut text),
            Self::Three => three::write(exported, &mut text),
        };
        text
    }

    /// Where the library is in the archive.
    pub(super) fn library(self) -> String {
        let platform = match self {
            Self::Two => "linux64",
            Self::Three => "x86_64-linux",
        };
        format!("binaries/{platform}/{IDENTIFIER}.so")
    }
}

fn has_unit(variable: &Variable) -> bool {
    !variable.unit.is_empty() && variable.unit != "1"
}

/// The units of all variables, each once.
fn write_units(exported: &Exported, text: &mut String) -> std::fmt::Result {
    let variables = exported.outputs.iter().chain(&exported.parameters);
    let mut units: Vec<&str> = { variables.filter(|own| has_unit(own)) }
        .map(|own| own.unit.as_str())
        .collect();
    units.sort_unstable();
    units.dedup();
    if units.is_empty() {
        return Ok(());
    }
    writeln!(text, "  <UnitDefinitions>")?;
    for unit in units {
        writeln!(text, r#"    <Unit name="{}"/>"#, escape(unit))?;
    }
    writeln!(text, "  </UnitDefinitions>")
}

fn write_experiment(exported: &Exported, text: &mut String) -> std::fmt::Result {
    let [start, end] = exported.span;
    write!(
        text,
        r#"  <DefaultExperiment startTime="{start:?}" stopTime="{end:?}""#
    )?;
    if let Some(tolerance) = exported.tolerance {
        write!(text, r#" tolerance="{tolerance:?}""#)?;
    }
    writeln!(text, r#" stepSize="{:?}"/>"#, exported.macro_step)
}

/// What an output and a parameter are, in the words of both versions.
const OUTPUT: &str = r#"causality="output" variability="continuous" initial="calculated""#;
const PARAMETER: &str = r#"causality="parameter" variability="fixed" initial="exact""#;

/// A variable as attributes, each as it stands in the file; those that are absent are empty.
struct Attributes {
    /// Its name, its value reference and what it is.
    always: String,
    description: String,
    unit: String,
    start: String,
}

/// The variables by their value references.
fn variables(exported: &Exported) -> impl Iterator<Item = Attributes> {
    let outputs = exported.outputs.iter().map(|own| (own, OUTPUT));
    let parameters = exported.parameters.iter().map(|own| (own, PARAMETER));
    let all = outputs.chain(parameters).enumerate();
    all.map(|(reference, (variable, kind))| {
        let name = escape(&variable.name);
        let unit = if has_unit(variable) {
            &*variable.unit
        } else {
            ""
        };
        Attributes {
            always: format!(r#"name="{name}" valueReference="{reference}" {kind}"#),
            description: attribute("description", &variable.description),
            unit: attribute("unit", unit),
            start: match kind == PARAMETER {
                true => format!(r#" start="{:?}""#, variable.start),
                false => String::new(),
            },
        }
    })
}

/// ` description="..."` and the like, where there is something to say.
fn attribute(name: &str, value: &str) -> String {
    match value.is_empty() {
        true => String::new(),
        false => format!(r#" {name}="{}""#, escape(value)),
    }
}

/// The line before the root, and the attributes of the root that both versions have; `token` is the name of that of the token.
fn write_head(
    exported: &Exported,
    version: &str,
    token: &str,
    text: &mut String,
) -> std::fmt::Result {
    writeln!(text, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    write!(
        text,
        r#"<fmiModelDescription fmiVersion="{version}" modelName="{}" {token}="{}" generationTool="Linchpin {}" variableNamingConvention="flat""#,
        escape(&exported.name),
        escape(&exported.contents.token),
        env!("CARGO_PKG_VERSION")
    )
}
