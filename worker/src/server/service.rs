//! The generated service trait on top of [`Contract`].

use std::pin::Pin;
use std::sync::Arc;

use linchpin_proto::contract::{CallError, Contract, Hold, Owner};
use linchpin_proto::label::Labelled;
use linchpin_proto::status::to_status;
use linchpin_proto::v1::{self, worker_server::Worker};
use tokio::runtime::{Handle, RuntimeFlavor};
use tokio_stream::{Stream, StreamExt};
use tonic::{Request, Response, Status, Streaming};

use super::connection::Caller;

/// Answers gRPC calls from a contract.
pub(super) struct Service {
    contract: Arc<dyn Contract>,
}

impl Service {
    pub(super) fn new(contract: Arc<dyn Contract>) -> Self {
        Self { contract }
    }

    /// The connection of a call holds the instance that the call names, if that is the caller's.
    fn answer<Q: Labelled, A>(
        &self,
        request: Request<Q>,
        call: impl FnOnce(&dyn Contract, &Q) -> Result<A, CallError>,
    ) -> Result<Response<A>, Status> {
        let instance = request.get_ref().label().instance;
        if let Some(instance) = instance {
            check_owner(&*self.contract, instance, owner(&request).as_ref())?;
        }
        let answer = compute(|| call(&*self.contract, request.get_ref()));
        let answer = answer.map_err(|error| to_status(&error));
        let caller = request.extensions().get::<Caller>();
        if let (Some(instance), Some(caller)) = (instance, caller) {
            // Another one may have made an instance of this number meanwhile.
            check_owner(&*self.contract, instance, caller.owner.as_ref())?;
            self.contract.hold(instance, &caller.hold);
        }
        answer.map(Response::new)
    }
}

/// Who calls, where certificates are shown.
fn owner<Q>(request: &Request<Q>) -> Option<Owner> {
    let caller = request.extensions().get::<Caller>();
    caller.and_then(|caller| caller.owner.clone())
}

/// Refuses calls for instances of others.
fn check_owner(
    contract: &dyn Contract,
    instance: u64,
    caller: Option<&Owner>,
) -> Result<(), Status> {
    match caller {
        Some(caller) if !contract.may_use(instance, caller) => {
            Err(to_status(&CallError::of_another(instance)))
        }
        _ => Ok(()),
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
        match owner(&request) {
            Some(owner) => self.answer(request, |contract, request| {
                contract.initialize_for(request, &owner)
            }),
            None => self.answer(request, |contract, request| contract.initialize(request)),
        }
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

    async fn export_state(
        &self,
        request: Request<v1::ExportStateRequest>,
    ) -> Result<Response<v1::ExportStateReply>, Status> {
        self.answer(request, |contract, request| contract.export_state(request))
    }

    async fn import_state(
        &self,
        request: Request<v1::ImportStateRequest>,
    ) -> Result<Response<v1::ImportStateReply>, Status> {
        self.answer(request, |contract, request| contract.import_state(request))
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

    async fn list_instances(
        &self,
        request: Request<v1::ListInstancesRequest>,
    ) -> Result<Response<v1::ListInstancesReply>, Status> {
        let owner = owner(&request);
        self.answer(request, |contract, request| {
            let mut reply = contract.list_instances(request)?;
            if let Some(owner) = &owner {
                let instances = &mut reply.instances;
                instances.retain(|own| contract.may_use(own.instance, owner));
            }
            Ok(reply)
        })
    }

    type ExchangeStream = Exchanges;

    async fn exchange(
        &self,
        request: Request<Streaming<v1::ExchangeRequest>>,
    ) -> Result<Response<Self::ExchangeStream>, Status> {
        let mut turns = Turns {
            contract: Arc::clone(&self.contract),
            stream: Hold::stream(),
            owner: owner(&request),
            held: None,
        };
        // The inbound stream is mapped straight to the outbound one: a task between them would cost a wake-up.
        let replies = request
            .into_inner()
            .map(move |request| turns.turn(&request?));
        Ok(Response::new(Box::pin(replies)))
    }
}

/// The turns of one exchange stream, which ends when this is dropped.
struct Turns {
    contract: Arc<dyn Contract>,
    stream: Hold,
    owner: Option<Owner>,
    /// The instance that the stream holds since its last turn.
    held: Option<u64>,
}

impl Turns {
    fn turn(&mut self, request: &v1::ExchangeRequest) -> Result<v1::ExchangeReply, Status> {
        check_owner(&*self.contract, request.instance, self.owner.as_ref())?;
        if self.held != Some(request.instance) {
            self.contract.hold(request.instance, &self.stream);
            self.held = Some(request.instance);
        }
        let mut reply = v1::ExchangeReply::default();
        match compute(|| self.contract.exchange(request, &mut reply)) {
            Ok(()) => Ok(reply),
            Err(CallError::Failed(failure)) => Ok(v1::ExchangeReply {
                sequence: request.sequence,
                instance: Some(request.instance),
                failure: Some(failure),
                ..v1::ExchangeReply::default()
            }),
            Err(error) => Err(to_status(&error)),
        }
    }
}

impl Drop for Turns {
    fn drop(&mut self) {
        self.stream.end();
    }
}
