//! Connections to workers: in this process, on another thread, or behind gRPC.
//!
//! A [`Connection`] splits the exchange in two, so that all workers compute at the same time: the master posts to
//! every worker, then collects from every worker.

mod address;
mod channel;
mod direct;
mod exit_message;
mod grpc;
mod health;
mod launch;
mod not_recovered;
mod output;
mod renewable;
mod start_error;
mod stream;
mod threaded;
mod time_limits;
mod unary_turns;
mod waiting;
mod witness;
mod worker;

use std::sync::Arc;
use std::time::{Duration, Instant};

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1;
use linchpin_proto::version::{PROTOCOL, knows_whole_exchange};
use tokio::runtime::Runtime;

use crate::interrupt::Interrupt;

pub use address::{Access, Host, NoAccess, WorkerAddress};
pub use direct::Direct;
pub use exit_message::ExitMessage;
pub use grpc::{Grpc, new_runtime};
pub use health::{CONTRACT, health};
pub use launch::{LaunchError, Launcher, WorkerProcess};
pub use not_recovered::NotRecovered;
pub use output::WorkerLogs;
pub use renewable::{Reached, Renewable};
pub use start_error::StartError;
pub use stream::ExchangeStream;
pub use threaded::Threaded;
pub use time_limits::TimeLimits;
pub use tonic_health::pb::health_check_response::ServingStatus;
pub use unary_turns::UnaryTurns;
pub use worker::Connection;

/// How a worker is reached.
#[derive(Clone)]
pub struct ConnectOptions {
    /// Model that will be used; `None`: the worker's first.
    pub model: Option<String>,
    /// Never use the exchange stream.
    pub unary_only: bool,
    /// Time limits.
    pub limits: TimeLimits,
    /// How long to poll for an answer on the exchange stream before sleeping: see [`ExchangeStream::polling`].
    pub polling: Duration,
    /// By what right it is called.
    pub access: Access,
    /// Drives all streams of a master.
    pub runtime: Arc<Runtime>,
    /// Ends every wait for the worker.
    pub interrupt: Interrupt,
}

/// Connects to the worker at `address` (`https://HOST:PORT`, `http://HOST:PORT` or `unix:/PATH`) and chooses its route: the exchange stream
/// where the worker serves one that knows every part of a request, otherwise the unary calls on a thread of its own.
pub fn connect(address: &str, options: &ConnectOptions) -> Result<Box<dyn Connection>, CallError> {
    let grpc = connect_on(Arc::clone(&options.runtime), address, options)?;
    let description = grpc.describe(&v1::DescribeRequest {
        protocol: Some(PROTOCOL),
        ..Default::default()
    })?;
    if !options.unary_only && serves_exchange(&description, options.model.as_deref()) {
        return Ok(Box::new(ExchangeStream::new(grpc).polling(options.polling)));
    }
    // Its own runtime: the unary calls of several workers run at the same time on several threads.
    let runtime = new_runtime().map_err(|error| CallError::Unreachable {
        address: address.to_owned(),
        reason: error.to_string(),
    })?;
    let grpc = connect_on(runtime, address, options)?;
    Ok(Box::new(Threaded::new(
        Arc::new(UnaryTurns::new(grpc)),
        "unary calls",
    )))
}

fn connect_on(
    runtime: Arc<Runtime>,
    address: &str,
    options: &ConnectOptions,
) -> Result<Grpc, CallError> {
    let interrupt = options.interrupt.clone();
    Grpc::connect(address, options.limits, &options.access, runtime, interrupt)
}

fn serves_exchange(description: &v1::DescribeReply, model: Option<&str>) -> bool {
    if !knows_whole_exchange(description.protocol.as_ref()) {
        return false;
    }
    let mut models = description.models.iter();
    let model = match model {
        Some(name) => models.find(|model| model.name == name),
        None => models.next(),
    };
    model
        .and_then(|model| model.capabilities)
        .is_some_and(|capabilities| capabilities.exchange)
}

/// How long one attempt to reach a starting worker lasts before its process is looked after.
const ATTEMPT: Duration = Duration::from_millis(50);

/// Connects to a worker that was started, as soon as it listens.
///
/// # Errors
/// [`StartError::Ended`], [`StartError::Silent`], and those of the first call.
pub fn reach_started(
    process: WorkerProcess,
    options: &ConnectOptions,
) -> Result<Reached, StartError> {
    let give_up = Instant::now() + options.limits.start;
    loop {
        let attempt = ConnectOptions {
            limits: TimeLimits {
                start: ATTEMPT,
                ..options.limits
            },
            ..options.clone()
        };
        let reached = connect(process.address(), &attempt);
        if process.ended().is_some() {
            return Err(StartError::Ended(process.exit_message()));
        }
        match reached {
            Ok(connection) => {
                let runtime = Arc::clone(&options.runtime);
                return Ok(Reached::with_process(connection, process, runtime));
            }
            Err(CallError::Unreachable { .. }) if Instant::now() < give_up => {}
            Err(CallError::Unreachable { address, .. }) => {
                return Err(StartError::Silent {
                    address,
                    seconds: options.limits.start.as_secs_f64(),
                    exit_message: process.exit_message(),
                });
            }
            Err(error) => return Err(error.into()),
        }
    }
}
