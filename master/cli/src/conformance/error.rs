//! Why a worker cannot be examined at all.

use linchpin_master::connection::StartError;
use linchpin_proto::contract::CallError;
use linchpin_proto::version::Incompatible;

use super::verdict::Stop;

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum ConformanceError {
    /// The worker is not there.
    #[error(transparent)]
    Start(Box<StartError>),
    /// It speaks another protocol.
    #[error(transparent)]
    Incompatible(#[from] Incompatible),
    /// It does not describe itself.
    #[error("the worker does not answer Describe: {0}")]
    Describe(Box<CallError>),
    /// It has no model.
    #[error("the worker describes no model; Describe must name at least one")]
    NoModel,
    /// It has several, and none was named.
    #[error("the worker has several models; choose one with --model: {known}")]
    WhichModel {
        /// Their names, separated by commas.
        known: String,
    },
    /// It has no such model.
    #[error("the worker has no model \"{name}\"; it has: {known}")]
    UnknownModel {
        /// What was asked for.
        name: String,
        /// What there is, separated by commas.
        known: String,
    },
    /// A marker names a variable that the model does not have.
    #[error(
        "marker \"{marker}\" names {what} \"{name}\", which is none of those that the model describes"
    )]
    UnknownVariable {
        /// The marker.
        marker: String,
        /// `output` or `input`.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// It makes no instance.
    #[error(
        "the worker makes no instance of \"{model}\": {source}; parameters are given with --parameter NAME=VALUE"
    )]
    Initialize {
        /// The model.
        model: String,
        /// Why.
        source: Box<CallError>,
    },
    /// It steps in no way.
    #[error("the model \"{model}\" takes no steps from its start, even without loads: {source}")]
    Steps {
        /// The model.
        model: String,
        /// Why.
        source: Box<CallError>,
    },
    /// Its answers have no use.
    #[error("the model \"{model}\" gives useless answers at its start: {reason}")]
    Answers {
        /// The model.
        model: String,
        /// What is wrong with them.
        reason: String,
    },
}

impl From<StartError> for ConformanceError {
    fn from(error: StartError) -> Self {
        Self::Start(Box::new(error))
    }
}

impl ConformanceError {
    /// That `model` is of no use without any load.
    pub(super) fn useless(model: &str, stop: Stop) -> Self {
        let model = model.to_owned();
        match stop {
            Stop::Call(error) => Self::Steps {
                model,
                source: Box::new(error),
            },
            Stop::Connection(error) => Self::Start(error),
            Stop::Answer(reason) | Stop::NotApplicable(reason) => Self::Answers { model, reason },
        }
    }
}
