//! Whether a worker serves, by the standard service `grpc.health.v1.Health`.

use linchpin_proto::status::to_error;
use linchpin_proto::v1::worker_server::SERVICE_NAME;
use tonic::Code;
use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_check_response::ServingStatus;
use tonic_health::pb::health_client::HealthClient;

use super::address::Access;
use super::channel::{Opened, open};
use super::grpc::new_runtime;
use super::start_error::StartError;
use super::time_limits::TimeLimits;
use super::waiting::within;
use crate::interrupt::Interrupt;

/// The gRPC service of a worker.
pub const CONTRACT: &str = SERVICE_NAME;

/// What the worker at `address` (`https://HOST:PORT`, `http://HOST:PORT` or `unix:/PATH`) says of the service [`CONTRACT`]. Nothing but
/// [`ServingStatus::Serving`] is good; [`ServingStatus::ServiceUnknown`] means that something else listens there.
///
/// # Errors
/// [`StartError::Call`] if nobody answers within the time limits or there is no health service; [`StartError::Runtime`].
pub fn health(
    address: &str,
    limits: TimeLimits,
    access: &Access,
) -> Result<ServingStatus, StartError> {
    let runtime = new_runtime()?;
    let interrupt = Interrupt::default();
    let Opened { channel, witness } = open(address, limits, access, &runtime, &interrupt)?;
    let mut client = HealthClient::new(channel);
    let request = HealthCheckRequest {
        service: CONTRACT.to_owned(),
    };
    let answer = runtime.block_on(async { within(limits.answer, client.check(request)).await })?;
    match answer {
        Ok(reply) => Ok(reply.into_inner().status()),
        Err(status) if status.code() == Code::NotFound => Ok(ServingStatus::ServiceUnknown),
        Err(status) => {
            let error = to_error("grpc.health.v1.Health.Check", &status);
            Err(witness.explain(address, error).into())
        }
    }
}
