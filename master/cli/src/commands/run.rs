//! `linchpin run`: runs a scene and writes its results.

use std::path::{Path, PathBuf};

use linchpin_master::Interrupt;
use linchpin_master::scene::{Case, Scene};
use linchpin_master::setup::Options;
use serde::Serialize;
use serde_json::Value;

use super::CommandError;
use super::common::{OutputArguments, SceneArguments, case_folders, print, print_json, warn};
use crate::animation;
use crate::connect::{Connector, Place};
use crate::interrupt;
use crate::output::checkpoint::{CheckpointFile, RunIdentity, has_checkpoint, remove_checkpoints};
use crate::output::worker_logs::{remove_worker_logs, worker_logs};
use crate::output::{Ending, OutputFolder, Program, StatusFile};
use crate::plot::Format;
use crate::results::{About, Recorded, RunRecorder, RunReport, Target, draw};
use crate::simulate::simulate;

/// Run a scene; starts the workers it needs and writes results and plots
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin run scenes/oscillator.toml
  linchpin run scenes/oscillator.toml --out /tmp/fine --set coupling.macro_step=1e-4
  linchpin run scenes/oscillator.toml --in-process --quiet
  linchpin run scenes/double-pendulum.toml --animate
  linchpin run scenes/double-pendulum.toml --resume         after its process was ended
  linchpin run scenes/oscillator.toml --json | jq .statistics.macro_steps

Writes DIR/results.csv (a row for every macro point), DIR/run.json (scene, settings, statistics) and the plots
DIR/results.svg and DIR/results.png. What a worker prints that the run has started is in DIR/workers/NAME.log. A scene with
cases runs them one after the other, each in a folder of its own, and draws them together. What a run records stays if it
fails: run.json says from the first moment on whether the run is under way, done, failed or interrupted. Ctrl-C, SIGTERM,
SIGHUP, SIGQUIT, SIGUSR1 and SIGXCPU end it in good order, with exit code 128 and the number of the signal.")]
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

    /// Go on from the checkpoint that a run of the same scene and settings left in the folder; of a scene with cases, those without
    /// a checkpoint begin at their start
    #[arg(long)]
    resume: bool,

    /// Exit code 1 if a warning speaks against the results, as for a run that fails
    #[arg(long)]
    strict: bool,

    /// Show what the workers print that the run starts, line by line behind their names, in place of the progress bar
    #[arg(long)]
    worker_log: bool,

    /// No plots
    #[arg(long)]
    no_plots: bool,

    /// Print how the run ended as JSON, in place of the summary: what run.json says, with the folder
    #[arg(long)]
    json: bool,

    /// Write animation.html, which shows the moving markers and contacts; what it needs becomes columns of results.csv
    #[arg(long)]
    animate: bool,
}

impl Arguments {
    /// Whether the summary stays away.
    fn is_quiet(&self) -> bool {
        self.output.quiet || self.json
    }

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
    let folder = arguments.output.claim(&scene.name)?;
    let job = Job {
        arguments,
        program: Program::this(),
        interrupt: interrupt::on_signals()?,
        pictures: folder.path().join("results"),
    };
    let outcome = job.run_all(&scene, &case_folders, &folder);
    if arguments.json {
        let told = job.tell_json(folder.path());
        return outcome.and(told);
    }
    outcome?;
    arguments.output.conclude("", folder.path())
}

/// What all runs of one command share.
struct Job<'a> {
    arguments: &'a Arguments,
    program: Program,
    interrupt: Interrupt,
    /// Path of the pictures without its ending.
    pictures: PathBuf,
}

/// How a case of a scene stands.
#[derive(Debug, Clone, Serialize)]
struct CaseStatus {
    case: String,
    folder: String,
    /// `missing` before it has run, then as in the `run.json` of its folder.
    status: &'static str,
}

#[derive(Serialize)]
struct CaseStatuses {
    cases: Vec<CaseStatus>,
}

