//! A worker on a thread of its own.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{ExchangeReply, ExchangeRequest};

use super::worker::Connection;

type Answer = (ExchangeReply, Result<(), CallError>);

/// Runs the exchanges of a contract on a thread, so that several workers compute at the same time.
pub struct Threaded {
    contract: Arc<dyn Contract>,
    requests: Option<SyncSender<(ExchangeRequest, ExchangeReply)>>,
    answers: Receiver<Answer>,
    spare: ExchangeReply,
    thread: Option<JoinHandle<()>>,
    route: &'static str,
}

impl Threaded {
    /// Starts the thread. `route` is told in the summary.
    pub fn new(contract: Arc<dyn Contract>, route: &'static str) -> Self {
        let (requests, inbox) = sync_channel::<(ExchangeRequest, ExchangeReply)>(1);
        let (outbox, answers) = sync_channel(1);
        let served = Arc::clone(&contract);
        let thread = std::thread::spawn(move || {
            for (request, mut reply) in inbox {
                let result = served.exchange(&request, &mut reply);
                if outbox.send((reply, result)).is_err() {
                    return;
                }
            }
        });
        Self {
            contract,
            requests: Some(requests),
            answers,
            spare: ExchangeReply::default(),
            thread: Some(thread),
            route,
        }
    }
}

fn gone() -> CallError {
    CallError::Lost {
        reason: "the thread of the worker ended".into(),
    }
}

impl Connection for Threaded {
    fn contract(&self) -> &dyn Contract {
        &*self.contract
    }

    fn post(&mut self, request: &ExchangeRequest) -> Result<(), CallError> {
        let requests = self.requests.as_ref().ok_or_else(gone)?;
        let spare = std::mem::take(&mut self.spare);
        requests.send((request.clone(), spare)).map_err(|_| gone())
    }

    fn collect(&mut self, reply: &mut ExchangeReply) -> Result<(), CallError> {
        let (answer, result) = self.answers.recv().map_err(|_| gone())?;
        self.spare = std::mem::replace(reply, answer);
        result
    }

    fn route(&self) -> &'static str {
        self.route
    }
}

impl Drop for Threaded {
    fn drop(&mut self) {
        self.requests = None;
        if let Some(thread) = self.thread.take() {
            // A panic of the worker was already reported as a lost connection.
            let _ = thread.join();
        }
    }
}
