//! What every connection can do.

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{ExchangeReply, ExchangeRequest};

use super::exit_message::ExitMessage;
use super::start_error::StartError;

/// A worker that one subsystem of a scene lives in.
pub trait Connection: Send {
    /// The calls outside the macro step.
    fn contract(&self) -> &dyn Contract;

    /// Sends a request; its answer is due at [`Connection::collect`]. One at a time.
    fn post(&mut self, request: &ExchangeRequest) -> Result<(), CallError>;

    /// Waits for the answer to the posted request. `reply` is overwritten.
    fn collect(&mut self, reply: &mut ExchangeReply) -> Result<(), CallError>;

    /// What a worker that this master started left behind when its connection was lost; empty if unknown.
    fn exit_message(&self) -> ExitMessage {
        ExitMessage::default()
    }

    /// Whether [`Connection::renew`] can make another worker.
    fn is_renewable(&self) -> bool {
        false
    }

    /// Gives the worker up and makes another one in its place, without any instance.
    ///
    /// # Errors
    /// It cannot be started or reached; [`StartError::SameProcess`] where there is nothing to make anew.
    fn renew(&mut self) -> Result<(), StartError> {
        Err(StartError::SameProcess)
    }

    /// Which way the exchange takes, for the summary.
    fn route(&self) -> &'static str;
}
