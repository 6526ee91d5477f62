//! The fused exchange for workers that only have the unary calls.

use std::sync::{Mutex, PoisonError};

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::*;

/// A contract whose exchange is made of Restore, Step, Snapshot, PerturbedStep and Evaluate of another one.
///
/// The solver sees the same steps from the same states as with the fused exchange, so the results have equal bits.
pub struct UnaryTurns<C> {
    calls: C,
    place: Mutex<Place>,
}

/// Where the instance stands.
#[derive(Default)]
struct Place {
    initialize: InitializeRequest,
    sequence: u64,
    committed: Option<u64>,
    moved: bool,
}

impl<C: Contract> UnaryTurns<C> {
    /// Exchanges by the calls of `calls`, for one instance.
    pub fn new(calls: C) -> Self {
        Self {
            calls,
            place: Mutex::default(),
        }
    }

    fn advance(
        &self,
        place: &mut Place,
        instance: u64,
        advance: &Advance,
        reply: &mut ExchangeReply,
    ) -> Result<(), CallError> {
        self.go_back(place, instance)?;
        let (t, length) = (advance.t, advance.step);
        let answer = self.step_over(
            place,
            instance,
            (t, length),
            &advance.signals,
            OutputSet::All,
        )?;
        add(&mut reply.work, answer.work);
        reply.advanced = answer.outputs;
        self.commit(place, instance)
    }

    fn predict(
        &self,
        place: &mut Place,
        instance: u64,
        predict: &Predict,
        reply: &mut ExchangeReply,
    ) -> Result<(), CallError> {
        if predict.step == 0.0 {
            return self.evaluate(place, instance, predict, reply);
        }
        let (t, length) = (predict.t, predict.step);
        let outputs = OutputSet::Coupling;
        let answer = self.step_over(place, instance, (t, length), &predict.signals, outputs)?;
        add(&mut reply.work, answer.work);
        reply.predicted = answer.outputs;
        if predict.perturbed.is_empty() {
            return Ok(());
        }
        self.go_back(place, instance)?;
        let perturbed = PerturbedStepRequest {
            instance,
            sequence: place.next(),
            t: predict.t,
            step: predict.step,
            signals: predict.signals.clone(),
            perturbed: predict.perturbed.clone(),
        };
        let answer = self.calls.perturbed_step(&perturbed)?;
        add(&mut reply.work, answer.work);
        reply.perturbed = answer.outputs;
        Ok(())
    }

    fn step_over(
        &self,
        place: &mut Place,
        instance: u64,
        (t, step): (f64, f64),
        signals: &[Signal],
        outputs: OutputSet,
    ) -> Result<StepReply, CallError> {
        place.moved = true;
        let request = StepRequest {
            instance,
            sequence: place.next(),
            t,
            step,
            signals: signals.to_vec(),
            outputs: outputs.into(),
        };
        self.calls.step(&request)
    }

    fn evaluate(
        &self,
        place: &mut Place,
        instance: u64,
        predict: &Predict,
        reply: &mut ExchangeReply,
    ) -> Result<(), CallError> {
        self.go_back(place, instance)?;
        let mut evaluate = EvaluateRequest {
            instance,
            t: predict.t,
            signals: predict.signals.clone(),
            outputs: place.initialize.coupling_outputs.clone(),
        };
        reply.predicted = self.calls.evaluate(&evaluate)?.outputs;
        for perturbed in &predict.perturbed {
            evaluate.signals.clone_from(&predict.signals);
            evaluate
                .signals
                .retain(|signal| signal.input != perturbed.input);
            evaluate.signals.push(perturbed.clone());
            let outputs = self.calls.evaluate(&evaluate)?.outputs;
            reply.perturbed.push(outputs.unwrap_or_default());
        }
        Ok(())
    }

    fn commit(&self, place: &mut Place, instance: u64) -> Result<(), CallError> {
        let snapshot = SnapshotRequest {
            instance,
            sequence: place.next(),
            replaces: place.committed,
        };
        place.committed = Some(self.calls.snapshot(&snapshot)?.snapshot);
        place.moved = false;
        Ok(())
    }

    fn go_back(&self, place: &mut Place, instance: u64) -> Result<(), CallError> {
        match place.committed {
            Some(snapshot) if place.moved => {
                let restore = RestoreRequest {
                    instance,
                    sequence: place.next(),
                    snapshot,
                };
                self.calls.restore(&restore)?;
                place.moved = false;
                Ok(())
            }
            Some(_) => Ok(()),
            None => self.commit(place, instance),
        }
    }
}

impl Place {
    fn next(&mut self) -> u64 {
        self.sequence += 1;
        self.sequence
    }
}

fn add(total: &mut Option<Work>, more: Option<Work>) {
    let (total, more) = (total.get_or_insert_default(), more.unwrap_or_default());
    total.integrations += more.integrations;
    total.steps += more.steps;
    total.nanoseconds += more.nanoseconds;
}

impl<C: Contract> Contract for UnaryTurns<C> {
    fn describe(&self, request: &DescribeRequest) -> Result<DescribeReply, CallError> {
        self.calls.describe(request)
    }

    fn initialize(&self, request: &InitializeRequest) -> Result<InitializeReply, CallError> {
        let reply = self.calls.initialize(request)?;
        let mut place = self.place.lock().unwrap_or_else(PoisonError::into_inner);
        *place = Place {
            initialize: request.clone(),
            sequence: request.sequence,
            ..Place::default()
        };
        Ok(reply)
    }

    fn snapshot(&self, request: &SnapshotRequest) -> Result<SnapshotReply, CallError> {
        self.calls.snapshot(request)
    }

    fn restore(&self, request: &RestoreRequest) -> Result<RestoreReply, CallError> {
        self.calls.restore(request)
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

    fn exchange(
        &self,
        request: &ExchangeRequest,
        reply: &mut ExchangeReply,
    ) -> Result<(), CallError> {
        *reply = ExchangeReply {
            sequence: request.sequence,
            ..ExchangeReply::default()
        };
        let mut place = self.place.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(advance) = &request.advance {
            self.advance(&mut place, request.instance, advance, reply)?;
        }
        if let Some(predict) = &request.predict {
            self.go_back(&mut place, request.instance)?;
            self.predict(&mut place, request.instance, predict, reply)?;
        }
        Ok(())
    }
}
