//! The unary calls of a worker behind gRPC, as blocking calls.

use std::future::Future;
use std::sync::Arc;
use std::time::{Duration, Instant};

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::label::{Labelled, check_label};
use linchpin_proto::status::to_error;
use linchpin_proto::v1::worker_client::WorkerClient;
use linchpin_proto::v1::*;
use tokio::runtime::Runtime;
use tonic::transport::{Channel, Endpoint};
use tonic::{Response, Status};

use super::time_limits::TimeLimits;
use crate::interrupt::Interrupt;

/// Largest message that is accepted, in bytes.
const MESSAGE_LIMIT: usize = 16 << 20;

/// First pause between two attempts to reach a worker that is starting; doubled up to [`LONGEST_PAUSE`].
const FIRST_PAUSE: Duration = Duration::from_millis(2);
const LONGEST_PAUSE: Duration = Duration::from_millis(100);

/// Longest time for the end of an instance: a worker that hangs must not hold up the end of a run.
const TERMINATE_TIMEOUT: Duration = Duration::from_secs(1);

/// A worker behind gRPC.
pub struct Grpc {
    pub(super) client: WorkerClient<Channel>,
    pub(super) runtime: Arc<Runtime>,
    pub(super) limits: TimeLimits,
    pub(super) interrupt: Interrupt,
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
    pub fn connect(
        address: &str,
        limits: TimeLimits,
        runtime: Arc<Runtime>,
        interrupt: Interrupt,
    ) -> Result<Self, CallError> {
        let channel = open(address, limits, &runtime, &interrupt)?;
        let client = WorkerClient::new(channel)
            .max_decoding_message_size(MESSAGE_LIMIT)
            .max_encoding_message_size(MESSAGE_LIMIT);
        Ok(Self {
            client,
            runtime,
            limits,
            interrupt,
        })
    }

    fn call<Q: Clone + Labelled, A: Labelled, F>(
        &self,
        name: &'static str,
        request: &Q,
        call: impl FnOnce(WorkerClient<Channel>, Q) -> F,
    ) -> Result<A, CallError>
    where
        F: Future<Output = Result<Response<A>, Status>>,
    {
        let answer = call(self.client.clone(), request.clone());
        let answer = unless(&self.interrupt, within(self.limits.answer, answer));
        let answer = self.runtime.block_on(answer)??;
        let reply = answer.map_err(|status| to_error(name, &status))?;
        let reply = reply.into_inner();
        check_label(name, request, &reply)?;
        Ok(reply)
    }
}

/// An open channel to `address`; tries again until the time limit for starts is over.
pub(super) fn open(
    address: &str,
    limits: TimeLimits,
    runtime: &Runtime,
    interrupt: &Interrupt,
) -> Result<Channel, CallError> {
    let unreachable = |reason: String| CallError::Unreachable {
        address: address.into(),
        reason,
    };
    let endpoint = Endpoint::from_shared(address.to_owned())
        .map_err(|error| unreachable(innermost(&error)))?
        .tcp_nodelay(true)
        .connect_timeout(limits.start);
    runtime
        .block_on(unless(interrupt, reach(&endpoint, limits.start)))?
        .map_err(|error| unreachable(innermost(&error)))
}

/// Gives up waiting for `answer` after `limit`.
pub(super) async fn within<T>(
    limit: Duration,
    answer: impl Future<Output = T>,
) -> Result<T, CallError> {
    until(Instant::now() + limit, limit, answer).await
}

/// Gives up waiting for `answer` at `end`, which is `limit` after the request.
pub(super) async fn until<T>(
    end: Instant,
    limit: Duration,
    answer: impl Future<Output = T>,
) -> Result<T, CallError> {
    let late = |_| CallError::Deadline {
        seconds: limit.as_secs_f64(),
    };
    tokio::time::timeout_at(end.into(), answer)
        .await
        .map_err(late)
}

/// Gives up waiting for `answer` after an interrupt.
pub(super) async fn unless<T>(
    interrupt: &Interrupt,
    answer: impl Future<Output = T>,
) -> Result<T, CallError> {
    tokio::select! {
        biased;
        answer = answer => Ok(answer),
        () = interrupt.requested() => Err(CallError::Interrupted),
    }
}

async fn reach(endpoint: &Endpoint, limit: Duration) -> Result<Channel, tonic::transport::Error> {
    let give_up = Instant::now() + limit;
    let mut pause = FIRST_PAUSE;
    loop {
        match endpoint.connect().await {
            Ok(channel) => return Ok(channel),
            Err(error) if Instant::now() + pause >= give_up => return Err(error),
            Err(_) => tokio::time::sleep(pause).await,
        }
        pause = (2 * pause).min(LONGEST_PAUSE);
    }
}

/// What went wrong at the bottom: the transport's own words for the top say only "transport error".
fn innermost(error: &dyn std::error::Error) -> String {
    let mut error = error;
    while let Some(source) = error.source() {
        error = source;
    }
    error.to_string()
}

impl Contract for Grpc {
    fn describe(&self, request: &DescribeRequest) -> Result<DescribeReply, CallError> {
        self.call("Describe", request, async |mut client, request| {
            client.describe(request).await
        })
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
        self.call("ListInstances", request, async |mut client, request| {
            client.list_instances(request).await
        })
    }

    fn exchange(&self, _: &ExchangeRequest, _: &mut ExchangeReply) -> Result<(), CallError> {
        Err(CallError::Unimplemented {
            call: "Exchange as a unary call",
        })
    }
}
