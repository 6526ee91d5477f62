//! `linchpin describe`: what a worker can simulate.

use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{self, DescribeReply};
use linchpin_proto::version::{PROTOCOL, negotiate};

use serde::Serialize;

use super::CommandError;
use super::common::{WorkerArguments, print, print_json};
use super::description::{ModelDescription, model_text};

/// Show the models, variables and markers of a running worker
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin describe http://127.0.0.1:50051
  linchpin describe unix:/run/linchpin/mass1.sock
  linchpin describe http://127.0.0.1:50051 --json")]
pub struct Arguments {
    #[command(flatten)]
    worker: WorkerArguments,

    /// Print the descriptions as JSON
    #[arg(long)]
    json: bool,
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
    match arguments.json {
        true => print_json(&document(&description))?,
        false => print(text(&description))?,
    }
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
        text += "\n";
        text += &model_text(model);
    }
    text
}

/// What a worker describes, as JSON.
#[derive(Serialize)]
struct Document<'a> {
    worker: &'a str,
    version: &'a str,
    /// Of the contract: `MAJOR.MINOR`.
    protocol: String,
    models: Vec<ModelDescription>,
}

fn document(description: &DescribeReply) -> Document<'_> {
    let protocol = description.protocol.unwrap_or_default();
    Document {
        worker: &description.worker,
        version: &description.worker_version,
        protocol: format!("{}.{}", protocol.major, protocol.minor),
        models: description
            .models
            .iter()
            .map(ModelDescription::of)
            .collect(),
    }
}
