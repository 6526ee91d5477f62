//! FMI 2.0.

use std::fmt::{Result, Write};

use super::{Attributes, IDENTIFIER, variables, write_experiment, write_head, write_units};
use crate::export::fmu::Exported;

pub(super) fn write(exported: &Exported, text: &mut String) -> Result {
    let has_states = exported.has_states;
    write_head(exported, "2.0", "guid", text)?;
    writeln!(text, r#" numberOfEventIndicators="0">"#)?;
    writeln!(
        text,
        r#"  <CoSimulation modelIdentifier="{IDENTIFIER}" canHandleVariableCommunicationStepSize="true" canInterpolateInputs="false" maxOutputDerivativeOrder="0" canGetAndSetFMUstate="{has_states}" canSerializeFMUstate="{has_states}" providesDirectionalDerivative="false"/>"#
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
        writeln!(
            text,
            r#"    <ScalarVariable {always}{description}><Real{unit}{start}/></ScalarVariable>"#
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
