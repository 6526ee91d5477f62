//! The unary calls of a worker behind gRPC, as blocking calls.

use std::future::Future;
use std::sync::Arc;
use std::time::Duration;

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::label::{Labelled, check_label};
use linchpin_proto::status::to_error;
use linchpin_proto::v1::worker_client::WorkerClient;
use linchpin_proto::v1::*;
use tokio::runtime::Runtime;
use tonic::{Response, Status};
use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_client::HealthClient;

use super::address::Access;
use super::channel::{Authorized, Opened, open};
use super::time_limits::TimeLimits;
use super::waiting::{unless, within};
use super::witness::Witness;
use crate::interrupt::Interrupt;

/// Largest message that is accepted or sent, in bytes: what a worker is told to send with `--max-message` passes, and no worker can fill
/// the memory of its master by one answer.
const MESSAGE_LIMIT: usize = 256 << 20;

/// Longest time for the end of an instance: a worker that hangs must not hold up the end of a run.
const TERMINATE_TIMEOUT: Duration = Duration::from_secs(1);

/// Longest time for a sign of life of a worker whose answer is late.
const SIGN_OF_LIFE: Duration = Duration::from_millis(500);

/// A worker behind gRPC.
pub struct Grpc {
    pub(super) client: WorkerClient<Authorized>,
    channel: Authorized,
    pub(super) runtime: Arc<Runtime>,
    pub(super) limits: TimeLimits,
    pub(super) interrupt: Interrupt,
    address: String,
    witness: Witness,
}

/// A runtime for the connections of one thread. It runs only while a call blocks on it.
pub fn new_runtime() -> std::io::Result<Arc<Runtime>> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    Ok(Arc::new(runtime))
}

impl Grpc {
    /// Connects to `address`, trying again until the time limit for starts is over. After an `interrupt`, calls fail at
    /// once.
    ///
    /// # Errors
    /// [`CallError::Unreachable`]; [`CallError::Untrusted`], which calls may end with as well: that a worker refuses the certificate
    /// of its master shows only at the first of them.
    pub fn connect(
        address: &str,
        limits: TimeLimits,
        access: &Access,
        runtime: Arc<Runtime>,
        interrupt: Interrupt,
    ) -> Result<Self, CallError> {
        let Opened { channel, witness } = open(address, limits, access, &runtime, &interrupt)?;
        let client = WorkerClient::new(channel.clone())
            .max_decoding_message_size(MESSAGE_LIMIT)
            .max_encoding_message_size(MESSAGE_LIMIT);
        Ok(Self {
            client,
            channel,
            runtime,
            limits,
            interrupt,
            address: address.to_owned(),
            witness,
        })
    }

    /// Where an answer is late: whether the worker answers something else, which tells one that computes from one that hangs.
    pub(super) async fn with_sign_of_life<T>(
        &self,
        answer: Result<T, CallError>,
    ) -> Result<T, CallError> {
        let Err(CallError::Deadline { seconds, .. }) = answer else {
            return answer;
        };
        let mut client = HealthClient::new(self.channel.clone());
        let check = client.check(HealthCheckRequest::default());
        let told = unless(&self.interrupt, within(SIGN_OF_LIFE, check)).await?;
        let alive = match told {
            Ok(Ok(_)) => true,
            // Also a worker without this service is alive; what the transport says has a source.
            Ok(Err(status)) => std::error::Error::source(&status).is_none(),
            Err(_) => false,
        };
        Err(CallError::Deadline {
            seconds,
            alive: Some(alive),
        })
    }

    fn call<Q: Clone + Labelled, A: Labelled, F>(
        &self,
        name: &'static str,
        request: &Q,
        call: impl FnOnce(WorkerClient<Authorized>, Q) -> F,
    ) -> Result<A, CallError>
    where
        F: Future<Output = Result<Response<A>, Status>>,
    {
        let answer = call(self.client.clone(), request.clone());
        let answer = unless(&self.interrupt, within(self.limits.answer, answer));
        let answer = self.runtime.block_on(async {
            let answer = answer.await?;
            self.with_sign_of_life(answer).await
        })?;
        let failed = |status| self.witness.explain(&self.address, to_error(name, &status));
        let reply = answer.map_err(failed)?;
        let reply = reply.into_inner();
        check_label(name, request, &reply)?;
        Ok(reply)
    }
}

impl Contract for Grpc {
    fn describe(&self, request: &DescribeRequest) -> Result<DescribeReply, CallError> {
        let reply = self.call("Describe", request, async |mut client, request| {
            client.describe(request).await
        })?;
        Ok(reply.cleaned())
    }

    fn initialize(&self, request: &InitializeRequest) -> Result<InitializeReply, CallError> {
        self.call("Initialize", request, async |mut client, request| {
            client.initialize(request).await
        })
    }

    fn snapshot(&self, request: &SnapshotRequest) -> Result<SnapshotReply, CallError> {
        self.call("Snapshot", request, async |mut client, request| {
            client.snapshot(request).await
        })
    }

    fn restore(&self, request: &RestoreRequest) -> Result<RestoreReply, CallError> {
        self.call("Restore", request, async |mut client, request| {
            client.restore(request).await
        })
    }

    fn export_state(&self, request: &ExportStateRequest) -> Result<ExportStateReply, CallError> {
        self.call("ExportState", request, async |mut client, request| {
            client.export_state(request).await
        })
    }

    fn import_state(&self, request: &ImportStateRequest) -> Result<ImportStateReply, CallError> {
        self.call("ImportState", request, async |mut client, request| {
            client.import_state(request).await
        })
    }

    fn step(&self, request: &StepRequest) -> Result<StepReply, CallError> {
        self.call("Step", request, async |mut client, request| {
            client.step(request).await
        })
    }

    fn perturbed_step(
        &self,
        request: &PerturbedStepRequest,
    ) -> Result<PerturbedStepReply, CallError> {
        self.call("PerturbedStep", request, async |mut client, request| {
            client.perturbed_step(request).await
        })
    }

    fn evaluate(&self, request: &EvaluateRequest) -> Result<EvaluateReply, CallError> {
        self.call("Evaluate", request, async |mut client, request| {
            client.evaluate(request).await
        })
    }

    fn terminate(&self, request: &TerminateRequest) -> Result<TerminateReply, CallError> {
        let mut client = self.client.clone();
        let limit = TERMINATE_TIMEOUT.min(self.limits.answer);
        self.runtime
            .block_on(async { within(limit, client.terminate(*request)).await })?
            .map(Response::into_inner)
            .map_err(|status| to_error("Terminate", &status))
    }

    fn list_instances(
        &self,
        request: &ListInstancesRequest,
    ) -> Result<ListInstancesReply, CallError> {
        let reply = self.call("ListInstances", request, async |mut client, request| {
            client.list_instances(request).await
        })?;
        let instances = reply.instances.into_iter();
        Ok(ListInstancesReply {
            instances: instances.map(InstanceState::cleaned).collect(),
        })
    }

    fn exchange(&self, _: &ExchangeRequest, _: &mut ExchangeReply) -> Result<(), CallError> {
        Err(CallError::Unimplemented {
            call: "Exchange as a unary call",
        })
    }
}
