//! Workers that are made anew when they are lost.

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{ExchangeReply, ExchangeRequest};

use super::exit_message::ExitMessage;
use super::start_error::StartError;
use super::worker::Connection;

/// How a worker is started, or reached once more.
type Make = Box<dyn Fn() -> Result<Box<dyn Connection>, StartError> + Send>;

/// A connection that can be made again in the way in which it was made first.
pub struct Renewable {
    connection: Box<dyn Connection>,
    make: Make,
}

impl Renewable {
    /// The first connection.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn new(
        make: impl Fn() -> Result<Box<dyn Connection>, StartError> + Send + 'static,
    ) -> Result<Self, StartError> {
        Ok(Self {
            connection: make()?,
            make: Box::new(make),
        })
    }
}

impl Connection for Renewable {
    fn contract(&self) -> &dyn Contract {
        self.connection.contract()
    }

    fn post(&mut self, request: &ExchangeRequest) -> Result<(), CallError> {
        self.connection.post(request)
    }

    fn collect(&mut self, reply: &mut ExchangeReply) -> Result<(), CallError> {
        self.connection.collect(reply)
    }

    fn exit_message(&self) -> ExitMessage {
        self.connection.exit_message()
    }

    fn is_renewable(&self) -> bool {
        true
    }

    fn renew(&mut self) -> Result<(), StartError> {
        // The old one ends here, with its process.
        self.connection = (self.make)()?;
        Ok(())
    }

    fn route(&self) -> &'static str {
        self.connection.route()
    }
}
