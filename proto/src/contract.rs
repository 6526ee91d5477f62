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
    /// Creates an instance that belongs to `owner`. Servers that know who calls create instances so.
    fn initialize_for(
        &self,
        request: &InitializeRequest,
        _owner: &Owner,
    ) -> Result<InitializeReply, CallError> {
        self.initialize(request)
    }
    /// Whether `caller` may use an instance: nobody but its owner. Servers that know who calls ask before every call.
    fn may_use(&self, _instance: u64, _caller: &Owner) -> bool {
        true
    }
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
    /// The committed state as bytes.
    fn export_state(&self, _request: &ExportStateRequest) -> Result<ExportStateReply, CallError> {
        Err(CallError::Unimplemented {
            call: "ExportState",
        })
    }
    /// Makes an exported state the committed one.
    fn import_state(&self, _request: &ImportStateRequest) -> Result<ImportStateReply, CallError> {
        Err(CallError::Unimplemented {
            call: "ImportState",
        })
    }
    /// The instances that live there.
    fn list_instances(
        &self,
        _request: &ListInstancesRequest,
    ) -> Result<ListInstancesReply, CallError> {
        Err(CallError::Unimplemented {
            call: "ListInstances",
        })
    }
    /// Whether a call that simulates `span` (s) with an instance presumably takes no longer than a millisecond, to judge by the calls
    /// before. A server then spares itself what it does for calls that may take long.
    fn is_short(&self, _instance: u64, _span: f64) -> bool {
        false
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

/// Whom instances belong to: the certificate of a master.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Owner(Arc<[u8]>);

impl Owner {
    /// The holder of a certificate, as DER.
    pub fn of_certificate(certificate: &[u8]) -> Self {
        Self(certificate.into())
    }
}

/// Why a call has no answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CallError {
    /// The worker answered that it cannot do it.
    #[error("{}", .0.message)]
    Failed(Failure),
    /// The worker does not know the instance: it was never made, was terminated, or ended with its worker or its lease.
    #[error("{message}")]
    NoInstance {
        /// What the worker said.
        message: String,
    },
    /// The worker refuses this caller.
    #[error("{message}")]
    Denied {
        /// What the worker said.
        message: String,
    },
    /// Whoever listens at the address is not to be trusted, or does not trust this master.
    #[error("no connection to {address}: {reason}")]
    Untrusted {
        /// Where the worker was expected.
        address: String,
        /// Why, and what to do.
        reason: String,
    },
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
    /// Somebody asked the run to stop.
    #[error("the run was interrupted")]
    Interrupted,
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
    #[error("no answer within {seconds} s{}", sign_of_life(*.alive))]
    Deadline {
        /// The time limit.
        seconds: f64,
        /// Whether the worker answered a health check then; absent where it was not asked.
        alive: Option<bool>,
    },
}

fn sign_of_life(alive: Option<bool>) -> &'static str {
    match alive {
        Some(true) => {
            ", though it answers health checks: it still computes, or its answer was lost"
        }
        Some(false) => ", nor to a health check: it hangs, or its machine is out of reach",
        None => "",
    }
}

/// The field of a request that names the instance.
pub(crate) const INSTANCE: &str = "instance";

impl CallError {
    /// That there is no such instance here.
    pub fn no_instance(instance: u64) -> Self {
        Self::NoInstance {
            message: format!("there is no instance {instance:#x} here; Initialize makes one"),
        }
    }

    /// That an instance is not the caller's.
    pub fn of_another(instance: u64) -> Self {
        Self::Denied {
            message: format!(
                "instance {instance:#x} belongs to another certificate: only the master that made it may use or end it"
            ),
        }
    }

    /// Whether the worker, or what it knew of the run, is gone: another worker may go on from a state that was kept.
    pub fn is_loss(&self) -> bool {
        match self {
            Self::Lost { .. }
            | Self::Deadline { .. }
            | Self::Unreachable { .. }
            | Self::NoInstance { .. } => true,
            // In the answer to an exchange there is no status.
            Self::Failed(failure) => {
                failure.severity() == Severity::Misuse && failure.field.as_deref() == Some(INSTANCE)
            }
            Self::Unimplemented { .. }
            | Self::Denied { .. }
            | Self::Untrusted { .. }
            | Self::Misplaced { .. }
            | Self::Interrupted => false,
        }
    }

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

impl Contacts {
    /// What contacts did that go on from a state of another instance, which did `earlier`: what belongs to the state is counted on there,
    /// what does not is added up.
    #[must_use]
    pub fn behind(self, earlier: Self) -> Self {
        Self {
            residual: self.residual.max(earlier.residual),
            problems: self.problems + earlier.problems,
            robust: self.robust + earlier.robust,
            ambiguous: self.ambiguous + earlier.ambiguous,
            jams: self.jams + earlier.jams,
            ..self
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
