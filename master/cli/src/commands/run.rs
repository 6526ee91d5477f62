//! `linchpin run`: runs a scene and writes its results.

use std::path::{Path, PathBuf};

use linchpin_master::Interrupt;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;

use super::CommandError;
use super::common::{OutputArguments, SceneArguments, case_folders, prepare_folder, print, warn};
use crate::animation;
use crate::connect::{Connector, Place};
use crate::interrupt;
use crate::results::{RunRecorder, RunReport, draw};
use crate::simulate::simulate;

/// Run a scene; starts the workers it needs and writes results and plots
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin run scenes/oscillator.toml
  linchpin run scenes/oscillator.toml --out /tmp/fine --set coupling.macro_step=1e-4
  linchpin run scenes/oscillator.toml --in-process --quiet
  linchpin run scenes/double-pendulum.toml --animate

Writes DIR/results.csv (a row for every macro point), DIR/run.json (scene, settings, statistics) and the plots
DIR/results.svg and DIR/results.png. A scene with cases runs them one after the other, each in a folder of its own, and
draws them together. What a run records stays if it fails; Ctrl-C ends it in good order, with exit code 130.")]
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

    /// Write animation.html, which shows the moving markers and contacts; what it needs becomes columns of results.csv
    #[arg(long)]
    animate: bool,
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
    let case_folders = case_folders(&scene)?;
    let folder = arguments.output.prepare(&scene.name)?;
    let job = Job {
        arguments,
        interrupt: interrupt::on_signals()?,
        pictures: folder.join("results"),
    };
    let mut reports = Vec::new();
    if scene.cases.is_empty() {
        reports.push(job.run(&scene, None, &folder)?);
    }
    for (case, own) in scene.cases.iter().zip(case_folders) {
        let own = folder.join(own);
        prepare_folder(&own)?;
        let scene = scene.with_case(case)?;
        let report = job.run(&scene, Some(&case.name), &own);
        reports.push(report.map_err(|error| error.in_case(&case.name))?);
    }
    if !arguments.no_plots {
        draw(&scene, &reports, &job.pictures)?;
    }
    arguments.output.conclude("", &folder)
}

/// What all runs of one command share.
struct Job<'a> {
    arguments: &'a Arguments,
    interrupt: Interrupt,
    /// Path of the pictures without its ending.
    pictures: PathBuf,
}

impl Job<'_> {
    fn run(
        &self,
        scene: &Scene,
        case: Option<&str>,
        folder: &Path,
    ) -> Result<RunReport, CommandError> {
        let output = &self.arguments.output;
        let connector = Connector::new(self.arguments.place()).stopped_by(self.interrupt.clone());
        let report_path = folder.join("run.json");
        let stale = ["svg", "png"].map(|ending| self.pictures.with_extension(ending));
        let page = folder.join("animation.html");
        let stale = [&stale[..], &[report_path.clone(), page.clone()]].concat();
        let mut recorder = RunRecorder::new(scene, folder, stale, output.shows_progress());
        let options = Options {
            record_markers: self.arguments.animate,
            ..Options::default()
        };
        let report = match simulate(scene, &connector, &options, &mut recorder) {
            Ok(statistics) => recorder.finish(statistics)?,
            Err(error) => return Err(CommandError::from_simulation(error, recorder.give_up())),
        };
        report.write_json(scene, &self.arguments.scene, case, &report_path)?;
        if let Some(motion) = &report.motion {
            animation::write(scene, case, motion, &page)?;
        }
        if !output.quiet {
            print(format_args!("{}\n", report.summary(scene, case)))?;
        }
        for warning in report.statistics.warnings() {
            warn(warning);
        }
        Ok(report)
    }
}
