//! Why a study has no result.

use linchpin_master::RunError;
use linchpin_master::scene::SceneErrors;
use linchpin_proto::readable::number;

use super::Share;

/// Why a study has no result.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A setting that the study brings in does not fit the scene.
    #[error(transparent)]
    Scene(#[from] SceneErrors),
    /// A result cannot be written as JSON.
    #[error("the results cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// Parts are missing, or not whole.
    #[error(
        "{} missing or not whole: make what is missing with --part {}, then --merge again",
        if parts.len() == 1 { "a part is" } else { "parts are" },
        readable(parts)
    )]
    PartsMissing {
        /// Which.
        parts: Vec<Share>,
    },
    /// A run failed in another way than by diverging.
    #[error("{case}: {source}")]
    Run {
        /// Which case, for the message.
        case: String,
        /// Why.
        source: RunError,
    },
    /// There is no exact solution to compare with.
    #[error(
        "{case}: no closed form is known for this scene; it must consist of built-in oscillators that rigid links make one \
         body and that start alike. Compare with the finest run: --reference finest"
    )]
    NoClosedForm {
        /// Which case, for the message.
        case: String,
    },
    /// The run that all others are compared with diverged.
    #[error(
        "{case}: without closed form and [monolithic] the scene as its file has it, with H = {macro_step} s, is the \
         reference, but it diverged: {reason}",
        macro_step = number(*macro_step)
    )]
    ReferenceDiverged {
        /// Which case, for the message.
        case: String,
        /// Macro step in s.
        macro_step: f64,
        /// How.
        reason: String,
    },
    /// There is no monolithic scene to compare with.
    #[error(
        "{case}: no monolithic scene is known for this system: the scene file has no [monolithic], or a parameter, a joint, a \
         connection or the start was changed since, and the monolithic scene does not follow. Compare with the finest \
         run: --reference finest"
    )]
    NoMonolithic {
        /// Which case, for the message.
        case: String,
    },
    /// The monolithic scene has no solution to compare with.
    #[error("{case}: the monolithic scene is the reference, but its run diverged: {reason}")]
    MonolithicDiverged {
        /// Which case, for the message.
        case: String,
        /// How.
        reason: String,
    },
}

/// Most parts that a message names.
const MOST_NAMED: usize = 8;

fn readable(parts: &[Share]) -> String {
    let named: Vec<String> = parts
        .iter()
        .take(MOST_NAMED)
        .map(Share::to_string)
        .collect();
    let more = match parts.len().saturating_sub(MOST_NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    named.join(", ") + &more
}

impl StudyError {
    /// Whether somebody asked the study to end.
    pub fn is_interrupt(&self) -> bool {
        let source = match self {
            Self::Run { source, .. } => source,
            _ => return false,
        };
        matches!(source, RunError::Interrupted { .. })
    }

    /// The mistakes in the scene, if it is these.
    pub fn scene_errors(&self) -> Option<&SceneErrors> {
        match self {
            Self::Scene(errors)
            | Self::Run {
                source: RunError::Scene(errors),
                ..
            } => Some(errors),
            _ => None,
        }
    }
}
