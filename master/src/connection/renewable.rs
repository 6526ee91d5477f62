//! Workers that are made anew when they are lost.

use std::sync::Arc;

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{ExchangeReply, ExchangeRequest};
use tokio::runtime::Runtime;

use super::exit_message::ExitMessage;
use super::launch::WorkerProcess;
use super::start_error::StartError;
use super::worker::Connection;

/// A connection, and the worker process that serves it if that ends with the connection.
pub struct Reached {
    // Dropped in this order.
    connection: Box<dyn Connection>,
    process: Option<Ending>,
}

/// Ends a worker process when it is dropped.
struct Ending {
    process: WorkerProcess,
    runtime: Arc<Runtime>,
}

impl Drop for Ending {
    fn drop(&mut self) {
        // The runtime closes the sockets only while it runs, and a worker ends only when its sockets are closed.
        self.runtime.block_on(self.process.end());
    }
}

impl Reached {
    /// A worker that somebody else has started.
    pub fn alone(connection: Box<dyn Connection>) -> Self {
        Self {
            connection,
            process: None,
        }
    }

    /// A worker whose process ends with the connection, which `runtime` drives.
    pub fn with_process(
        connection: Box<dyn Connection>,
        process: WorkerProcess,
        runtime: Arc<Runtime>,
    ) -> Self {
        Self {
            connection,
            process: Some(Ending { process, runtime }),
        }
    }
}

/// How a worker is started, or reached once more.
type Make = Box<dyn Fn() -> Result<Reached, StartError> + Send>;

/// A connection that can be made again in the way in which it was made first.
pub struct Renewable {
    reached: Reached,
    make: Make,
}

impl Renewable {
    /// The first connection.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn new(
        make: impl Fn() -> Result<Reached, StartError> + Send + 'static,
    ) -> Result<Self, StartError> {
        Ok(Self {
            reached: make()?,
            make: Box::new(make),
        })
    }
}

impl Connection for Renewable {
    fn contract(&self) -> &dyn Contract {
        self.reached.connection.contract()
    }

    fn post(&mut self, request: &ExchangeRequest) -> Result<(), CallError> {
        self.reached.connection.post(request)
    }

    fn collect(&mut self, reply: &mut ExchangeReply) -> Result<(), CallError> {
        self.reached.connection.collect(reply)
    }

    fn exit_message(&self) -> ExitMessage {
        let process = self.reached.process.as_ref();
        process.map_or_else(ExitMessage::default, |own| own.process.exit_message())
    }

    fn is_renewable(&self) -> bool {
        true
    }

    fn renew(&mut self) -> Result<(), StartError> {
        // The old one ends here, with its process.
        self.reached = (self.make)()?;
        Ok(())
    }

    fn route(&self) -> &'static str {
        self.reached.connection.route()
    }
}
