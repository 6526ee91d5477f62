//! Why a command failed, and how it ends the process.

mod exit_code;

use std::path::{Path, PathBuf};

use linchpin_fmu::FmuError;
use linchpin_master::RunError;
use linchpin_master::connection::{CONTRACT, StartError};
use linchpin_master::scene::{Coupling, SceneErrors};
use linchpin_proto::certificates::CertificatesError;
use linchpin_proto::contract::CallError;
use linchpin_proto::token::TokenError;
use linchpin_proto::version::Incompatible;
use linchpin_worker::server::{ListenError, ServeError};

use crate::certificates::NewCertificatesError;
use crate::comparison::ComparisonError;
use crate::conformance::ConformanceError;
use crate::export::fmu::FmuExportError;
use crate::output::checkpoint::ResumeError;
use crate::output::part::PartError;
use crate::plot::PlotError;
use crate::results::ReadError;
use crate::simulate::SimulateError;
use crate::spectra::FailedCurve;
use crate::study::StudyError;

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneErrors),
    /// The run stopped.
    #[error(transparent)]
    Run(RunError),
    /// The run stopped at some time after its start was asked for.
    #[error("{source}{}{}", help_line(.help.as_deref()), note(.table.as_deref()))]
    Stopped {
        /// Why.
        source: Box<RunError>,
        /// What to try.
        help: Option<String>,
        /// The table of results up to there, if there are any.
        table: Option<PathBuf>,
    },
    /// A case of the scene failed.
    #[error("case \"{case}\": {source}")]
    Case {
        /// Name of the case.
        case: String,
        /// Why.
        source: Box<CommandError>,
    },
    /// An FMU cannot be served.
    #[error(transparent)]
    Fmu(#[from] FmuError),
    /// A run does not go on from a checkpoint.
    #[error(transparent)]
    Resume(#[from] ResumeError),
    /// The standard output takes nothing more.
    #[error("cannot write to the standard output: {0}")]
    Output(std::io::Error),
    /// Another process writes to the folder.
    #[error(
        "{} is in use by {holder}; wait until it ends, or choose another folder with --out",
        folder.display()
    )]
    FolderTaken {
        /// The folder.
        folder: PathBuf,
        /// Who writes there.
        holder: String,
    },
    /// A folder or file cannot be written.
    #[error("cannot write to {}: {source}; choose another folder with --out", path.display())]
    Unwritable {
        /// The path.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// An animation was asked for, and no subsystem has a marker that could be shown.
    #[error(
        "--animate has nothing to show: no subsystem of the scene describes a marker with a position; \
         run without it, or let a worker describe markers"
    )]
    NothingToAnimate,
    /// A table cannot be written or read back.
    #[error("{}: {source}{}", path.display(), advice(.source))]
    Table {
        /// The path.
        path: PathBuf,
        /// Why.
        source: csv::Error,
    },
    /// A picture cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// A part of a study cannot be used.
    #[error(transparent)]
    Part(#[from] PartError),
    /// A study in more parts than there is to do.
    #[error("{parts} parts, but only {tasks} {unit} to do; ask for at most {tasks}")]
    TooManyParts {
        /// The parts.
        parts: usize,
        /// What can be dealt out.
        tasks: usize,
        /// What it is, in the plural.
        unit: &'static str,
    },
    /// Results cannot be read back.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Runs cannot be compared.
    #[error(transparent)]
    Comparison(#[from] ComparisonError),
    /// Runs differ; the comparison is out.
    #[error("the runs differ: {differences} columns, cases or time spans")]
    Different {
        /// How many of them.
        differences: usize,
    },
    /// A file that a template would write is there.
    #[error("{} is there already, and nothing was written; choose another folder", path.display())]
    FileThere {
        /// The file.
        path: PathBuf,
    },
    /// No clone of the repository.
    #[error(
        "{} is no clone of Linchpin, which a Rust worker is built with; give one with --source CLONE",
        path.display()
    )]
    NoClone {
        /// Where one was looked for.
        path: PathBuf,
    },
    /// No built-in model has this name.
    #[error("there is no built-in model {name:?}; there are: {names}")]
    NoModel {
        /// The name.
        name: String,
        /// Those that there are.
        names: String,
    },
    /// A built-in model has no parameter of this name.
    #[error("the model {model} has no parameter {name:?}; it has: {names}")]
    NoParameter {
        /// Name of the model.
        model: String,
        /// What was given.
        name: String,
        /// The parameters that it has.
        names: String,
    },
    /// A built-in model refuses its parameters.
    #[error("no description: {0}")]
    Models(CallError),
    /// No column of the results is meant.
    #[error(
        "no column of {} matches {pattern:?}; there are: {columns}; linchpin plot {} --list says what they show",
        folder.display(), folder.display()
    )]
    NoColumn {
        /// The folder of results.
        folder: PathBuf,
        /// What was asked for.
        pattern: String,
        /// Names of the columns, or the first of them.
        columns: String,
    },
    /// A time range that ends before it begins.
    #[error(
        "--from {from} is not before --to {to}; give a range of times in s, such as --from 0.2 --to 0.5"
    )]
    EmptyRange {
        /// Its start (s).
        from: f64,
        /// Its end (s).
        to: f64,
    },
    /// A run without a marker that has a place.
    #[error(
        "{} has no positions of markers; run the scene with --animate, which makes columns of them",
        folder.display()
    )]
    NothingToExport {
        /// The folder of results.
        folder: PathBuf,
    },
    /// A choice of columns and times without a point.
    #[error(
        "nothing to draw of {}: no row from t = {from} s to {to} s has a finite value of the chosen columns",
        folder.display()
    )]
    NothingToDraw {
        /// The folder of results.
        folder: PathBuf,
        /// Start of the range (s).
        from: f64,
        /// Its end (s).
        to: f64,
    },
    /// A scene is no FMU.
    #[error(transparent)]
    FmuExport(Box<FmuExportError>),
    /// A study has no result.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The scene does not say what to study.
    #[error(
        "{} has no [{section}] section, so there is nothing to study; write one, or give {flags}",
        path.display()
    )]
    NothingToStudy {
        /// The scene.
        path: PathBuf,
        /// Section of the scene file.
        section: &'static str,
        /// Flags that do the same.
        flags: &'static str,
    },
    /// A file for another command where a scene is asked for.
    #[error("{} {what} and no scene; give it to {command}", path.display())]
    NoScene {
        /// The file.
        path: PathBuf,
        /// What it is or does.
        what: &'static str,
        /// The command that takes it.
        command: &'static str,
    },
    /// Settings of a file that has none.
    #[error("--set changes scenes, and {} {what}; change the file itself", path.display())]
    NoSettings {
        /// The file.
        path: PathBuf,
        /// What it is or does.
        what: &'static str,
    },
    /// A scheme has no spectrum.
    #[error(transparent)]
    Spectrum(#[from] FailedCurve),
    /// A study and other files at once.
    #[error(
        "{} is a study, which stands alone; give one study, or one or more scenes",
        path.display()
    )]
    StudyAmongOthers {
        /// The study.
        path: PathBuf,
    },
    /// No worker at an address.
    #[error("no answer from {address}: {source}")]
    Start {
        /// The address.
        address: String,
        /// Why.
        source: Box<StartError>,
    },
    /// The worker answers, but it does not serve.
    #[error(
        "{address} answers, but it serves no {CONTRACT}: {state}; is it a worker, and is it starting or ending?"
    )]
    NotServing {
        /// The address.
        address: String,
        /// What it says, in the words of `grpc.health.v1`.
        state: &'static str,
    },
    /// The worker has no instance of a number.
    #[error(
        "{address} has no instance {number:#x}; linchpin instances {address} lists those that there are"
    )]
    NoInstance {
        /// The address.
        address: String,
        /// The number.
        number: u64,
    },
    /// The worker speaks another protocol.
    #[error("{address}: {source}")]
    Incompatible {
        /// The address.
        address: String,
        /// Both versions.
        source: Incompatible,
    },
    /// A worker cannot be examined.
    #[error("no report on the worker: {0}")]
    Conformance(#[from] Box<ConformanceError>),
    /// A worker is not what it should be; the report is out.
    #[error("{failed} of {checks} checks failed; docs/guide/conformance.md explains each")]
    NotConformant {
        /// How many checks failed.
        failed: usize,
        /// Of how many.
        checks: usize,
    },
    /// The report on a worker cannot be written.
    #[error("cannot write the report to {}: {source}", path.display())]
    UnwritableReport {
        /// The path.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// Too many macro steps of a run that came to its end are poor.
    #[error(
        "{steps} of {of} macro steps are poor, a share of {:.3}; run.most_poor allows {most}. Results are there, but their corrections \
         missed their aim\n  help: a smaller macro_step or a tolerance; see docs/guide/when-it-goes-wrong.md",
        *steps as f64 / *of as f64
    )]
    Poor {
        /// So many.
        steps: u64,
        /// Of so many.
        of: u64,
        /// The greatest share of them.
        most: f64,
    },
    /// Something speaks against the results of a run that must be beyond doubt.
    #[error(
        "--strict: {count} {} against the results, which are there",
        if *count == 1 { "warning speaks" } else { "warnings speak" }
    )]
    Strict {
        /// How many.
        count: usize,
    },
    /// A worker cannot listen.
    #[error(transparent)]
    Listen(#[from] ListenError),
    /// Certificates cannot be used.
    #[error(transparent)]
    Certificates(#[from] Box<CertificatesError>),
    /// A token cannot be used.
    #[error(transparent)]
    Token(#[from] TokenError),
    /// Certificates cannot be made.
    #[error(transparent)]
    NewCertificates(#[from] NewCertificatesError),
    /// A worker stopped.
    #[error(transparent)]
    Serve(#[from] ServeError),
    /// The system gave no runtime.
    #[error("cannot start: {0}")]
    System(#[from] std::io::Error),
}

impl From<CertificatesError> for CommandError {
    fn from(error: CertificatesError) -> Self {
        Self::Certificates(Box::new(error))
    }
}

impl From<FmuExportError> for CommandError {
    fn from(error: FmuExportError) -> Self {
        match error {
            FmuExportError::Scene(errors) => Self::Scene(*errors),
            FmuExportError::Run(error) => Self::Run(*error),
            error => Self::FmuExport(Box::new(error)),
        }
    }
}

impl CommandError {
    /// That a folder or file cannot be written, by the system's reason.
    pub fn unwritable(path: &Path) -> impl Fn(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Unwritable {
            path: path.clone(),
            source,
        }
    }

    /// What ended a simulation with this coupling; `table` is where the rows are that it recorded, if there are any.
    pub fn from_simulation(
        error: SimulateError<Self>,
        coupling: &Coupling,
        table: Option<PathBuf>,
    ) -> Self {
        match error {
            SimulateError::Run(RunError::Scene(errors)) => Self::Scene(errors),
            SimulateError::Run(source) => Self::Stopped {
                help: coupling.remedy(&source),
                source: Box::new(source),
                table,
            },
            SimulateError::Record(error) => error,
        }
    }

    /// Says which case an error belongs to, unless its place tells.
    pub fn in_case(self, case: &str) -> Self {
        if self.scene_errors().is_some() {
            return self;
        }
        Self::Case {
            case: case.to_owned(),
            source: Box::new(self),
        }
    }
}

fn help_line(help: Option<&str>) -> String {
    help.map_or_else(String::new, |help| format!("\n  help: {help}"))
}

fn note(table: Option<&Path>) -> String {
    table.map_or_else(String::new, |table| {
        format!("\n  note: {} has the rows up to there", table.display())
    })
}

/// What the system's reason for not writing means.
fn advice(source: &csv::Error) -> &'static str {
    match source.kind() {
        csv::ErrorKind::Io(error) if error.kind() == std::io::ErrorKind::FileTooLarge => {
            "; a limit on the size of files is reached (ulimit -f)"
        }
        _ => "",
    }
}
