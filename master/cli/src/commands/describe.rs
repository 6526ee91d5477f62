//! `linchpin describe`: what a worker can simulate.

use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{self, DescribeReply, Model, Parameter, Variable};
use linchpin_proto::version::{PROTOCOL, negotiate};

use super::CommandError;
use super::common::{WorkerArguments, print};

/// Show the models, variables and markers of a running worker
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin describe http://127.0.0.1:50051
  linchpin describe unix:/run/linchpin/mass1.sock")]
pub struct Arguments {
    #[command(flatten)]
    worker: WorkerArguments,
}

/// Asks the worker and prints its answer.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let worker = arguments.worker.connect()?;
    let request = v1::DescribeRequest {
        protocol: Some(PROTOCOL),
        ..Default::default()
    };
    let description = worker.describe(&request);
    let description = description.map_err(|source| arguments.worker.failed(source))?;
    print(text(&description))?;
    negotiate(description.protocol.as_ref()).map_err(|source| CommandError::Incompatible {
        address: arguments.worker.address().to_owned(),
        source,
    })
}

fn text(description: &DescribeReply) -> String {
    let protocol = description.protocol.unwrap_or_default();
    let mut text = format!(
        "{} {}, protocol linchpin {}.{}\n",
        description.worker, description.worker_version, protocol.major, protocol.minor
    );
    for model in &description.models {
        text += &model_text(model);
    }
    text
}

fn model_text(model: &Model) -> String {
    let mut text = format!("\nmodel {}: {}\n", model.name, model.description);
    for (heading, variables) in [("inputs", &model.inputs), ("outputs", &model.outputs)] {
        text += &format!("  {heading}\n");
        let of_variable =
            |own: &Variable| line(&own.name, &own.unit, &own.description, own.default);
        text.extend(variables.iter().map(of_variable));
    }
    text += "  parameters\n";
    let of_parameter = |own: &Parameter| line(&own.name, &own.unit, &own.description, own.default);
    text.extend(model.parameters.iter().map(of_parameter));
    text += "  markers\n";
    for marker in &model.markers {
        let motion = [&marker.position, &marker.velocity, &marker.acceleration];
        let motion: Vec<&str> = motion.into_iter().flatten().map(String::as_str).collect();
        text += &format!(
            "    {:<20} motion {}, load {}\n",
            marker.name,
            motion.join(", "),
            marker.load.join(", ")
        );
    }
    text += "  solvers\n";
    for solver in &model.solvers {
        text += &format!("    {:<20} {}\n", solver.name, solver.description);
        text.extend(solver.options.iter().map(of_parameter));
    }
    let capabilities = model.capabilities.unwrap_or_default();
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

fn line(name: &str, unit: &str, description: &str, default: Option<f64>) -> String {
    let default = default
        .map(|value| format!(", default {value}"))
        .unwrap_or_default();
    format!("    {name:<20} {unit:<8} {description}{default}\n")
}

fn yes(value: bool) -> &'static str {
    if value { "yes" } else { "no" }
}
