//! The command line: its arguments and what they start.

use clap::{Parser, Subcommand};

use crate::commands::{
    CommandError, check, conformance, converge, describe, instances, plot, report, run, spectrum,
    stability, worker,
};
use crate::log::Filter;

/// Couple black-box solvers by rigid joints
#[derive(Debug, Parser)]
#[command(
    name = "linchpin",
    version,
    propagate_version = true,
    after_help = "Examples:
  linchpin run scenes/oscillator.toml
  linchpin run scenes/oscillator.toml --out /tmp/fine --set coupling.macro_step=1e-4
  linchpin check scenes/oscillator.toml
  linchpin worker --listen 127.0.0.1:50051

Exit codes: 0 done, 1 the run failed, 2 the scene or the command line is wrong; after a signal that ended it in good order 128
and its number, as 130 after Ctrl-C, 143 after SIGTERM, 129 after SIGHUP."
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,

    /// What is logged to the error output: info tells the story of a run, debug every decision with its numbers; e.g. debug or
    /// info,linchpin_master=trace,tonic=warn
    #[arg(
        long,
        global = true,
        env = "LINCHPIN_LOG",
        default_value = "warn",
        value_name = "FILTER"
    )]
    log: Filter,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::Arguments),
    Plot(plot::Arguments),
    Check(check::Arguments),
    Worker(worker::Arguments),
    Describe(describe::Arguments),
    Instances(instances::Arguments),
    Conformance(conformance::Arguments),
    Converge(converge::Arguments),
    Stability(stability::Arguments),
    Report(report::Arguments),
    Spectrum(spectrum::Arguments),
}

impl Arguments {
    /// What is logged.
    pub fn log(&self) -> &Filter {
        &self.log
    }

    /// Does what the sub-command says.
    pub fn execute(&self) -> Result<(), CommandError> {
        match &self.command {
            Command::Run(arguments) => run::execute(arguments),
            Command::Plot(arguments) => plot::execute(arguments),
            Command::Check(arguments) => check::execute(arguments),
            Command::Worker(arguments) => worker::execute(arguments),
            Command::Describe(arguments) => describe::execute(arguments),
            Command::Instances(arguments) => instances::execute(arguments),
            Command::Conformance(arguments) => conformance::execute(arguments),
            Command::Converge(arguments) => converge::execute(arguments),
            Command::Stability(arguments) => stability::execute(arguments),
            Command::Report(arguments) => report::execute(arguments),
            Command::Spectrum(arguments) => spectrum::execute(arguments),
        }
    }
}
