//! `linchpin run`: runs a scene and writes its results.

use std::path::{Path, PathBuf};

use linchpin_master::cosimulation::Options;
use linchpin_master::scene::Scene;

use super::CommandError;
use super::common::{OutputArguments, SceneArguments, file_name, prepare_folder};
use crate::connect::{Connector, Place};
use crate::results::{RunRecorder, RunReport, draw};
use crate::simulate::simulate;

/// Run a scene; starts the workers it needs and writes results and plots
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin run scenes/oscillator.toml
  linchpin run scenes/oscillator.toml --out /tmp/fine --set coupling.macro_step=1e-4
  linchpin run scenes/oscillator.toml --in-process --quiet

Writes DIR/results.csv (a row for every macro point), DIR/run.json (scene, settings, statistics) and the plots
DIR/results.svg and DIR/results.png. A scene with cases runs them one after the other, each in a folder of its own, and
draws them together.")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,

    #[command(flatten)]
    output: OutputArguments,

    /// Run built-in models in this process instead of worker processes; the results have equal bits
    #[arg(long)]
    in_process: bool,

    /// With --in-process: each built-in model on a thread of its own
    #[arg(long, requires = "in_process")]
    threads: bool,

    /// No plots
    #[arg(long)]
    no_plots: bool,
}

impl Arguments {
    fn place(&self) -> Place {
        match (self.in_process, self.threads) {
            (false, _) => Place::Processes,
            (true, false) => Place::InProcess,
            (true, true) => Place::Threads,
        }
    }
}

/// Runs the scene, or all its cases.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let scene = arguments.scene.load()?;
    let folder = arguments.output.prepare(&scene)?;
    let mut reports = Vec::new();
    if scene.cases.is_empty() {
        reports.push(run_one(arguments, &scene, None, &folder)?);
    }
    for case in &scene.cases {
        let own = folder.join(file_name(&case.name));
        prepare_folder(&own)?;
        let scene = scene.with_case(case)?;
        let report = run_one(arguments, &scene, Some(&case.name), &own);
        reports.push(report.map_err(|error| error.in_case(&case.name))?);
    }
    if !arguments.no_plots {
        draw(&scene, &reports, &folder.join("results"))?;
    }
    if !arguments.output.quiet {
        println!("results in {}", folder.display());
    }
    Ok(())
}

fn run_one(
    arguments: &Arguments,
    scene: &Scene,
    case: Option<&str>,
    folder: &Path,
) -> Result<RunReport, CommandError> {
    let connector = Connector::new(arguments.place());
    let table: PathBuf = folder.join("results.csv");
    let mut recorder = RunRecorder::new(scene, &table, arguments.output.shows_progress())?;
    let statistics = simulate(scene, &connector, &Options::default(), &mut recorder)
        .map_err(CommandError::from_simulation)?;
    let report = recorder.finish(statistics)?;
    report.write_json(scene, &arguments.scene, case, &folder.join("run.json"))?;
    if !arguments.output.quiet {
        println!("{}", report.summary(scene, case));
    }
    Ok(report)
}
