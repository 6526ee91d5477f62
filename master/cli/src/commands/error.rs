//! Why a command failed, and how it ends the process.

use std::path::{Path, PathBuf};

use linchpin_master::RunError;
use linchpin_master::connection::StartError;
use linchpin_master::scene::SceneErrors;
use linchpin_proto::version::Incompatible;
use linchpin_worker::server::{ListenError, ServeError};

use crate::interrupt;
use crate::plot::PlotError;
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
    /// The run stopped, with results up to there.
    #[error("{source}\n  note: {} has the rows up to there", table.display())]
    Stopped {
        /// Why.
        source: Box<RunError>,
        /// The table of results.
        table: PathBuf,
    },
    /// A case of the scene failed.
    #[error("case \"{case}\": {source}")]
    Case {
        /// Name of the case.
        case: String,
        /// Why.
        source: Box<CommandError>,
    },
    /// The standard output takes nothing more.
    #[error("cannot write to the standard output: {0}")]
    Output(std::io::Error),
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
    #[error("{}: {source}", path.display())]
    Table {
        /// The path.
        path: PathBuf,
        /// Why.
        source: csv::Error,
    },
    /// A picture cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
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
    /// A file for `linchpin spectrum` where a scene is asked for.
    #[error(
        "{} describes spectra of integration schemes and no scene; give it to linchpin spectrum",
        path.display()
    )]
    NoScene {
        /// The file.
        path: PathBuf,
    },
    /// Settings of a file that has none.
    #[error(
        "--set changes scenes, and {} describes spectra of integration schemes; change the file itself",
        path.display()
    )]
    NoSettings {
        /// The file.
        path: PathBuf,
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
    #[error("no description from {address}: {source}")]
    Start {
        /// The address.
        address: String,
        /// Why.
        source: Box<StartError>,
    },
    /// The worker speaks another protocol.
    #[error("{address}: {source}")]
    Incompatible {
        /// The address.
        address: String,
        /// Both versions.
        source: Incompatible,
    },
    /// A worker cannot listen.
    #[error(transparent)]
    Listen(#[from] ListenError),
    /// A worker stopped.
    #[error(transparent)]
    Serve(#[from] ServeError),
    /// The system gave no runtime.
    #[error("cannot start: {0}")]
    System(#[from] std::io::Error),
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

    /// Exit code: 2 for mistakes that a check of the scene finds, [`interrupt::EXIT_CODE`] after an interrupt, 1 for
    /// everything else that happens later.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Case { source, .. } => source.exit_code(),
            Self::Run(RunError::Interrupted { .. }) => interrupt::EXIT_CODE,
            Self::Stopped { source, .. } if matches!(**source, RunError::Interrupted { .. }) => {
                interrupt::EXIT_CODE
            }
            Self::NothingToStudy { .. }
            | Self::NothingToAnimate
            | Self::NoScene { .. }
            | Self::NoSettings { .. }
            | Self::StudyAmongOthers { .. } => 2,
            _ if self.scene_errors().is_some() => 2,
            _ => 1,
        }
    }

    /// The mistakes in the scene, if it is these.
    pub fn scene_errors(&self) -> Option<&SceneErrors> {
        match self {
            Self::Scene(errors) | Self::Run(RunError::Scene(errors)) => Some(errors),
            Self::Study(error) => error.scene_errors(),
            _ => None,
        }
    }

    /// What ended a simulation; `table` is where the rows are that it recorded, if there are any.
    pub fn from_simulation(error: SimulateError<Self>, table: Option<PathBuf>) -> Self {
        match (error, table) {
            (SimulateError::Run(source), Some(table)) => Self::Stopped {
                source: Box::new(source),
                table,
            },
            (SimulateError::Run(source), None) => Self::Run(source),
            (SimulateError::Record(error), _) => error,
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
