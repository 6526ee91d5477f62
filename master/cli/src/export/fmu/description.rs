//! `modelDescription.xml` of an exported scene, FMI 2.0.

use std::fmt::Write;

use quick_xml::escape::escape;

use super::variables::{Exported, Variable};

/// Name of the library in the archive, without its ending.
pub(super) const IDENTIFIER: &str = "linchpin_scene";

/// The text of the file.
pub(super) fn of(exported: &Exported) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(exported, &mut text);
    text
}

fn write(exported: &Exported, text: &mut String) -> std::fmt::Result {
    let has_states = exported.has_states;
    writeln!(text, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    writeln!(
        text,
        r#"<fmiModelDescription fmiVersion="2.0" modelName="{}" guid="{}" generationTool="Linchpin {}" variableNamingConvention="flat" numberOfEventIndicators="0">"#,
        escape(&exported.name),
        escape(&exported.contents.token),
        env!("CARGO_PKG_VERSION")
    )?;
    writeln!(
        text,
        r#"  <CoSimulation modelIdentifier="{IDENTIFIER}" canHandleVariableCommunicationStepSize="true" canInterpolateInputs="false" maxOutputDerivativeOrder="0" canGetAndSetFMUstate="{has_states}" canSerializeFMUstate="{has_states}" providesDirectionalDerivative="false"/>"#
    )?;
    write_units(exported, text)?;
    let [start, end] = exported.span;
    write!(
        text,
        r#"  <DefaultExperiment startTime="{start:?}" stopTime="{end:?}""#
    )?;
    if let Some(tolerance) = exported.tolerance {
        write!(text, r#" tolerance="{tolerance:?}""#)?;
    }
    writeln!(text, r#" stepSize="{:?}"/>"#, exported.macro_step)?;
    writeln!(text, "  <ModelVariables>")?;
    let outputs = exported.outputs.iter();
    let outputs = outputs.map(|own| {
        (
            own,
            r#"causality="output" variability="continuous" initial="calculated""#,
        )
    });
    let parameters = exported.parameters.iter();
    let parameters = parameters.map(|own| {
        (
            own,
            r#"causality="parameter" variability="fixed" initial="exact""#,
        )
    });
    for (reference, (variable, kind)) in outputs.chain(parameters).enumerate() {
        write_variable(reference, variable, kind, text)?;
    }
    writeln!(text, "  </ModelVariables>")?;
    writeln!(text, "  <ModelStructure>")?;
    write_unknowns("Outputs", exported.outputs.len(), text)?;
    write_unknowns("InitialUnknowns", exported.outputs.len(), text)?;
    writeln!(text, "  </ModelStructure>")?;
    writeln!(text, "</fmiModelDescription>")
}

fn has_unit(variable: &Variable) -> bool {
    !variable.unit.is_empty() && variable.unit != "1"
}

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

fn write_variable(
    reference: usize,
    variable: &Variable,
    kind: &str,
    text: &mut String,
) -> std::fmt::Result {
    write!(
        text,
        r#"    <ScalarVariable name="{}" valueReference="{reference}" {kind}"#,
        escape(&variable.name)
    )?;
    if !variable.description.is_empty() {
        write!(text, r#" description="{}""#, escape(&variable.description))?;
    }
    write!(text, "><Real")?;
    if has_unit(variable) {
        write!(text, r#" unit="{}""#, escape(&variable.unit))?;
    }
    if kind.contains("parameter") {
        write!(text, r#" start="{:?}""#, variable.start)?;
    }
    writeln!(text, "/></ScalarVariable>")
}

/// The outputs come first among the variables, which are counted from 1.
fn write_unknowns(element: &str, outputs: usize, text: &mut String) -> std::fmt::Result {
    if outputs == 0 {
        return Ok(());
    }
    writeln!(text, "    <{element}>")?;
    for index in 1..=outputs {
        writeln!(text, r#"      <Unknown index="{index}"/>"#)?;
    }
    writeln!(text, "    </{element}>")
}
