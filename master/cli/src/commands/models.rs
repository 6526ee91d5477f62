//! `linchpin models`: the built-in models, without a worker.

use std::collections::BTreeMap;

use linchpin_models::models;
use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{self, DescribeRequest, Value};
use linchpin_proto::version::PROTOCOL;
use linchpin_worker::Host;

use super::CommandError;
use super::assignment::assignment;
use super::common::{print, print_json};
use super::description::{ModelDescription, model_text};

/// Show the built-in models: parameters with units and defaults, variables, markers, solvers
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin models
  linchpin models planar-body
  linchpin models planar-multibody -p formulation=minimal
  linchpin models dc-motor pi-controller --json

No worker is started. A model whose inputs, outputs or markers depend on its parameters is shown as it is with those given by
--parameter. What a parameter may be stands in its description; one without a default must be given in the scene.")]
pub struct Arguments {
    /// Names of the models [default: all, a line for each]
    #[arg(value_name = "NAME")]
    names: Vec<String>,

    /// A parameter of the model: a number, true, false, a list [1, 2] or a text; may be given more than once
    #[arg(long = "parameter", short = 'p', value_name = "NAME=VALUE", value_parser = assignment, requires = "names")]
    parameters: Vec<(String, Value)>,

    /// Print the descriptions as JSON
    #[arg(long)]
    json: bool,
}

/// Prints what the models describe.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    // A host fills in what the SDK provides.
    let host = Host::new(models());
    let parameters: BTreeMap<String, Value> = arguments.parameters.iter().cloned().collect();
    let mut all = host
        .describe(&request(None))
        .map_err(CommandError::Models)?;
    all.models.sort_by(|one, other| one.name.cmp(&other.name));
    let mut described = Vec::new();
    for name in &arguments.names {
        described.push(describe(&host, &all.models, name, &parameters)?);
    }
    if arguments.names.is_empty() {
        described = all.models;
        if !arguments.json {
            return print(list(&described));
        }
    }
    if arguments.json {
        let described: Vec<_> = described.iter().map(ModelDescription::of).collect();
        return print_json(&described);
    }
    let texts: Vec<String> = described.iter().map(model_text).collect();
    print(texts.join("\n"))
}

fn request(model: Option<String>) -> DescribeRequest {
    DescribeRequest {
        protocol: Some(PROTOCOL),
        model,
        ..Default::default()
    }
}

fn describe(
    host: &Host,
    all: &[v1::Model],
    name: &str,
    parameters: &BTreeMap<String, Value>,
) -> Result<v1::Model, CommandError> {
    let unknown = || CommandError::NoModel {
        name: name.to_owned(),
        names: all
            .iter()
            .map(|own| own.name.as_str())
            .collect::<Vec<_>>()
            .join(", "),
    };
    let known = all
        .iter()
        .find(|own| own.name == name)
        .ok_or_else(unknown)?;
    if parameters.is_empty() {
        return Ok(known.clone());
    }
    check_names(known, parameters)?;
    let request = DescribeRequest {
        parameters: parameters.clone().into_iter().collect(),
        ..request(Some(name.to_owned()))
    };
    let reply = host.describe(&request).map_err(CommandError::Models)?;
    let own = reply.models.into_iter().find(|own| own.name == name);
    own.ok_or_else(unknown)
}

/// What stands for a name of the user's choice in the names of parameters; models with such parameters check them themselves.
const CHOSEN: &str = "NAME";

fn check_names(
    model: &v1::Model,
    parameters: &BTreeMap<String, Value>,
) -> Result<(), CommandError> {
    let known = || model.parameters.iter().map(|own| own.name.as_str());
    if known().any(|name| name.contains(CHOSEN)) {
        return Ok(());
    }
    match parameters
        .keys()
        .find(|name| !known().any(|own| own == *name))
    {
        None => Ok(()),
        Some(name) => Err(CommandError::NoParameter {
            model: model.name.clone(),
            name: name.clone(),
            names: known().collect::<Vec<_>>().join(", "),
        }),
    }
}

/// A line for each model.
fn list(described: &[v1::Model]) -> String {
    let width = described.iter().map(|model| model.name.len()).max();
    let width = width.unwrap_or_default();
    let line = |model: &v1::Model| format!("{:<width$}  {}\n", model.name, model.description);
    let lines: String = described.iter().map(line).collect();
    lines + "\nlinchpin models NAME shows parameters, variables, markers and solvers\n"
}
