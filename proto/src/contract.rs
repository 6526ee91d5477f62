//! The calls of the contract as a plain trait, so that master and worker can meet in one process.
//!
//! The gRPC service of a worker and the in-process connection of a master both go through [`Contract`]:
//! the same messages, only without a socket.

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
