//! How the worker is reached: in this process, at an address, or by starting its command.

use std::sync::Arc;
use std::time::{Duration, Instant};

use linchpin_master::Interrupt;
use linchpin_master::connection::{
    Access, Connection, Direct, ExchangeStream, ExitMessage, Grpc, Launcher, StartError,
    TimeLimits, WorkerLogs, WorkerProcess, new_runtime,
};
use linchpin_proto::contract::{CallError, Contract};
use tokio::runtime::Runtime;

/// A worker to which any number of connections can be made, each with unary calls and an exchange stream of its own.
pub trait Peer {
    /// A new connection.
    ///
    /// # Errors
    /// [`StartError`] if the worker does not answer.
    fn connect(&self) -> Result<Box<dyn Connection>, StartError>;

    /// The same worker in a process of its own; `None` where it cannot be started once more from here.
    ///
    /// # Errors
    /// [`StartError`] if it does not answer.
    fn another_process(&self) -> Result<Option<Box<dyn Peer>>, StartError> {
        Ok(None)
    }

    /// What its process left behind if it has ended.
    fn last_words(&self) -> ExitMessage {
        ExitMessage::default()
    }
}

/// A worker in this process. Its calls have no time limit.
pub struct InProcess(pub Arc<dyn Contract>);

impl Peer for InProcess {
    fn connect(&self) -> Result<Box<dyn Connection>, StartError> {
        Ok(Box::new(Direct::new(Arc::clone(&self.0))))
    }
}

/// A worker that listens at an address. Every call has a time limit, Restore as well.
pub struct AtAddress {
    address: String,
    limits: TimeLimits,
    access: Access,
    runtime: Arc<Runtime>,
}

impl AtAddress {
    /// The worker at an address; nothing is sent yet. Every call may take `limit`.
    ///
    /// # Errors
    /// [`StartError::Runtime`].
    pub fn new(address: String, access: Access, limit: Duration) -> Result<Self, StartError> {
        Ok(Self {
            address,
            limits: TimeLimits {
                start: limit,
                answer: limit,
            },
            access,
            runtime: new_runtime()?,
        })
    }

    fn reach(&self, limits: TimeLimits) -> Result<Grpc, CallError> {
        let runtime = Arc::clone(&self.runtime);
        Grpc::connect(
            &self.address,
            limits,
            &self.access,
            runtime,
            Interrupt::default(),
        )
    }
}

impl Peer for AtAddress {
    fn connect(&self) -> Result<Box<dyn Connection>, StartError> {
        Ok(Box::new(ExchangeStream::new(self.reach(self.limits)?)))
    }
}

/// A worker that was started for the examination and ends with it.
pub struct Started {
    // Dropped in this order.
    at: AtAddress,
    process: WorkerProcess,
    _launcher: Launcher,
    command: Vec<String>,
    limit: Duration,
}

/// How long one attempt to reach a starting worker lasts before its process is looked after.
const ATTEMPT: Duration = Duration::from_millis(50);

/// Name of its socket and its log.
const NAME: &str = "worker";

impl Started {
    /// Starts `command`, with the address in the place of `{address}` or behind `--listen` at its end, and waits until it
    /// listens.
    ///
    /// # Errors
    /// [`StartError`]: no such program, or it ends or keeps silent.
    pub fn new(command: &[String], limit: Duration) -> Result<Self, StartError> {
        let launcher = Launcher::new(WorkerLogs::default())?;
        let process = launcher.start(NAME, command)?;
        let at = AtAddress::new(process.address().to_owned(), Access::default(), limit)?;
        let attempt = TimeLimits {
            start: ATTEMPT,
            ..at.limits
        };
        let give_up = Instant::now() + limit;
        while let Err(error) = at.reach(attempt) {
            if process.ended().is_some() {
                return Err(StartError::Ended(process.exit_message()));
            }
            if Instant::now() >= give_up {
                return Err(match error {
                    CallError::Unreachable { address, .. } => StartError::Silent {
                        address,
                        seconds: limit.as_secs_f64(),
                        exit_message: process.exit_message(),
                    },
                    other => other.into(),
                });
            }
        }
        Ok(Self {
            at,
            process,
            _launcher: launcher,
            command: command.to_vec(),
            limit,
        })
    }
}

impl Peer for Started {
    fn connect(&self) -> Result<Box<dyn Connection>, StartError> {
        self.at.connect()
    }

    fn another_process(&self) -> Result<Option<Box<dyn Peer>>, StartError> {
        Ok(Some(Box::new(Self::new(&self.command, self.limit)?)))
    }

    fn last_words(&self) -> ExitMessage {
        self.process.exit_message()
    }
}
