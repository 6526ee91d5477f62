//! FMI 2.0.

use std::fmt::{Result, Write};

use quick_xml::escape::escape;

use super::{IDENTIFIER, attribute, start, unit, variables, write_experiment, write_units};
use crate::export::fmu::Exported;

pub(super) fn write(exported: &Exported, text: &mut String) -> Result {
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
    write_experiment(exported, text)?;
    writeln!(text, "  <ModelVariables>")?;
    for (reference, variable, kind) in variables(exported) {
        let name = escape(&variable.name);
        let description = attribute("description", &variable.description);
        let (unit, start) = (unit(variable), start(variable, kind));
        writeln!(
            text,
            r#"    <ScalarVariable name="{name}" valueReference="{reference}" {kind}{description}><Real{unit}{start}/></ScalarVariable>"#
        )?;
    }
    writeln!(text, "  </ModelVariables>")?;
    writeln!(text, "  <ModelStructure>")?;
    write_unknowns("Outputs", exported.outputs.len(), text)?;
    write_unknowns("InitialUnknowns", exported.outputs.len(), text)?;
    writeln!(text, "  </ModelStructure>")?;
    writeln!(text, "</fmiModelDescription>")
}

/// The outputs come first among the variables, which are counted from 1.
fn write_unknowns(element: &str, outputs: usize, text: &mut String) -> Result {
    if outputs == 0 {
        return Ok(());
    }
    writeln!(text, "    <{element}>")?;
    for index in 1..=outputs {
        writeln!(text, r#"      <Unknown index="{index}"/>"#)?;
    }
    writeln!(text, "    </{element}>")
}
