//! The exchange stream of a worker behind gRPC.

use std::future::{Future, poll_fn};
use std::pin::{Pin, pin};
use std::task::Poll;
use std::time::{Duration, Instant};

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::label::{Label, Labelled, check_label};
use linchpin_proto::status::to_error;
use linchpin_proto::v1::{ExchangeReply, ExchangeRequest};
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};
use tokio::task::JoinHandle;
use tokio_stream::wrappers::UnboundedReceiverStream;
use tonic::{Response, Status, Streaming};

use super::Grpc;
use super::waiting::{unless, until};
use super::worker::Connection;

/// One bidirectional stream for the whole run.
pub struct ExchangeStream {
    grpc: Grpc,
    requests: Option<UnboundedSender<ExchangeRequest>>,
    /// The request whose answer is due.
    posted: Posted,
    /// When it was sent: the time limit counts from there, so that many late workers are waited for at once.
    posted_at: Instant,
    replies: Replies,
    polling: Duration,
}

/// The numbers of a request.
#[derive(Default)]
struct Posted(Label);

impl Labelled for Posted {
    fn label(&self) -> Label {
        self.0
    }
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
            posted: Posted::default(),
            posted_at: Instant::now(),
            replies: Replies::Unopened(receiver),
            polling: Duration::ZERO,
        }
    }

    /// Polls for so long for an answer before it sleeps. Waking a sleeping core takes longer than many an answer, so this
    /// pays where a core is free; where workers wait for one it does harm.
    pub fn polling(mut self, polling: Duration) -> Self {
        self.polling = polling;
        self
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
        self.posted = Posted(request.label());
        self.posted_at = Instant::now();
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
        let replies = std::mem::replace(&mut self.replies, Replies::Broken);
        let answer = self.grpc.runtime.block_on(self.wait(next(replies)))?;
        let (answer, replies) = answer?;
        // A reply that belongs elsewhere leaves the stream broken: those behind it may belong anywhere.
        check_label("Exchange", &self.posted, &answer)?;
        self.replies = Replies::Open(replies);
        *reply = answer;
        match reply.failure.take() {
            Some(failure) => Err(CallError::Failed(failure.cleaned())),
            None => Ok(()),
        }
    }

    fn route(&self) -> &'static str {
        "exchange stream"
    }
}

impl ExchangeStream {
    /// Polls for a while, then sleeps until the answer, the deadline or an interrupt.
    async fn wait<T>(&self, answer: impl Future<Output = T>) -> Result<T, CallError> {
        let mut answer = pin!(answer);
        if let Some(answer) = poll_for(self.polling, answer.as_mut()).await {
            return Ok(answer);
        }
        let limit = self.grpc.limits.answer;
        let end = self.posted_at + limit;
        let answer = unless(&self.grpc.interrupt, until(end, limit, answer)).await?;
        self.grpc.with_sign_of_life(answer).await
    }
}

/// The answer, if it comes within `time`; the other tasks of the runtime go on meanwhile.
async fn poll_for<T>(time: Duration, mut answer: Pin<&mut impl Future<Output = T>>) -> Option<T> {
    if time.is_zero() {
        return None;
    }
    let started = Instant::now();
    while started.elapsed() < time {
        let polled = poll_fn(|context| Poll::Ready(answer.as_mut().poll(context))).await;
        if let Poll::Ready(answer) = polled {
            return Some(answer);
        }
        tokio::task::yield_now().await;
    }
    None
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
