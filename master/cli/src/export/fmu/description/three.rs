//! FMI 3.0.

use std::fmt::{Result, Write};

use super::{Attributes, IDENTIFIER, variables, write_experiment, write_head, write_units};
use crate::export::fmu::Exported;

pub(super) fn write(exported: &Exported, text: &mut String) -> Result {
    let has_states = exported.has_states;
    write_head(exported, "3.0", "instantiationToken", text)?;
    writeln!(text, r#">"#)?;
    writeln!(
        text,
        r#"  <CoSimulation modelIdentifier="{IDENTIFIER}" canHandleVariableCommunicationStepSize="true" canGetAndSetFMUState="{has_states}" canSerializeFMUState="{has_states}"/>"#
    )?;
    write_units(exported, text)?;
    write_experiment(exported, text)?;
    writeln!(text, "  <ModelVariables>")?;
    for Attributes {
        always,
        description,
        unit,
        start,
    } in variables(exported)
    {
        writeln!(text, r#"    <Float64 {always}{description}{unit}{start}/>"#)?;
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
