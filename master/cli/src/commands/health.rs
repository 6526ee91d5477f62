//! `linchpin health`: whether a worker serves.

use linchpin_master::connection::{ServingStatus, health};

use super::CommandError;
use super::common::{WorkerArguments, print};

/// Ask a running worker whether it serves, as a health check does
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin health http://127.0.0.1:50051
  linchpin health unix:/run/linchpin/mass1.sock --timeout 1
  linchpin health https://127.0.0.1:50051 --certificates certificates/workers/mass1     where the worker itself runs

Asks the standard service grpc.health.v1.Health for linchpin.v1.Worker. While nobody listens it
tries again until the time is over, so that it also waits for a worker that is starting.
Exit code 0 if the worker serves, 1 if not.")]
pub struct Arguments {
    #[command(flatten)]
    worker: WorkerArguments,
}

/// Asks, and prints that the worker serves.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let worker = &arguments.worker;
    let found = health(worker.address(), worker.limits(), &worker.access()?);
    let found = found.map_err(|source| worker.failed(source))?;
    match found {
        ServingStatus::Serving => print("serving\n"),
        other => Err(CommandError::NotServing {
            address: worker.address().to_owned(),
            state: other.as_str_name(),
        }),
    }
}
