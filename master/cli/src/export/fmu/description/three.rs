//! FMI 3.0.

use std::fmt::{Result, Write};

use quick_xml::escape::escape;

use super::{IDENTIFIER, attribute, start, unit, variables, write_experiment, write_units};
use crate::export::fmu::Exported;

pub(super) fn write(exported: &Exported, text: &mut String) -> Result {
    let has_states = exported.has_states;
    writeln!(text, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    writeln!(
        text,
        r#"<fmiModelDescription fmiVersion="3.0" modelName="{}" instantiationToken="{}" generationTool="Linchpin {}" variableNamingConvention="flat">"#,
        escape(&exported.name),
        escape(&exported.contents.token),
        env!("CARGO_PKG_VERSION")
    )?;
    writeln!(
        text,
        r#"  <CoSimulation modelIdentifier="{IDENTIFIER}" canHandleVariableCommunicationStepSize="true" canGetAndSetFMUState="{has_states}" canSerializeFMUState="{has_states}"/>"#
    )?;
    write_units(exported, text)?;
    write_experiment(exported, text)?;
    writeln!(text, "  <ModelVariables>")?;
    for (reference, variable, kind) in variables(exported) {
        let name = escape(&variable.name);
        let description = attribute("description", &variable.description);
        let (unit, start) = (unit(variable), start(variable, kind));
        writeln!(
            text,
            r#"    <Float64 name="{name}" valueReference="{reference}" {kind}{description}{unit}{start}/>"#
        )?;
    }
    // Every description has the time, whose value reference is behind all others.
    let time = exported.outputs.len() + exported.parameters.len();
    writeln!(
        text,
        r#"    <Float64 name="time" valueReference="{time}" causality="independent" variability="continuous" description="time"/>"#
    )?;
    writeln!(text, "  </ModelVariables>")?;
    writeln!(text, "  <ModelStructure>")?;
    for element in ["Output", "InitialUnknown"] {
        for reference in 0..exported.outputs.len() {
            writeln!(text, r#"    <{element} valueReference="{reference}"/>"#)?;
        }
    }
    writeln!(text, "  </ModelStructure>")?;
    writeln!(text, "</fmiModelDescription>")
}
