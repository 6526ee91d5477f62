//! Ends of a wait.

use std::future::Future;
use std::time::{Duration, Instant};

use linchpin_proto::contract::CallError;

use crate::interrupt::Interrupt;

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
        alive: None,
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
