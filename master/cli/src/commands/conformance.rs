//! `linchpin conformance`: whether a worker does what the contract and mechanics ask of it.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::Duration;

use linchpin_proto::v1::{self, Value};

use super::CommandError;
use super::assignment::assignment;
use super::common::{AccessArguments, address, print, seconds};
use crate::conformance::checks::all;
use crate::conformance::peer::{AtAddress, Peer, Started};
use crate::conformance::report::Report;
use crate::conformance::verdict::Grade;
use crate::conformance::{ConformanceError, DEFAULT_STEP, Settings, run};
use crate::progress;

/// Examine a worker: whether it does what the contract and mechanics ask of it
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin conformance http://127.0.0.1:50051 --model arm --step 1e-3 --step 5e-3
  linchpin conformance -p m=2 -p c=1000 -- python3 oscillator_worker.py
  linchpin conformance --model planar-body -p m=2 -p inertia=0.3 -p length=1 -p angle0=0.7 \\
    -- linchpin worker
  linchpin conformance unix:/run/linchpin/arm.sock --json --junit conformance.xml

The command is started with --listen ADDRESS at its end, or with the address in the place of {address}, and ended afterwards. Start \
from a state that hides nothing: turned bodies, points away from centres of mass, unequal inertias. \
docs/guide/conformance.md explains every check.

Exit code 0: no check failed (warnings may have been printed); 1: at least one did, or the worker could not be examined.")]
pub struct Arguments {
    /// Address of the worker: https://HOST:PORT, http://HOST:PORT or unix:/PATH
    #[arg(value_parser = address, required_unless_present = "command", conflicts_with = "command")]
    address: Option<String>,

    #[command(flatten)]
    access: AccessArguments,

    /// Command that starts the worker
    #[arg(last = true, value_name = "COMMAND")]
    command: Vec<String>,

    /// The model; needed if the worker has several
    #[arg(long, value_name = "NAME")]
    model: Option<String>,

    /// A parameter of the model: a number, true, false, a list [1, 2] or a text; may be given more than once
    #[arg(long = "parameter", short = 'p', value_name = "NAME=VALUE", value_parser = assignment)]
    parameters: Vec<(String, Value)>,

    /// Solver of the model [default: its first]
    #[arg(long, value_name = "KIND")]
    solver: Option<String>,

    /// An option of the solver; may be given more than once
    #[arg(long = "solver-option", value_name = "NAME=VALUE", value_parser = assignment, requires = "solver")]
    solver_options: Vec<(String, Value)>,

    /// Macro step in s at which the worker will be used; may be given more than once, the first one counts most
    #[arg(long = "step", value_name = "H", default_values_t = [DEFAULT_STEP], value_parser = seconds)]
    steps: Vec<f64>,

    /// Longest time for an answer, and for the start of the command, in s
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = seconds)]
    timeout: f64,

    /// Print the report as JSON
    #[arg(long)]
    json: bool,

    /// Write the report as JUnit XML as well
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
}

/// Examines the worker and prints what was found.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let settings = Settings {
        model: arguments.model.clone(),
        parameters: arguments.parameters.iter().cloned().collect(),
        solver: arguments.solver.as_ref().map(|kind| v1::Solver {
            kind: kind.clone(),
            options: arguments.solver_options.iter().cloned().collect(),
        }),
        steps: arguments.steps.clone(),
    };
    let report = examine(arguments, &settings).map_err(Box::new)?;
    match arguments.json {
        true => print(report.to_json().map_err(std::io::Error::from)? + "\n")?,
        false => print(&report)?,
    }
    if let Some(path) = &arguments.junit {
        write(path, &report)?;
    }
    match report.count(Grade::Fail) {
        0 => Ok(()),
        failed => Err(CommandError::NotConformant {
            failed,
            checks: report.checks.len(),
        }),
    }
}

fn examine(arguments: &Arguments, settings: &Settings) -> Result<Report, ConformanceError> {
    let limit = Duration::from_secs_f64(arguments.timeout);
    match &arguments.address {
        Some(address) => {
            let access = arguments.access.read()?;
            under_a_bar(&AtAddress::new(address.clone(), access, limit)?, settings)
        }
        None => under_a_bar(&Started::new(&arguments.command, limit)?, settings),
    }
}

fn under_a_bar(peer: &dyn Peer, settings: &Settings) -> Result<Report, ConformanceError> {
    let bar = progress::bar(
        all().len() as u64,
        "{bar:40} {pos}/{len} checks  {msg}",
        std::io::stderr().is_terminal(),
    );
    let report = run(peer, settings, &|check| {
        bar.set_message(check.to_owned());
        bar.inc(1);
    });
    bar.finish_and_clear();
    report
}

fn write(path: &Path, report: &Report) -> Result<(), CommandError> {
    std::fs::write(path, report.to_junit()).map_err(|source| CommandError::UnwritableReport {
        path: path.to_owned(),
        source,
    })
}
