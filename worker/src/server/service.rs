//! The generated service trait on top of [`Contract`].

use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use linchpin_proto::contract::{CallError, Contract, Hold, Owner};
use linchpin_proto::label::Labelled;
use linchpin_proto::status::to_status;
use linchpin_proto::v1::{self, worker_server::Worker};
use tokio::sync::mpsc::{Receiver, Sender};
use tokio_stream::Stream;
use tonic::{Request, Response, Status, Streaming};

use super::connection::Caller;
use super::solvers::{Place, Solvers};
use crate::cancel::{Cancel, Flag};

/// Answers gRPC calls from a contract.
pub(super) struct Service {
    contract: Arc<dyn Contract>,
    solvers: Arc<Solvers>,
}

impl Service {
    pub(super) fn new(contract: Arc<dyn Contract>, solvers: Arc<Solvers>) -> Self {
        Self { contract, solvers }
    }

    /// Answers a call that a solver computes for. If its caller goes away before there is an answer, this is dropped, and the call is
    /// cancelled.
    async fn compute<Q, A>(
        &self,
        request: Request<Q>,
        call: impl FnOnce(&dyn Contract, &Q) -> Result<A, CallError> + Send + 'static,
    ) -> Result<Response<A>, Status>
    where
        Q: Labelled + Send + 'static,
        A: Send + 'static,
    {
        let place = self.solvers.place().await?;
        self.compute_at(place, request, call).await
    }

    async fn compute_at<Q, A>(
        &self,
        place: Place,
        request: Request<Q>,
        call: impl FnOnce(&dyn Contract, &Q) -> Result<A, CallError> + Send + 'static,
    ) -> Result<Response<A>, Status>
    where
        Q: Labelled + Send + 'static,
        A: Send + 'static,
    {
        let (contract, solvers) = (Arc::clone(&self.contract), Arc::clone(&self.solvers));
        let gone = RaisedOnDrop::default();
        let caller = gone.0.clone();
        let answer = tokio::spawn(async move {
            let answered = move || answer(&*contract, &request, call);
            solvers.compute(place, &caller, answered).await
        });
        let answer = answer.await;
        answer.unwrap_or_else(|error| Err(Status::internal(error.to_string())))
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
    answer
        .map(Response::new)
        .map_err(|error| to_status(&error))
}

/// A flag that is raised when whoever waits is gone.
#[derive(Default)]
struct RaisedOnDrop(Flag);

impl Drop for RaisedOnDrop {
    fn drop(&mut self) {
        self.0.raise();
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

type Exchanges = Pin<Box<dyn Stream<Item = Result<v1::ExchangeReply, Status>> + Send>>;

#[tonic::async_trait]
impl Worker for Service {
    async fn describe(
        &self,
        request: Request<v1::DescribeRequest>,
    ) -> Result<Response<v1::DescribeReply>, Status> {
        let place = self.solvers.place_to_describe().await?;
        self.compute_at(place, request, |contract, request| contract.describe(request)).await
    }

    async fn initialize(
        &self,
        request: Request<v1::InitializeRequest>,
    ) -> Result<Response<v1::InitializeReply>, Status> {
        let owner = owner(&request);
        self.compute(request, move |contract, request| match &owner {
            Some(owner) => contract.initialize_for(request, owner),
            None => contract.initialize(request),
        })
        .await
    }

    async fn snapshot(
        &self,
        request: Request<v1::SnapshotRequest>,
    ) -> Result<Response<v1::SnapshotReply>, Status> {
        self.compute(request, |contract, request| contract.snapshot(request)).await
    }

    async fn restore(
        &self,
        request: Request<v1::RestoreRequest>,
    ) -> Result<Response<v1::RestoreReply>, Status> {
        self.compute(request, |contract, request| contract.restore(request)).await
    }

    async fn export_state(
        &self,
        request: Request<v1::ExportStateRequest>,
    ) -> Result<Response<v1::ExportStateReply>, Status> {
        self.compute(request, |contract, request| contract.export_state(request)).await
    }

    async fn import_state(
        &self,
        request: Request<v1::ImportStateRequest>,
    ) -> Result<Response<v1::ImportStateReply>, Status> {
        self.compute(request, |contract, request| contract.import_state(request)).await
    }

    async fn step(
        &self,
        request: Request<v1::StepRequest>,
    ) -> Result<Response<v1::StepReply>, Status> {
        self.compute(request, |contract, request| contract.step(request)).await
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
        self.compute(request, |contract, request| contract.evaluate(request)).await
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
        let turns = Turns {
            contract: Arc::clone(&self.contract),
            solvers: Arc::clone(&self.solvers),
            stream: Hold::stream(),
            owner: owner(&request),
            held: None,
        };
        let (replies, answered) = tokio::sync::mpsc::channel(1);
        let gone = RaisedOnDrop::default();
        // A task of its own: while it computes, the end of the stream can still be seen.
        tokio::spawn(turns.take(request.into_inner(), replies, gone.0.clone()));
        Ok(Response::new(Box::pin(Replies {
            answered,
            _gone: gone,
        })))
    }
}

/// The answers on their way to the caller. Dropped when the stream ends, on either side.
struct Replies {
    answered: Receiver<Result<v1::ExchangeReply, Status>>,
    _gone: RaisedOnDrop,
}

impl Stream for Replies {
    type Item = Result<v1::ExchangeReply, Status>;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Self::Item>> {
        self.answered.poll_recv(context)
    }
}

/// The turns of one exchange stream, which ends when this is dropped.
struct Turns {
    contract: Arc<dyn Contract>,
    solvers: Arc<Solvers>,
    stream: Hold,
    owner: Option<Owner>,
    /// The instance that the stream holds since its last turn.
    held: Option<u64>,
}

impl Turns {
    /// One turn after the other, until `caller` is raised. A request is read when the one before it is answered.
    async fn take(
        mut self,
        mut requests: Streaming<v1::ExchangeRequest>,
        replies: Sender<Result<v1::ExchangeReply, Status>>,
        caller: Flag,
    ) {
        loop {
            let reply = match requests.message().await {
                Ok(Some(request)) => tokio::select! {
                    biased;
                    reply = self.turn(request, &caller) => reply,
                    () = replies.closed() => return,
                },
                Ok(None) => return,
                Err(status) => Err(status),
            };
            let is_last = reply.is_err();
            if replies.send(reply).await.is_err() || is_last {
                return;
            }
        }
    }

    async fn turn(
        &mut self,
        request: v1::ExchangeRequest,
        caller: &Flag,
    ) -> Result<v1::ExchangeReply, Status> {
        check_owner(&*self.contract, request.instance, self.owner.as_ref())?;
        if self.held != Some(request.instance) {
            self.contract.hold(request.instance, &self.stream);
            self.held = Some(request.instance);
        }
        let place = self.solvers.place().await?;
        let contract = Arc::clone(&self.contract);
        let turn = move || exchange(&*contract, &request);
        self.solvers.compute(place, caller, turn).await
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
