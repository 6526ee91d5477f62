//! The fused exchange for workers that only have the unary calls.

mod place;
mod turn;

use std::sync::{Mutex, PoisonError};

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::exchange::other_content;
use linchpin_proto::v1::*;

use place::Place;
use turn::Turn;

/// A contract whose exchange is made of Restore, Step, Snapshot, PerturbedStep and Evaluate of another one.
///
/// The solver sees the same steps from the same states as with the fused exchange, so the results have equal bits. Up to three
/// snapshots are kept: the committed state, the one before it, and the end of the advance that is under way.
pub struct UnaryTurns<C> {
    calls: C,
    instance: Mutex<Driven>,
}

/// The instance that is driven.
#[derive(Default)]
struct Driven {
    place: Place,
    last: Option<(ExchangeRequest, Answer)>,
}

/// The answer to the last request, given again when that is repeated.
type Answer = Result<ExchangeReply, Failure>;

impl<C: Contract> UnaryTurns<C> {
    /// Exchanges by the calls of `calls`, for one instance.
    pub fn new(calls: C) -> Self {
        Self {
            calls,
            instance: Mutex::default(),
        }
    }

    fn exchange_once(
        &self,
        driven: &mut Driven,
        request: &ExchangeRequest,
    ) -> Result<Answer, CallError> {
        if let Some((last, answer)) = &driven.last
            && last.sequence == request.sequence
        {
            return Ok(match last == request {
                true => answer.clone(),
                false => Err(other_content("Exchange", request.sequence)),
            });
        }
        let turn = Turn::new(&self.calls, &mut driven.place);
        let answer = match turn.run(request) {
            Ok(reply) => Ok(reply),
            Err(CallError::Failed(failure)) => Err(failure),
            Err(no_answer) => return Err(no_answer),
        };
        driven.last = Some((request.clone(), answer.clone()));
        Ok(answer)
    }
}

impl<C: Contract> Contract for UnaryTurns<C> {
    fn describe(&self, request: &DescribeRequest) -> Result<DescribeReply, CallError> {
        self.calls.describe(request)
    }

    fn initialize(&self, request: &InitializeRequest) -> Result<InitializeReply, CallError> {
        let reply = self.calls.initialize(request)?;
        let mut driven = self.instance.lock().unwrap_or_else(PoisonError::into_inner);
        *driven = Driven {
            place: Place::at_start(request),
            last: None,
        };
        Ok(reply)
    }

    fn snapshot(&self, request: &SnapshotRequest) -> Result<SnapshotReply, CallError> {
        self.calls.snapshot(request)
    }

    fn restore(&self, request: &RestoreRequest) -> Result<RestoreReply, CallError> {
        self.calls.restore(request)
    }

    fn export_state(&self, request: &ExportStateRequest) -> Result<ExportStateReply, CallError> {
        let mut driven = self.instance.lock().unwrap_or_else(PoisonError::into_inner);
        Turn::new(&self.calls, &mut driven.place).go_to_committed()?;
        self.calls.export_state(request)
    }

    fn import_state(&self, request: &ImportStateRequest) -> Result<ImportStateReply, CallError> {
        let mut driven = self.instance.lock().unwrap_or_else(PoisonError::into_inner);
        let own = ImportStateRequest {
            sequence: driven.place.next(),
            ..request.clone()
        };
        let reply = self.calls.import_state(&own)?;
        driven.place.forget_states();
        driven.last = None;
        Ok(ImportStateReply {
            sequence: Some(request.sequence),
            ..reply
        })
    }

    fn step(&self, request: &StepRequest) -> Result<StepReply, CallError> {
        self.calls.step(request)
    }

    fn perturbed_step(
        &self,
        request: &PerturbedStepRequest,
    ) -> Result<PerturbedStepReply, CallError> {
        self.calls.perturbed_step(request)
    }

    fn evaluate(&self, request: &EvaluateRequest) -> Result<EvaluateReply, CallError> {
        self.calls.evaluate(request)
    }

    fn terminate(&self, request: &TerminateRequest) -> Result<TerminateReply, CallError> {
        self.calls.terminate(request)
    }

    fn list_instances(
        &self,
        request: &ListInstancesRequest,
    ) -> Result<ListInstancesReply, CallError> {
        self.calls.list_instances(request)
    }

    fn exchange(
        &self,
        request: &ExchangeRequest,
        reply: &mut ExchangeReply,
    ) -> Result<(), CallError> {
        let mut driven = self.instance.lock().unwrap_or_else(PoisonError::into_inner);
        *reply = self.exchange_once(&mut driven, request)??;
        Ok(())
    }
}
