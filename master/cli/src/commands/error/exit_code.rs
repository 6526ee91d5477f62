//! How a command ends that fails.

use linchpin_master::RunError;
use linchpin_master::scene::SceneErrors;

use super::CommandError;
use crate::certificates::NewCertificatesError;
use crate::interrupt::{self, Request};
use crate::output::checkpoint::ResumeError;

impl CommandError {
    /// Whether the command ended early since somebody asked for that.
    pub fn is_interrupt(&self) -> bool {
        match self {
            Self::Case { source, .. } => source.is_interrupt(),
            Self::Run(error) => is_interrupt(error),
            Self::Stopped { source, .. } => is_interrupt(source),
            Self::Study(error) => error.is_interrupt(),
            _ => false,
        }
    }

    /// Exit code: 2 for mistakes that a check of the scene finds, after a signal 128 and its number, 1 for everything else that
    /// happens later.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Case { source, .. } => source.exit_code(),
            _ if self.is_interrupt() => interrupt::received().map_or(1, Request::exit_code),
            Self::NothingToStudy { .. }
            | Self::Resume(ResumeError::NoCheckpoint { .. } | ResumeError::OtherRun { .. })
            | Self::NothingToAnimate
            | Self::NewCertificates(NewCertificatesError::NoWorker { .. })
            | Self::Fmu(_)
            | Self::TooManyParts { .. }
            | Self::NoScene { .. }
            | Self::NoSettings { .. }
            | Self::Read(_)
            | Self::FileThere { .. }
            | Self::NoClone { .. }
            | Self::NoModel { .. }
            | Self::Models(_)
            | Self::NoParameter { .. }
            | Self::Comparison(_)
            | Self::NoColumn { .. }
            | Self::EmptyRange { .. }
            | Self::NothingToDraw { .. }
            | Self::NothingToExport { .. }
            | Self::FmuExport(_)
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
}

fn is_interrupt(error: &RunError) -> bool {
    matches!(error, RunError::Interrupted { .. })
}
