//! A peer that plays a script, for tests of masters and of transports.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use linchpin_proto::contract::{CallError, Contract, Hold};
use linchpin_proto::v1::{self, Failure};

/// What the peer does instead of answering truly.
#[derive(Debug, Clone, PartialEq)]
pub enum Act {
    /// Answers with a failure.
    Fail(Failure),
    /// Puts this number in the place of an advanced or, without an advance, predicted output; panics if the exchange
    /// has no such output.
    Put {
        /// Place among the coupling outputs.
        output: usize,
        /// The number, e.g. NaN.
        value: f64,
    },
    /// Drops the last coupling output.
    ForgetOutput,
    /// Answers only after this time.
    Wait(Duration),
}

/// Passes every call to another contract, except where the script says otherwise.
pub struct Scripted {
    inner: Arc<dyn Contract>,
    exchanges: AtomicU64,
    acts: BTreeMap<u64, Act>,
    protocol: Option<v1::ProtocolVersion>,
    only_unary: bool,
    highest_degree: Option<u32>,
}

impl Scripted {
    /// A peer that is true so far.
    pub fn new(inner: Arc<dyn Contract>) -> Self {
        Self {
            inner,
            exchanges: AtomicU64::new(0),
            acts: BTreeMap::new(),
            protocol: None,
            only_unary: false,
            highest_degree: None,
        }
    }

    /// Acts at exchange number `exchange`, counted from 0.
    pub fn at_exchange(mut self, exchange: u64, act: Act) -> Self {
        self.acts.insert(exchange, act);
        self
    }

    /// Says that it speaks `protocol`.
    pub fn speaking(mut self, protocol: v1::ProtocolVersion) -> Self {
        self.protocol = Some(protocol);
        self
    }

    /// Takes input polynomials of degree `degree` at most.
    pub fn taking_degree(mut self, degree: u32) -> Self {
        self.highest_degree = Some(degree);
        self
    }

    /// Has no exchange stream.
    pub fn only_unary(mut self) -> Self {
        self.only_unary = true;
        self
    }
}

impl Contract for Scripted {
    fn describe(&self, request: &v1::DescribeRequest) -> Result<v1::DescribeReply, CallError> {
        let mut reply = self.inner.describe(request)?;
        if self.protocol.is_some() {
            reply.protocol = self.protocol;
        }
        let models = reply.models.iter_mut();
        for capabilities in models.flat_map(|model| &mut model.capabilities) {
            capabilities.exchange &= !self.only_unary;
            if self.highest_degree.is_some() {
                capabilities.max_input_degree = self.highest_degree;
            }
        }
        Ok(reply)
    }

    fn initialize(
        &self,
        request: &v1::InitializeRequest,
    ) -> Result<v1::InitializeReply, CallError> {
        self.inner.initialize(request)
    }

    fn snapshot(&self, request: &v1::SnapshotRequest) -> Result<v1::SnapshotReply, CallError> {
        self.inner.snapshot(request)
    }

    fn restore(&self, request: &v1::RestoreRequest) -> Result<v1::RestoreReply, CallError> {
        self.inner.restore(request)
    }

    fn step(&self, request: &v1::StepRequest) -> Result<v1::StepReply, CallError> {
        self.inner.step(request)
    }

    fn perturbed_step(
        &self,
        request: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, CallError> {
        self.inner.perturbed_step(request)
    }

    fn evaluate(&self, request: &v1::EvaluateRequest) -> Result<v1::EvaluateReply, CallError> {
        self.inner.evaluate(request)
    }

    fn terminate(&self, request: &v1::TerminateRequest) -> Result<v1::TerminateReply, CallError> {
        self.inner.terminate(request)
    }

    fn list_instances(
        &self,
        request: &v1::ListInstancesRequest,
    ) -> Result<v1::ListInstancesReply, CallError> {
        self.inner.list_instances(request)
    }

    fn hold(&self, instance: u64, by: &Hold) {
        self.inner.hold(instance, by);
    }

    fn tidy(&self) {
        self.inner.tidy();
    }

    fn exchange(
        &self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), CallError> {
        if self.only_unary {
            return Err(CallError::Unimplemented { call: "Exchange" });
        }
        let number = self.exchanges.fetch_add(1, Ordering::Relaxed);
        let act = self.acts.get(&number);
        if let Some(Act::Fail(failure)) = act {
            return Err(failure.clone().into());
        }
        self.inner.exchange(request, reply)?;
        let outputs = reply.advanced.as_mut().or(reply.predicted.as_mut());
        match (act, outputs) {
            (Some(Act::Wait(time)), _) => std::thread::sleep(*time),
            (Some(Act::Put { output, value }), Some(outputs)) => outputs.values[*output] = *value,
            (Some(Act::ForgetOutput), Some(outputs)) => {
                outputs.values.pop();
            }
            _ => {}
        }
        Ok(())
    }
}
