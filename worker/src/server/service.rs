//! The generated service trait on top of [`Contract`].

use std::pin::Pin;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use linchpin_proto::contract::{CallError, Contract, Hold, Owner};
use linchpin_proto::label::Labelled;
use linchpin_proto::status::to_status;
use linchpin_proto::v1::{self, worker_server::Worker};
use tokio_stream::{Stream, StreamExt};
use tonic::{Request, Response, Status, Streaming};

use super::connection::Caller;
use super::solvers::{Place, Solvers};
use crate::cancel::{Cancel, Flag};
use crate::span::Span;

/// Answers gRPC calls from a contract.
pub(super) struct Service {
    contract: Arc<dyn Contract>,
    solvers: Arc<Solvers>,
}

impl Service {
    pub(super) fn new(contract: Arc<dyn Contract>, solvers: Arc<Solvers>) -> Self {
        Self { contract, solvers }
    }

    /// Answers a call for an instance, which may be short.
    async fn compute<Q, A>(
        &self,
        request: Request<Q>,
        call: impl FnOnce(&dyn Contract, &Q) -> Result<A, CallError> + Send + 'static,
    ) -> Result<Response<A>, Status>
    where
        Q: Labelled + Span + Send + 'static,
        A: Send + 'static,
    {
        let instance = request.get_ref().label().instance.unwrap_or_default();
        let span = request.get_ref().span();
        let is_short = self.contract.is_short(instance, span);
        let place = self.solvers.place().await?;
        if !is_short {
            return self.compute_apart(place, request, call).await;
        }
        let connection = connection(&request);
        let contract = Arc::clone(&self.contract);
        let answered = move || answer(&*contract, &request, call);
        self.solvers.compute(place, &connection, answered).await
    }

    /// Answers a call that may take long.
    async fn compute_apart<Q, A>(
        &self,
        place: Place,
        request: Request<Q>,
        call: impl FnOnce(&dyn Contract, &Q) -> Result<A, CallError> + Send + 'static,
    ) -> Result<Response<A>, Status>
    where
        Q: Labelled + Send + 'static,
        A: Send + 'static,
    {
        let contract = Arc::clone(&self.contract);
        let answered = move || answer(&*contract, &request, call);
        Arc::clone(&self.solvers)
            .compute_apart(place, answered)
            .await
    }
}

/// Answers a call. Its connection holds the instance that it names, if that is the caller's.
fn answer<Q: Labelled, A>(
    contract: &dyn Contract,
    request: &Request<Q>,
    call: impl FnOnce(&dyn Contract, &Q) -> Result<A, CallError>,
) -> Result<Response<A>, Status> {
    let instance = request.get_ref().label().instance;
    let caller = request.extensions().get::<Caller>();
    let owner = caller.and_then(|caller| caller.owner.as_ref());
    if let Some(instance) = instance {
        check_owner(contract, instance, owner)?;
    }
    let answer = call(contract, request.get_ref());
    if let (Some(instance), Some(caller)) = (instance, caller) {
        // Another one may have made an instance of this number meanwhile.
        check_owner(contract, instance, owner)?;
        contract.hold(instance, &caller.hold);
    }
    answer.map(Response::new).map_err(|error| to_status(&error))
}

/// Who calls, where certificates are shown.
fn owner<Q>(request: &Request<Q>) -> Option<Owner> {
    let caller = request.extensions().get::<Caller>();
    caller.and_then(|caller| caller.owner.clone())
}

