//! A worker whose replies go astray on their way: for tests of what a master believes.

use std::sync::Arc;
use std::sync::mpsc::channel;

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::status::to_status;
use linchpin_proto::v1::{self, worker_server::Worker, worker_server::WorkerServer};
use tokio::net::UnixListener;
use tokio::sync::mpsc::unbounded_channel;
use tokio_stream::StreamExt;
use tokio_stream::wrappers::{UnboundedReceiverStream, UnixListenerStream};
use tonic::{Request, Response, Status, Streaming};

use crate::process::Workshop;

/// What happens to a reply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tamper {
    /// It comes twice.
    Repeat,
    /// It never comes.
    Drop,
    /// In its place comes the one before it.
    Delay,
    /// It is that of another instance.
    OtherInstance,
}

/// Passes calls to a contract, over the exchange stream or as unary calls, and tampers with one reply.
#[derive(Clone)]
pub struct Tampering {
    contract: Arc<dyn Contract>,
    at: u64,
    tamper: Tamper,
}

impl Tampering {
    /// Tampers with the reply to the request with the sequence number `at`.
    pub fn new(contract: Arc<dyn Contract>, at: u64, tamper: Tamper) -> Self {
        Self {
            contract,
            at,
            tamper,
        }
    }

    /// Serves on a Unix socket in the workshop until the test process ends; the address.
    pub fn serve(self, workshop: &Workshop) -> String {
        let path = workshop.path().join("tampering.sock");
        let address = format!("unix:{}", path.display());
        let (listening, is_listening) = channel();
        std::thread::spawn(move || {
            let runtime = tokio::runtime::Builder::new_current_thread()
                .enable_all()
                .build();
            runtime.unwrap().block_on(async move {
                let listener = UnixListener::bind(path).unwrap();
                listening.send(()).unwrap();
                tonic::transport::Server::builder()
                    .add_service(WorkerServer::new(self))
                    .serve_with_incoming(UnixListenerStream::new(listener))
                    .await
                    .unwrap();
            });
        });
        is_listening.recv().unwrap();
        address
    }

    /// The replies that arrive in place of `reply`; `last` is the one before it.
    fn arriving(
        &self,
        reply: v1::ExchangeReply,
        last: &v1::ExchangeReply,
    ) -> Vec<v1::ExchangeReply> {
        if reply.sequence != self.at {
            return vec![reply];
        }
        match self.tamper {
            Tamper::Repeat => vec![reply.clone(), reply],
            Tamper::Drop => Vec::new(),
            Tamper::Delay => vec![last.clone()],
            Tamper::OtherInstance => vec![v1::ExchangeReply {
                instance: reply.instance.map(|own| own ^ 1),
                ..reply
            }],
        }
    }

    fn exchange_one(&self, request: &v1::ExchangeRequest) -> Result<v1::ExchangeReply, Status> {
        let mut reply = v1::ExchangeReply::default();
        let answer = self.contract.exchange(request, &mut reply);
        answer.map_err(|error| to_status(&error)).map(|()| reply)
    }
}

/// A unary call that is passed on.
fn passed<Q, A>(
    request: &Request<Q>,
    call: impl FnOnce(&Q) -> Result<A, CallError>,
) -> Result<Response<A>, Status> {
    let answer = call(request.get_ref());
    answer.map(Response::new).map_err(|error| to_status(&error))
}

#[tonic::async_trait]
impl Worker for Tampering {
    async fn describe(
        &self,
        request: Request<v1::DescribeRequest>,
    ) -> Result<Response<v1::DescribeReply>, Status> {
        passed(&request, |request| self.contract.describe(request))
    }

    async fn initialize(
        &self,
        request: Request<v1::InitializeRequest>,
    ) -> Result<Response<v1::InitializeReply>, Status> {
        passed(&request, |request| self.contract.initialize(request))
    }

    async fn snapshot(
        &self,
        request: Request<v1::SnapshotRequest>,
    ) -> Result<Response<v1::SnapshotReply>, Status> {
        passed(&request, |request| self.contract.snapshot(request))
    }

    async fn restore(
        &self,
        request: Request<v1::RestoreRequest>,
    ) -> Result<Response<v1::RestoreReply>, Status> {
        passed(&request, |request| self.contract.restore(request))
    }

    async fn export_state(
        &self,
        request: Request<v1::ExportStateRequest>,
    ) -> Result<Response<v1::ExportStateReply>, Status> {
        passed(&request, |request| self.contract.export_state(request))
    }

    async fn import_state(
        &self,
        request: Request<v1::ImportStateRequest>,
    ) -> Result<Response<v1::ImportStateReply>, Status> {
        passed(&request, |request| self.contract.import_state(request))
    }

    async fn perturbed_step(
        &self,
        request: Request<v1::PerturbedStepRequest>,
    ) -> Result<Response<v1::PerturbedStepReply>, Status> {
        passed(&request, |request| self.contract.perturbed_step(request))
    }

    async fn evaluate(
        &self,
        request: Request<v1::EvaluateRequest>,
    ) -> Result<Response<v1::EvaluateReply>, Status> {
        passed(&request, |request| self.contract.evaluate(request))
    }

    async fn terminate(
        &self,
        request: Request<v1::TerminateRequest>,
    ) -> Result<Response<v1::TerminateReply>, Status> {
        passed(&request, |request| self.contract.terminate(request))
    }

    async fn list_instances(
        &self,
        request: Request<v1::ListInstancesRequest>,
    ) -> Result<Response<v1::ListInstancesReply>, Status> {
        passed(&request, |request| self.contract.list_instances(request))
    }

    /// Its reply says that it is that of another call, or of another instance.
    async fn step(
        &self,
        request: Request<v1::StepRequest>,
    ) -> Result<Response<v1::StepReply>, Status> {
        let request = request.get_ref();
        let mut reply = self
            .contract
            .step(request)
            .map_err(|error| to_status(&error))?;
        if request.sequence >= self.at {
            match self.tamper {
                Tamper::Delay | Tamper::Repeat => reply.sequence = Some(request.sequence - 1),
                Tamper::OtherInstance => reply.instance = Some(request.instance ^ 1),
                Tamper::Drop => std::future::pending().await,
            }
        }
        Ok(Response::new(reply))
    }

    type ExchangeStream = UnboundedReceiverStream<Result<v1::ExchangeReply, Status>>;

    async fn exchange(
        &self,
        request: Request<Streaming<v1::ExchangeRequest>>,
    ) -> Result<Response<Self::ExchangeStream>, Status> {
        let (replies, receiver) = unbounded_channel();
        let worker = self.clone();
        tokio::spawn(async move {
            let mut requests = request.into_inner();
            let mut last = v1::ExchangeReply::default();
            while let Some(Ok(request)) = requests.next().await {
                let arriving = match worker.exchange_one(&request) {
                    Ok(reply) => {
                        let arriving = worker.arriving(reply.clone(), &last);
                        last = reply;
                        arriving.into_iter().map(Ok).collect()
                    }
                    Err(status) => vec![Err(status)],
                };
                for reply in arriving {
                    // A master that has seen enough is gone.
                    let _ = replies.send(reply);
                }
            }
        });
        Ok(Response::new(UnboundedReceiverStream::new(receiver)))
    }
}