impl Job<'_> {
    /// Runs the scene, or its cases, and draws what there is.
    fn run_all(
        &self,
        scene: &Scene,
        case_folders: &[String],
        folder: &OutputFolder,
    ) -> Result<(), CommandError> {
        if !scene.cases.is_empty() {
            return self.run_cases(scene, case_folders, folder);
        }
        let (report, outcome) = self.run(scene, None, folder)?;
        let drawn = self.draw(scene, vec![report]);
        outcome.and(drawn)
    }

    /// Prints what `run.json` says, if this command has written it, and of cases those that have run.
    fn tell_json(&self, folder: &Path) -> Result<(), CommandError> {
        let own = |folder: &Path| Recorded::document_of(folder, self.program.process);
        let Some(mut document) = own(folder) else {
            return Ok(());
        };
        let cases = document["cases"].as_array().into_iter().flatten();
        let folders = cases.filter_map(|case| case["folder"].as_str());
        let runs: Vec<Value> = folders.filter_map(|case| own(&folder.join(case))).collect();
        if !runs.is_empty() {
            document["runs"] = runs.into();
        }
        print_json(&document)
    }

    /// Runs the cases one after the other up to the first that fails, and draws what there is.
    fn run_cases(
        &self,
        scene: &Scene,
        folders: &[String],
        folder: &OutputFolder,
    ) -> Result<(), CommandError> {
        let about = About::new(scene, &self.arguments.scene, None);
        let status = StatusFile::new(folder.path(), &self.program, about);
        status.running()?;
        let mut statuses: Vec<CaseStatus> = { scene.cases.iter() }
            .zip(folders)
            .map(|(case, folder)| CaseStatus {
                case: case.name.clone(),
                folder: folder.clone(),
                status: "missing",
            })
            .collect();
        let mut reports = Vec::new();
        let mut outcome = Ok(());
        for (case, own) in scene.cases.iter().zip(&mut statuses) {
            let ended = self.run_case(scene, case, &folder.path().join(&own.folder));
            let ended = ended.and_then(|(report, ended)| {
                reports.push(report);
                ended
            });
            own.status = Ending::of(&ended).word();
            outcome = ended.map_err(|error| error.in_case(&case.name));
            if outcome.is_err() {
                break;
            }
        }
        let drawn = self.draw(scene, reports);
        let outcome = outcome.and(drawn);
        let cases = CaseStatuses { cases: statuses };
        status.end(&Ending::of(&outcome), Some(cases))?;
        outcome
    }

    fn run_case(
        &self,
        scene: &Scene,
        case: &Case,
        folder: &Path,
    ) -> Result<(RunReport, Result<(), CommandError>), CommandError> {
        let folder = OutputFolder::claim(folder)?;
        let scene = scene.with_case(case)?;
        self.run(&scene, Some(&case.name), &folder)
    }

    /// Runs a scene; what it has recorded, and how it ended. The outer error is that of a run that has not begun.
    fn run(
        &self,
        scene: &Scene,
        case: Option<&str>,
        folder: &OutputFolder,
    ) -> Result<(RunReport, Result<(), CommandError>), CommandError> {
        let output = &self.arguments.output;
        let about = About::new(scene, &self.arguments.scene, case);
        let status = StatusFile::new(folder.path(), &self.program, about);
        let page = folder.path().join("animation.html");
        let stale = ["svg", "png"].map(|ending| self.pictures.with_extension(ending));
        let stale = [&stale[..], std::slice::from_ref(&page)].concat();
        let is_first = !status.is_there();
        let shows_worker_log = self.arguments.worker_log;
        let shows_progress = output.shows_progress() && !shows_worker_log;
        let identity = self.identity(scene, case);
        let resumed = self.resumed(&identity, folder.path())?;
        if resumed.is_none() {
            remove_worker_logs(folder.path()).map_err(CommandError::unwritable(folder.path()))?;
        }
        let connector = Connector::new(self.arguments.place())
            .stopped_by(self.interrupt.clone())
            .logging(worker_logs(folder.path(), shows_worker_log));
        let run = (identity, resumed);
        let mut recorder =
            RunRecorder::new(scene, folder.path(), stale, status, run, shows_progress)?;
        let options = Options {
            record_markers: self.arguments.animate,
            ..Options::default()
        };
        let simulated = simulate(scene, &connector, &options, &mut recorder);
        let flushed = recorder.flush();
        let (statistics, outcome) = match (simulated, flushed) {
            (Ok(statistics), Ok(_)) => (Some(statistics), Ok(())),
            (Ok(statistics), Err(error)) => (Some(statistics), Err(error)),
            (Err(error), flushed) => {
                // The run has failed for another reason, which is the one to be told.
                let table = flushed.ok().flatten().map(Path::to_owned);
                (
                    None,
                    Err(CommandError::from_simulation(error, &scene.coupling, table)),
                )
            }
        };
        let has_begun = recorder.has_begun();
        let (mut report, status) = recorder.into_report(statistics);
        if let Some(recording) = &mut report.recording {
            recording.case = case.map(str::to_owned);
            recording.reason = outcome.as_ref().err().map(ToString::to_string);
        }
        let outcome = outcome.and_then(|()| {
            remove_checkpoints(folder.path()).map_err(CommandError::unwritable(folder.path()))?;
            self.tell(scene, case, &report, &page)?;
            self.judge(scene, &report)
        });
        // Results of an earlier run keep what was said of them.
        if has_begun || is_first {
            let told = status.end(&Ending::of(&outcome), Some(report.results()));
            return Ok((report, outcome.and(told)));
        }
        Ok((report, outcome))
    }

    fn identity(&self, scene: &Scene, case: Option<&str>) -> RunIdentity {
        let overrides = self.arguments.scene.set.iter();
        RunIdentity {
            version: self.program.linchpin.to_owned(),
            scene_text: scene.text().to_owned(),
            overrides: overrides.map(ToString::to_string).collect(),
            case: case.map(str::to_owned),
            animate: self.arguments.animate,
        }
    }

    /// The checkpoint that the run goes on from, if that was asked for.
    fn resumed(
        &self,
        run: &RunIdentity,
        folder: &Path,
    ) -> Result<Option<CheckpointFile>, CommandError> {
        let begins = !self.arguments.resume || (run.case.is_some() && !has_checkpoint(folder));
        if begins {
            return Ok(None);
        }
        let file = CheckpointFile::read(folder)?;
        file.check(run, folder)?;
        Ok(Some(file))
    }

    /// The page and the summary of a run that came to its end.
    fn tell(
        &self,
        scene: &Scene,
        case: Option<&str>,
        report: &RunReport,
        page: &Path,
    ) -> Result<(), CommandError> {
        if let Some(motion) = &report.motion {
            animation::write(scene, case, motion, page)?;
        }
        for warning in report.warnings() {
            warn(warning);
        }
        if self.arguments.is_quiet() {
            return Ok(());
        }
        print(format_args!("{}\n", report.summary(scene, case)))
    }

    /// Whether what came to its end counts as done.
    fn judge(&self, scene: &Scene, report: &RunReport) -> Result<(), CommandError> {
        let warnings = report.warnings();
        let count = { warnings.iter() }
            .filter(|warning| warning.is_against_results())
            .count();
        let most = scene.run.most_poor;
        if let Some(statistics) = &report.statistics {
            let (steps, of) = (statistics.verdicts.poor, statistics.macro_steps);
            if steps as f64 > most * of as f64 {
                return Err(CommandError::Poor { steps, of, most });
            }
        }
        match self.arguments.strict && count > 0 {
            true => Err(CommandError::Strict { count }),
            false => Ok(()),
        }
    }

    /// The picture of the runs that have recorded something.
    fn draw(&self, scene: &Scene, reports: Vec<RunReport>) -> Result<(), CommandError> {
        let recordings: Vec<_> = { reports.into_iter() }
            .filter_map(|report| report.recording)
            .collect();
        if self.arguments.no_plots || recordings.is_empty() {
            return Ok(());
        }
        let target = Target {
            stem: &self.pictures,
            formats: &Format::ALL,
        };
        draw(&scene.name, &recordings, &target).map(|_| ())
    }
}
