//! The same messages on open tonic streams, answered by a constant.

use std::pin::Pin;
use std::sync::Arc;

use linchpin_proto::v1::worker_client::WorkerClient;
use linchpin_proto::v1::worker_server::{Worker, WorkerServer};
use linchpin_proto::v1::*;
use prost::Message;
use tokio::net::{TcpListener, UnixListener};
use tokio::runtime::Runtime;
use tokio::sync::mpsc::{UnboundedSender, unbounded_channel};
use tokio_stream::wrappers::{UnboundedReceiverStream, UnixListenerStream};
use tokio_stream::{Stream, StreamExt};
use tonic::transport::{Endpoint, server::TcpIncoming};
use tonic::{Request, Response, Status, Streaming};

use crate::macro_steps::{Messages, free_port};
use crate::process::Process;
use crate::report::Series;

struct Constant(ExchangeReply);

type Replies = Pin<Box<dyn Stream<Item = Result<ExchangeReply, Status>> + Send>>;

fn not_offered<T>() -> Result<Response<T>, Status> {
    Err(Status::unimplemented("this server only exchanges"))
}

#[tonic::async_trait]
impl Worker for Constant {
    async fn describe(
        &self,
        _: Request<DescribeRequest>,
    ) -> Result<Response<DescribeReply>, Status> {
        not_offered()
    }

    async fn initialize(
        &self,
        _: Request<InitializeRequest>,
    ) -> Result<Response<InitializeReply>, Status> {
        not_offered()
    }

    async fn snapshot(
        &self,
        _: Request<SnapshotRequest>,
    ) -> Result<Response<SnapshotReply>, Status> {
        not_offered()
    }

    async fn restore(&self, _: Request<RestoreRequest>) -> Result<Response<RestoreReply>, Status> {
        not_offered()
    }

    async fn export_state(
        &self,
        _: Request<ExportStateRequest>,
    ) -> Result<Response<ExportStateReply>, Status> {
        not_offered()
    }

    async fn import_state(
        &self,
        _: Request<ImportStateRequest>,
    ) -> Result<Response<ImportStateReply>, Status> {
        not_offered()
    }

    async fn step(&self, _: Request<StepRequest>) -> Result<Response<StepReply>, Status> {
        not_offered()
    }

    async fn perturbed_step(
        &self,
        _: Request<PerturbedStepRequest>,
    ) -> Result<Response<PerturbedStepReply>, Status> {
        not_offered()
    }

    async fn evaluate(
        &self,
        _: Request<EvaluateRequest>,
    ) -> Result<Response<EvaluateReply>, Status> {
        not_offered()
    }

    async fn terminate(
        &self,
        _: Request<TerminateRequest>,
    ) -> Result<Response<TerminateReply>, Status> {
        not_offered()
    }

    async fn list_instances(
        &self,
        _: Request<ListInstancesRequest>,
    ) -> Result<Response<ListInstancesReply>, Status> {
        not_offered()
    }

    type ExchangeStream = Replies;

    async fn exchange(
        &self,
        requests: Request<Streaming<ExchangeRequest>>,
    ) -> Result<Response<Replies>, Status> {
        let reply = self.0.clone();
        let replies = requests
            .into_inner()
            .map(move |request| request.map(|_| reply.clone()));
        Ok(Response::new(Box::pin(replies)))
    }
}

/// Serves at `unix:/PATH` or `IP:PORT`; `reply` is the message in hexadecimal digits.
pub fn serve(address: &str, reply: &str) {
    let bytes: Vec<u8> = (0..reply.len())
        .step_by(2)
        .map(|place| u8::from_str_radix(&reply[place..place + 2], 16).unwrap())
        .collect();
    let service = WorkerServer::new(Constant(ExchangeReply::decode(bytes.as_slice()).unwrap()));
    let router = tonic::transport::Server::builder().add_service(service);
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .unwrap();
    runtime.block_on(async {
        match address.strip_prefix("unix:") {
            Some(path) => {
                let incoming = UnixListenerStream::new(UnixListener::bind(path).unwrap());
                router.serve_with_incoming(incoming).await.unwrap();
            }
            None => {
                let listener = TcpListener::bind(address).await.unwrap();
                let incoming = TcpIncoming::from(listener).with_nodelay(Some(true));
                router.serve_with_incoming(incoming).await.unwrap();
            }
        }
    });
}

struct Peer {
    _process: Process,
    requests: UnboundedSender<ExchangeRequest>,
    replies: Streaming<ExchangeReply>,
}

impl Peer {
    fn start(listen: &str, address: &str, messages: &Messages, runtime: &Runtime) -> Self {
        let digits: String = messages
            .reply_bytes()
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect();
        let process = Process::start(&["bare-stream", listen, &digits]);
        let endpoint = Endpoint::from_shared(address.to_owned())
            .unwrap()
            .tcp_nodelay(true);
        let (requests, outgoing) = unbounded_channel();
        let replies = runtime.block_on(async {
            let channel = loop {
                match endpoint.connect().await {
                    Ok(channel) => break channel,
                    Err(_) => tokio::time::sleep(std::time::Duration::from_millis(5)).await,
                }
            };
            let stream = UnboundedReceiverStream::new(outgoing);
            WorkerClient::new(channel)
                .exchange(stream)
                .await
                .unwrap()
                .into_inner()
        });
        Self {
            _process: process,
            requests,
            replies,
        }
    }
}

fn series(name: &'static str, places: [(String, String); 2], messages: &Messages) -> Series {
    let runtime = Arc::new(
        tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()
            .unwrap(),
    );
    let mut peers =
        places.map(|(listen, address)| Peer::start(&listen, &address, messages, &runtime));
    let request = messages.request.clone();
    Series::new(name, move || {
        for peer in &peers {
            peer.requests.send(request.clone()).unwrap();
        }
        for peer in &mut peers {
            runtime.block_on(peer.replies.message()).unwrap().unwrap();
        }
    })
}

/// Bare rounds over Unix sockets, which are the reference, and over TCP.
pub fn all(messages: &Messages) -> Vec<Series> {
    let folder = tempfile::tempdir().unwrap();
    let unix = [1, 2].map(|number| {
        let address = format!("unix:{}/bare{number}.sock", folder.path().display());
        (address.clone(), address)
    });
    let tcp = [free_port(), free_port()].map(|port| {
        (
            format!("127.0.0.1:{port}"),
            format!("http://127.0.0.1:{port}"),
        )
    });
    vec![
        series(
            "bare round to 2, tonic streams, Unix sockets",
            unix,
            messages,
        )
        .reference(),
        series("bare round to 2, tonic streams, TCP", tcp, messages),
    ]
}
