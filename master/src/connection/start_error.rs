//! Why there is no worker.

use linchpin_proto::certificates::CertificatesError;
use linchpin_proto::contract::CallError;
use linchpin_proto::token::TokenError;

use super::exit_message::ExitMessage;
use super::launch::LaunchError;

/// Why a worker is not there.
#[derive(Debug, thiserror::Error)]
pub enum StartError {
    /// Its process could not be started.
    #[error(transparent)]
    Launch(#[from] LaunchError),
    /// Its process ended before it answered.
    #[error("the worker did not answer{0}")]
    Ended(ExitMessage),
    /// Its process runs, but does not listen.
    #[error(
        "the worker was started, but nothing listens at {address} after {seconds} s; its program must listen at the \
         address that stands in place of {{address}} in the command, or behind --listen at its end; \
         run.start_timeout gives it more time{exit_message}"
    )]
    Silent {
        /// Where it should listen.
        address: String,
        /// The time limit.
        seconds: f64,
        /// Last lines of its error output.
        exit_message: ExitMessage,
    },
    /// The certificates of the master cannot be used.
    #[error(transparent)]
    Certificates(#[from] CertificatesError),
    /// The token of the master cannot be used.
    #[error(transparent)]
    Token(#[from] TokenError),
    /// It does not answer.
    #[error("{0}{advice}", advice = advice(.0))]
    Call(#[from] CallError),
    /// It lives in the process of its master.
    #[error("a worker in the process of its master cannot be made anew")]
    SameProcess,
    /// The connections of this master cannot be driven.
    #[error("cannot set up the connections: {0}")]
    Runtime(#[from] std::io::Error),
}

fn advice(error: &CallError) -> &'static str {
    match error {
        CallError::Unreachable { .. } => "; is the worker running, and is the address right?",
        CallError::Deadline { .. } => {
            "; something listens there but keeps silent: is it a worker of the contract linchpin.v1, and is it busy?"
        }
        CallError::Lost { .. } | CallError::Unimplemented { .. } | CallError::Misplaced { .. } => {
            "; is it a worker of the contract linchpin.v1?"
        }
        CallError::Failed(_)
        | CallError::NoInstance { .. }
        | CallError::Denied { .. }
        | CallError::Untrusted { .. }
        | CallError::Interrupted => "",
    }
}
