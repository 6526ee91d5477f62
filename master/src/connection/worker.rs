//! What every connection can do.

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{ExchangeReply, ExchangeRequest};

use super::exit_message::ExitMessage;

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

    /// Which way the exchange takes, for the summary.
    fn route(&self) -> &'static str;
}