/// What is raised when the connection of a call is gone.
fn connection<Q>(request: &Request<Q>) -> Flag {
    let caller = request.extensions().get::<Caller>();
    caller.map(|caller| caller.gone.clone()).unwrap_or_default()
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

type Exchanges = Pin<Box<dyn Stream<Item = Result<v1::ExchangeReply, Status>> + Send>>;

#[tonic::async_trait]
impl Worker for Service {
    async fn describe(
        &self,
        request: Request<v1::DescribeRequest>,
    ) -> Result<Response<v1::DescribeReply>, Status> {
        let contract = Arc::clone(&self.contract);
        let described = move || {
            answer(&*contract, &request, |contract, request| {
                contract.describe(request)
            })
        };
        self.solvers.describe(described).await
    }

    async fn initialize(
        &self,
        request: Request<v1::InitializeRequest>,
    ) -> Result<Response<v1::InitializeReply>, Status> {
        let owner = owner(&request);
        let place = self.solvers.place().await?;
        self.compute_apart(place, request, move |contract, request| match &owner {
            Some(owner) => contract.initialize_for(request, owner),
            None => contract.initialize(request),
        })
        .await
    }

    async fn snapshot(
        &self,
        request: Request<v1::SnapshotRequest>,
    ) -> Result<Response<v1::SnapshotReply>, Status> {
        self.compute(request, |contract, request| contract.snapshot(request))
            .await
    }

    async fn restore(
        &self,
        request: Request<v1::RestoreRequest>,
    ) -> Result<Response<v1::RestoreReply>, Status> {
        self.compute(request, |contract, request| contract.restore(request))
            .await
    }

    async fn export_state(
        &self,
        request: Request<v1::ExportStateRequest>,
    ) -> Result<Response<v1::ExportStateReply>, Status> {
        self.compute(request, |contract, request| contract.export_state(request))
            .await
    }

    async fn import_state(
        &self,
        request: Request<v1::ImportStateRequest>,
    ) -> Result<Response<v1::ImportStateReply>, Status> {
        self.compute(request, |contract, request| contract.import_state(request))
            .await
    }

    async fn step(
        &self,
        request: Request<v1::StepRequest>,
    ) -> Result<Response<v1::StepReply>, Status> {
        self.compute(request, |contract, request| contract.step(request))
            .await
    }

    async fn perturbed_step(
        &self,
        request: Request<v1::PerturbedStepRequest>,
    ) -> Result<Response<v1::PerturbedStepReply>, Status> {
        self.compute(request, |contract, request| {
            contract.perturbed_step(request)
        })
        .await
    }

    async fn evaluate(
        &self,
        request: Request<v1::EvaluateRequest>,
    ) -> Result<Response<v1::EvaluateReply>, Status> {
        self.compute(request, |contract, request| contract.evaluate(request))
            .await
    }

    async fn terminate(
        &self,
        request: Request<v1::TerminateRequest>,
    ) -> Result<Response<v1::TerminateReply>, Status> {
        answer(&*self.contract, &request, |contract, request| {
            contract.terminate(request)
        })
    }

    async fn list_instances(
        &self,
        request: Request<v1::ListInstancesRequest>,
    ) -> Result<Response<v1::ListInstancesReply>, Status> {
        let owner = owner(&request);
        answer(&*self.contract, &request, |contract, request| {
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
        let turns = Arc::new(Turns {
            contract: Arc::clone(&self.contract),
            solvers: Arc::clone(&self.solvers),
            stream: Hold::stream(),
            owner: owner(&request),
            connection: connection(&request),
            held: Mutex::default(),
        });
        let requests = request.into_inner();
        let replies = requests.then(move |request| Arc::clone(&turns).turn(request));
        Ok(Response::new(Box::pin(replies)))
    }
}

/// The turns of one exchange stream, which ends when this is dropped.
struct Turns {
    contract: Arc<dyn Contract>,
    solvers: Arc<Solvers>,
    stream: Hold,
    owner: Option<Owner>,
    connection: Flag,
    /// The instance that the stream holds since its last turn.
    held: Mutex<Option<u64>>,
}

impl Turns {
    async fn turn(
        self: Arc<Self>,
        request: Result<v1::ExchangeRequest, Status>,
    ) -> Result<v1::ExchangeReply, Status> {
        let request = request?;
        let instance = request.instance;
        check_owner(&*self.contract, instance, self.owner.as_ref())?;
        let before = self.held().replace(instance);
        if before != Some(instance) {
            self.contract.hold(instance, &self.stream);
        }
        let is_short = self.contract.is_short(instance, request.span());
        let contract = Arc::clone(&self.contract);
        let turn = move || exchange(&*contract, &request);
        let place = self.solvers.place().await?;
        match is_short {
            true => self.solvers.compute(place, &self.connection, turn).await,
            false => Arc::clone(&self.solvers).compute_apart(place, turn).await,
        }
    }

    fn held(&self) -> MutexGuard<'_, Option<u64>> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn exchange(
    contract: &dyn Contract,
    request: &v1::ExchangeRequest,
) -> Result<v1::ExchangeReply, Status> {
    let mut reply = v1::ExchangeReply::default();
    match contract.exchange(request, &mut reply) {
        Ok(()) => Ok(reply),
        Err(CallError::Failed(_)) if Cancel::current().is_requested() => {
            Err(Status::cancelled("the exchange was cancelled"))
        }
        Err(CallError::Failed(failure)) => Ok(v1::ExchangeReply {
            sequence: request.sequence,
            instance: Some(request.instance),
            failure: Some(failure),
            ..v1::ExchangeReply::default()
        }),
        Err(error) => Err(to_status(&error)),
    }
}

impl Drop for Turns {
    fn drop(&mut self) {
        self.stream.end();
    }
}
