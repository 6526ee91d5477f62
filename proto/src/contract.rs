//! The calls of the contract as a plain trait, so that master and worker can meet in one process.
//!
//! The gRPC service of a worker and the in-process connection of a master both go through [`Contract`]:
//! the same messages, only without a socket.

use std::sync::{Arc, OnceLock};
use std::time::Instant;

use crate::v1::*;

/// One worker as its master sees it: the unary calls of `linchpin.v1.Worker` and one turn of its
/// exchange stream. What each call means stands in `worker.proto`.
pub trait Contract: Send + Sync {
    /// What the worker can simulate.
    fn describe(&self, request: &DescribeRequest) -> Result<DescribeReply, CallError>;
    /// Creates an instance.
    fn initialize(&self, request: &InitializeRequest) -> Result<InitializeReply, CallError>;
    /// Keeps the present state.
    fn snapshot(&self, request: &SnapshotRequest) -> Result<SnapshotReply, CallError>;
    /// Goes back to a kept state.
    fn restore(&self, request: &RestoreRequest) -> Result<RestoreReply, CallError>;
    /// Integrates over one macro step.
    fn step(&self, request: &StepRequest) -> Result<StepReply, CallError>;
    /// Integrates once for every perturbed signal, state untouched.
    fn perturbed_step(
        &self,
        request: &PerturbedStepRequest,
    ) -> Result<PerturbedStepReply, CallError>;
    /// Outputs at zero length.
    fn evaluate(&self, request: &EvaluateRequest) -> Result<EvaluateReply, CallError>;
    /// Ends an instance.
    fn terminate(&self, request: &TerminateRequest) -> Result<TerminateReply, CallError>;
    /// The fused macro step. `reply` is overwritten; its memory is reused.
    fn exchange(
        &self,
        request: &ExchangeRequest,
        reply: &mut ExchangeReply,
    ) -> Result<(), CallError>;
    /// The instances that live there.
    fn list_instances(
        &self,
        _request: &ListInstancesRequest,
    ) -> Result<ListInstancesReply, CallError> {
        Err(CallError::Unimplemented {
            call: "ListInstances",
        })
    }
    /// Says what holds an instance from now on. Servers do; whoever calls without a server holds nothing, and its instances
    /// stay until [`Contract::terminate`].
    fn hold(&self, _instance: u64, _by: &Hold) {}
    /// Ends the instances whose lease is over. Servers call it now and then.
    fn tidy(&self) {}
}

/// What keeps instances alive: a connection, or an exchange stream on one. Copies stand for the same one.
#[derive(Debug, Clone)]
pub struct Hold {
    ended: Arc<OnceLock<Instant>>,
    is_stream: bool,
}

impl Hold {
    /// A connection that has begun.
    pub fn connection() -> Self {
        Self {
            ended: Arc::default(),
            is_stream: false,
        }
    }

    /// An exchange stream that has begun.
    pub fn stream() -> Self {
        Self {
            is_stream: true,
            ..Self::connection()
        }
    }

    /// Whether it is a stream, which takes over from the connections.
    pub fn is_stream(&self) -> bool {
        self.is_stream
    }

    /// Says that it has ended.
    pub fn end(&self) {
        self.ended.get_or_init(Instant::now);
    }

    /// When it ended, if it has.
    pub fn ended(&self) -> Option<Instant> {
        self.ended.get().copied()
    }
}

impl PartialEq for Hold {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.ended, &other.ended)
    }
}

/// Why a call has no answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CallError {
    /// The worker answered that it cannot do it.
    #[error("{}", .0.message)]
    Failed(Failure),
    /// The worker does not offer this call.
    #[error("the worker does not offer {call}")]
    Unimplemented {
        /// Name of the call.
        call: &'static str,
    },
    /// Nobody answers at the address.
    #[error("no worker answers at {address}: {reason}")]
    Unreachable {
        /// Where the worker was expected.
        address: String,
        /// What the transport said.
        reason: String,
    },
    /// The connection ended while an answer was due.
    #[error("the connection to the worker was lost: {reason}")]
    Lost {
        /// What the transport said.
        reason: String,
    },
    /// The reply to another request.
    #[error(
        "the reply to {call} is that of {what} {found}, asked was {what} {expected}: the worker, or something on the way to it, \
         repeats, drops or swaps replies, so that none can be trusted"
    )]
    Misplaced {
        /// Name of the call.
        call: &'static str,
        /// What differs: `sequence number` or `instance`.
        what: &'static str,
        /// That of the reply.
        found: u64,
        /// That of the request.
        expected: u64,
    },
    /// No answer in time.
    #[error("no answer within {seconds} s")]
    Deadline {
        /// The time limit.
        seconds: f64,
    },
}

impl CallError {
    /// Whether the worker says that a smaller step may help.
    pub fn is_recoverable(&self) -> bool {
        matches!(self, Self::Failed(failure) if failure.severity() == Severity::Recoverable)
    }
}

impl Failure {
    /// A wrong request: `field` is what must change.
    pub fn misuse(field: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Misuse.into(),
            message: message.into(),
            field: Some(field.into()),
            ..Self::default()
        }
    }

    /// A failed step that may succeed with a smaller step size.
    pub fn recoverable(t: f64, step: f64, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Recoverable.into(),
            message: message.into(),
            t: Some(t),
            step: Some(step),
            ..Self::default()
        }
    }

    /// A failure after which the instance is of no use.
    pub fn fatal(message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Fatal.into(),
            message: message.into(),
            ..Self::default()
        }
    }
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, more: Self) {
        self.integrations += more.integrations;
        self.steps += more.steps;
        self.nanoseconds += more.nanoseconds;
        self.derivatives += more.derivatives;
        // Counts since the start of the instance: the last ones hold all.
        self.contacts = more.contacts.or(self.contacts);
    }
}

impl From<Failure> for CallError {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}
