//! The command line: its arguments and what they start.

use clap::{ArgAction, Parser, Subcommand};
use tracing::level_filters::LevelFilter;

use crate::commands::{
    CommandError, certificates, check, completions, conformance, converge, describe, diff, export,
    graph, health, init, instances, man, models, plot, report, run, spectrum, stability, worker,
};
use crate::log::Filter;
use crate::version::LONG;

/// Couple black-box solvers by rigid joints
#[derive(Debug, Parser)]
#[command(
    name = "linchpin",
    version,
    long_version = LONG.as_str(),
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

    /// Log more, whatever --log says: -v the story of a run, -vv every decision with its numbers, -vvv everything
    #[arg(short, long, global = true, action = ArgAction::Count)]
    verbose: u8,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::Arguments),
    Plot(plot::Arguments),
    Diff(diff::Arguments),
    Export(export::Arguments),
    Check(check::Arguments),
    Models(models::Arguments),
    Init(init::Arguments),
    Graph(graph::Arguments),
    Worker(worker::Arguments),
    Describe(describe::Arguments),
    Health(health::Arguments),
    Instances(instances::Arguments),
    Certificates(certificates::Arguments),
    Conformance(conformance::Arguments),
    Converge(converge::Arguments),
    Stability(stability::Arguments),
    Report(report::Arguments),
    Spectrum(spectrum::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

impl Arguments {
    /// What is logged.
    pub fn log(&self) -> Filter {
        match self.verbose {
            0 => self.log.clone(),
            1 => Filter::of_level(LevelFilter::INFO),
            2 => Filter::of_level(LevelFilter::DEBUG),
            _ => Filter::of_level(LevelFilter::TRACE),
        }
    }

    /// Does what the sub-command says.
    pub fn execute(&self) -> Result<(), CommandError> {
        match &self.command {
            Command::Run(arguments) => run::execute(arguments),
            Command::Plot(arguments) => plot::execute(arguments),
            Command::Export(arguments) => export::execute(arguments),
            Command::Diff(arguments) => diff::execute(arguments),
            Command::Check(arguments) => check::execute(arguments),
            Command::Init(arguments) => init::execute(arguments),
            Command::Models(arguments) => models::execute(arguments),
            Command::Graph(arguments) => graph::execute(arguments),
            Command::Worker(arguments) => worker::execute(arguments),
            Command::Describe(arguments) => describe::execute(arguments),
            Command::Health(arguments) => health::execute(arguments),
            Command::Instances(arguments) => instances::execute(arguments),
            Command::Certificates(arguments) => certificates::execute(arguments),
            Command::Conformance(arguments) => conformance::execute(arguments),
            Command::Converge(arguments) => converge::execute(arguments),
            Command::Stability(arguments) => stability::execute(arguments),
            Command::Report(arguments) => report::execute(arguments),
            Command::Completions(arguments) => completions::execute(arguments),
            Command::Man(arguments) => man::execute(arguments),
            Command::Spectrum(arguments) => spectrum::execute(arguments),
        }
    }
}
