//! What a model describes, for a reader and as JSON.

use linchpin_proto::v1::{self, MarkerKind, Model, Parameter, Variable};
use serde::Serialize;

/// A model as JSON.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelDescription {
    name: String,
    description: String,
    parameters: Vec<Described>,
    inputs: Vec<Described>,
    outputs: Vec<Described>,
    markers: Vec<Marker>,
    solvers: Vec<Solver>,
    states: Vec<State>,
    capabilities: Capabilities,
}

/// A parameter or a variable.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Described {
    name: String,
    unit: String,
    description: String,
    /// Absent: a parameter that must be given, an input that must be driven.
    default: Option<f64>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct Marker {
    name: String,
    kind: &'static str,
    position: Vec<String>,
    velocity: Vec<String>,
    acceleration: Vec<String>,
    load: Vec<String>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct Solver {
    name: String,
    description: String,
    options: Vec<Described>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct State {
    output: String,
    initial: String,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct Capabilities {
    exchange: bool,
    repeats_step_sequence: bool,
    max_input_degree: Option<u32>,
    exportable_snapshot: bool,
    joint_loads: bool,
    directional_derivatives: bool,
    interior_outputs: bool,
    output_integrals: bool,
}

impl ModelDescription {
    /// That of a model.
    pub fn of(model: &Model) -> Self {
        let capabilities = model.capabilities.unwrap_or_default();
        Self {
            name: model.name.clone(),
            description: model.description.clone(),
            parameters: model.parameters.iter().map(of_parameter).collect(),
            inputs: model.inputs.iter().map(of_variable).collect(),
            outputs: model.outputs.iter().map(of_variable).collect(),
            markers: model.markers.iter().map(of_marker).collect(),
            solvers: model.solvers.iter().map(of_solver).collect(),
            states: model.states.iter().map(of_state).collect(),
            capabilities: Capabilities {
                exchange: capabilities.exchange,
                repeats_step_sequence: capabilities.repeats_step_sequence,
                max_input_degree: capabilities.max_input_degree,
                exportable_snapshot: capabilities.exportable_snapshot,
                joint_loads: capabilities.joint_loads,
                directional_derivatives: capabilities.directional_derivatives,
                interior_outputs: capabilities.interior_outputs,
                output_integrals: capabilities.output_integrals,
            },
        }
    }
}

fn of_parameter(own: &Parameter) -> Described {
    Described {
        name: own.name.clone(),
        unit: own.unit.clone(),
        description: own.description.clone(),
        default: own.default,
    }
}

fn of_variable(own: &Variable) -> Described {
    Described {
        name: own.name.clone(),
        unit: own.unit.clone(),
        description: own.description.clone(),
        default: own.default,
    }
}

fn of_marker(own: &v1::Marker) -> Marker {
    Marker {
        name: own.name.clone(),
        kind: kind(own.kind()),
        position: own.position.clone(),
        velocity: own.velocity.clone(),
        acceleration: own.acceleration.clone(),
        load: own.load.clone(),
    }
}

fn of_solver(own: &v1::SolverKind) -> Solver {
    Solver {
        name: own.name.clone(),
        description: own.description.clone(),
        options: own.options.iter().map(of_parameter).collect(),
    }
}

fn of_state(own: &v1::StateVariable) -> State {
    State {
        output: own.output.clone(),
        initial: own.initial.clone(),
    }
}

fn kind(kind: MarkerKind) -> &'static str {
    match kind {
        MarkerKind::Unspecified => "unspecified",
        MarkerKind::Scalar => "scalar",
        MarkerKind::Planar => "planar",
        MarkerKind::Spatial => "spatial",
    }
}

/// A model for a reader.
pub fn model_text(model: &Model) -> String {
    let own = ModelDescription::of(model);
    let mut text = format!("model {}: {}\n", own.name, own.description);
    for (heading, variables) in [("inputs", &own.inputs), ("outputs", &own.outputs)] {
        text += &section(heading, variables);
    }
    text += &section("parameters", &own.parameters);
    text += "  markers\n";
    for marker in &own.markers {
        let motion = [&marker.position, &marker.velocity, &marker.acceleration];
        let motion: Vec<&str> = motion.into_iter().flatten().map(String::as_str).collect();
        text += &format!(
            "    {:<20} {:<8} motion {}, load {}\n",
            marker.name,
            marker.kind,
            motion.join(", "),
            marker.load.join(", ")
        );
    }
    text += "  solvers\n";
    for solver in &own.solvers {
        text += &format!("    {:<20} {}\n", solver.name, solver.description);
        text.extend(solver.options.iter().map(line));
    }
    let capabilities = own.capabilities;
    text += &format!(
        "  exchange stream {}, perturbed steps repeat the step sequence {}, exportable snapshots {}, \
         directional derivatives {}, outputs inside a step {}, \
         integrals of outputs {}\n",
        yes(capabilities.exchange),
        yes(capabilities.repeats_step_sequence),
        yes(capabilities.exportable_snapshot),
        yes(capabilities.directional_derivatives),
        yes(capabilities.interior_outputs),
        yes(capabilities.output_integrals)
    );
    text
}

fn section(heading: &str, described: &[Described]) -> String {
    let lines = described.iter().map(line);
    format!("  {heading}\n{}", lines.collect::<String>())
}

fn line(own: &Described) -> String {
    let default = own.default;
    let default = default.map_or_else(String::new, |own| format!(", default {}", number(own)));
    format!(
        "    {:<20} {:<8} {}{default}\n",
        own.name, own.unit, own.description
    )
}

/// A number without a row of zeros.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-4..1e7 => value.to_string(),
        _ => format!("{value:e}"),
    }
}

fn yes(value: bool) -> &'static str {
    if value { "yes" } else { "no" }
}
