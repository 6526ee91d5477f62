//! The generated service trait on top of [`Contract`].

use std::pin::Pin;
use std::sync::Arc;

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::status::to_status;
use linchpin_proto::v1::{self, worker_server::Worker};
use tokio::runtime::{Handle, RuntimeFlavor};
use tokio_stream::{Stream, StreamExt};
use tonic::{Request, Response, Status, Streaming};

/// Answers gRPC calls from a contract.
pub(super) struct Service {
    contract: Arc<dyn Contract>,
}

impl Service {
    pub(super) fn new(contract: Arc<dyn Contract>) -> Self {
        Self { contract }
    }

    fn answer<Q, A>(
        &self,
        request: Request<Q>,
        call: impl FnOnce(&dyn Contract, &Q) -> Result<A, CallError>,
    ) -> Result<Response<A>, Status> {
        compute(|| call(&*self.contract, request.get_ref()))
            .map(Response::new)
            .map_err(|error| to_status(&error))
    }
}

/// Runs a solver call. On a runtime with several threads the others take over the rest, so that health is still
/// answered during a long step.
fn compute<T>(call: impl FnOnce() -> T) -> T {
    match Handle::current().runtime_flavor() {
        RuntimeFlavor::MultiThread => tokio::task::block_in_place(call),
        _ => call(),
    }
}

type Exchanges = Pin<Box<dyn Stream<Item = Result<v1::ExchangeReply, Status>> + Send>>;

#[tonic::async_trait]
impl Worker for Service {
    async fn describe(
        &self,
        request: Request<v1::DescribeRequest>,
    ) -> Result<Response<v1::DescribeReply>, Status> {
        self.answer(request, |contract, request| contract.describe(request))
    }

    async fn initialize(
        &self,
        request: Request<v1::InitializeRequest>,
    ) -> Result<Response<v1::InitializeReply>, Status> {
        self.answer(request, |contract, request| contract.initialize(request))
    }

    async fn snapshot(
        &self,
        request: Request<v1::SnapshotRequest>,
    ) -> Result<Response<v1::SnapshotReply>, Status> {
        self.answer(request, |contract, request| contract.snapshot(request))
    }

    async fn restore(
        &self,
        request: Request<v1::RestoreRequest>,
    ) -> Result<Response<v1::RestoreReply>, Status> {
        self.answer(request, |contract, request| contract.restore(request))
    }

    async fn step(
        &self,
        request: Request<v1::StepRequest>,
    ) -> Result<Response<v1::StepReply>, Status> {
        self.answer(request, |contract, request| contract.step(request))
    }

    async fn perturbed_step(
        &self,
        request: Request<v1::PerturbedStepRequest>,
    ) -> Result<Response<v1::PerturbedStepReply>, Status> {
        self.answer(request, |contract, request| {
            contract.perturbed_step(request)
        })
    }

    async fn evaluate(
        &self,
        request: Request<v1::EvaluateRequest>,
    ) -> Result<Response<v1::EvaluateReply>, Status> {
        self.answer(request, |contract, request| contract.evaluate(request))
    }

    async fn terminate(
        &self,
        request: Request<v1::TerminateRequest>,
    ) -> Result<Response<v1::TerminateReply>, Status> {
        self.answer(request, |contract, request| contract.terminate(request))
    }

    type ExchangeStream = Exchanges;

    async fn exchange(
        &self,
        request: Request<Streaming<v1::ExchangeRequest>>,
    ) -> Result<Response<Self::ExchangeStream>, Status> {
        let contract = Arc::clone(&self.contract);
        // The inbound stream is mapped straight to the outbound one: a task between them would cost a wake-up.
        let replies = request
            .into_inner()
            .map(move |request| one_turn(&*contract, &request?));
        Ok(Response::new(Box::pin(replies)))
    }
}

fn one_turn(
    contract: &dyn Contract,
    request: &v1::ExchangeRequest,
) -> Result<v1::ExchangeReply, Status> {
    let mut reply = v1::ExchangeReply::default();
    match compute(|| contract.exchange(request, &mut reply)) {
        Ok(()) => Ok(reply),
        Err(CallError::Failed(failure)) => Ok(v1::ExchangeReply {
            sequence: request.sequence,
            failure: Some(failure),
            ..v1::ExchangeReply::default()
        }),
        Err(error) => Err(to_status(&error)),
    }
}
