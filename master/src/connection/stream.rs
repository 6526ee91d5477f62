//! The exchange stream of a worker behind gRPC.

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::status::to_error;
use linchpin_proto::v1::{ExchangeReply, ExchangeRequest};
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};
use tokio::task::JoinHandle;
use tokio_stream::wrappers::UnboundedReceiverStream;
use tonic::{Response, Status, Streaming};

use super::grpc::{unless, within};
use super::{Connection, Grpc};

/// One bidirectional stream for the whole run.
pub struct ExchangeStream {
    grpc: Grpc,
    requests: Option<UnboundedSender<ExchangeRequest>>,
    replies: Replies,
}

enum Replies {
    Unopened(UnboundedReceiver<ExchangeRequest>),
    Opening(JoinHandle<Result<Response<Streaming<ExchangeReply>>, Status>>),
    Open(Box<Streaming<ExchangeReply>>),
    Broken,
}

impl ExchangeStream {
    /// The stream is opened with the first request: some servers answer its opening only together with that.
    pub fn new(grpc: Grpc) -> Self {
        let (requests, receiver) = unbounded_channel();
        Self {
            grpc,
            requests: Some(requests),
            replies: Replies::Unopened(receiver),
        }
    }
}

fn lost(reason: impl Into<String>) -> CallError {
    CallError::Lost {
        reason: reason.into(),
    }
}

impl Connection for ExchangeStream {
    fn contract(&self) -> &dyn Contract {
        &self.grpc
    }

    fn post(&mut self, request: &ExchangeRequest) -> Result<(), CallError> {
        let requests = self
            .requests
            .as_ref()
            .ok_or_else(|| lost("the stream is closed"))?;
        requests
            .send(request.clone())
            .map_err(|_| lost("the worker closed the exchange stream"))?;
        self.replies = match std::mem::replace(&mut self.replies, Replies::Broken) {
            Replies::Unopened(receiver) => {
                let mut client = self.grpc.client.clone();
                let opening = async move {
                    client
                        .exchange(UnboundedReceiverStream::new(receiver))
                        .await
                };
                Replies::Opening(self.grpc.runtime.spawn(opening))
            }
            other => other,
        };
        Ok(())
    }

    fn collect(&mut self, reply: &mut ExchangeReply) -> Result<(), CallError> {
        let limit = self.grpc.limits.answer;
        let replies = std::mem::replace(&mut self.replies, Replies::Broken);
        let answer = unless(&self.grpc.interrupt, within(limit, next(replies)));
        let (answer, replies) = self.grpc.runtime.block_on(answer)???;
        self.replies = Replies::Open(replies);
        *reply = answer;
        match reply.failure.take() {
            Some(failure) => Err(CallError::Failed(failure)),
            None => Ok(()),
        }
    }

    fn route(&self) -> &'static str {
        "exchange stream"
    }
}

async fn next(
    replies: Replies,
) -> Result<(ExchangeReply, Box<Streaming<ExchangeReply>>), CallError> {
    let failed = |status: Status| to_error("Exchange", &status);
    let mut replies = match replies {
        Replies::Open(replies) => replies,
        Replies::Opening(opening) => {
            let opened = opening.await.map_err(|error| lost(error.to_string()))?;
            Box::new(opened.map_err(failed)?.into_inner())
        }
        Replies::Unopened(_) | Replies::Broken => return Err(lost("nothing was sent")),
    };
    match replies.message().await.map_err(failed)? {
        Some(reply) => Ok((reply, replies)),
        None => Err(lost("the worker ended the exchange stream")),
    }
}
