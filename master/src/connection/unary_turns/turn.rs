//! One exchange as unary calls.

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::exchange::{check_evaluation, check_samples, is_until};
use linchpin_proto::v1::*;

use super::place::Place;

/// One exchange under way.
pub struct Turn<'a, C> {
    calls: &'a C,
    place: &'a mut Place,
    work: Work,
    /// Of the committed state: steps that look ahead do not count.
    contacts: Option<Contacts>,
}

/// What a look ahead brings.
#[derive(Default)]
struct Ahead {
    outputs: Option<Outputs>,
    perturbed: Vec<Outputs>,
    derivatives: Vec<Outputs>,
    impacts: Option<Impacts>,
}

impl<'a, C: Contract> Turn<'a, C> {
    pub fn new(calls: &'a C, place: &'a mut Place) -> Self {
        Self {
            calls,
            place,
            work: Work::default(),
            contacts: None,
        }
    }

    /// Carries out a request. If that fails the committed state is the one before it.
    pub fn run(mut self, request: &ExchangeRequest) -> Result<ExchangeReply, CallError> {
        let mut reply = ExchangeReply {
            sequence: request.sequence,
            instance: Some(request.instance),
            ..ExchangeReply::default()
        };
        match self.carry_out(request, &mut reply) {
            Ok(()) => self.place.settle(request.go_back),
            Err(error) => {
                self.place.discard();
                return Err(error);
            }
        }
        reply.work = Some(Work {
            contacts: self.contacts,
            ..self.work
        });
        Ok(reply)
    }

    fn carry_out(
        &mut self,
        request: &ExchangeRequest,
        reply: &mut ExchangeReply,
    ) -> Result<(), CallError> {
        let committed = self.committed()?;
        let start = if request.go_back {
            self.place.previous()?
        } else {
            committed
        };
        let base = match &request.advance {
            Some(advance) => self.advance(start, advance, reply)?,
            None => start,
        };
        self.look_ahead(base, request, reply)
    }

    /// Snapshot of the committed state.
    fn committed(&mut self) -> Result<u64, CallError> {
        if let Some(committed) = self.place.committed() {
            return Ok(committed);
        }
        let start = self.snapshot()?;
        self.place.start_at(start);
        Ok(start)
    }

    /// Steps from `start`; the snapshot of the end.
    fn advance(
        &mut self,
        start: u64,
        advance: &Advance,
        reply: &mut ExchangeReply,
    ) -> Result<u64, CallError> {
        check_samples(advance)?;
        let step = |length| StepRequest {
            t: advance.t,
            step: length,
            signals: advance.signals.clone(),
            outputs: OutputSet::All.into(),
            impacts: advance.impacts.clone(),
            ..StepRequest::default()
        };
        let whole = StepRequest {
            instants: advance.instants.clone(),
            integrals: advance.integrals,
            ..step(advance.step)
        };
        reply.advanced = self.step_from(start, whole)?.outputs;
        self.contacts = self.work.contacts;
        let reached = self.snapshot()?;
        self.place.reach(reached);
        for &sample in &advance.samples {
            let mut shorter = step(sample);
            if let Some(Impacts { impacts }) = &mut shorter.impacts {
                impacts.retain(|impact| is_until(impact.at, sample));
                for impact in impacts {
                    impact.at = impact.at.min(sample);
                }
            }
            let outputs = self.step_from(start, shorter)?.outputs;
            reply.samples.push(outputs.unwrap_or_default());
        }
        Ok(reached)
    }

    fn look_ahead(
        &mut self,
        base: u64,
        request: &ExchangeRequest,
        reply: &mut ExchangeReply,
    ) -> Result<(), CallError> {
        if let Some(evaluate) = &request.evaluate {
            check_evaluation(evaluate)?;
            let evaluated = self.evaluate(base, evaluate)?;
            reply.evaluated = evaluated.outputs;
            reply.evaluated_perturbed = evaluated.perturbed;
            reply.evaluated_derivatives = evaluated.derivatives;
        }
        if let Some(predict) = &request.predict {
            let predicted = if predict.step == 0.0 {
                self.evaluate(base, predict)?
            } else {
                self.predict(base, predict)?
            };
            reply.predicted = predicted.outputs;
            reply.perturbed = predicted.perturbed;
            reply.derivatives = predicted.derivatives;
            reply.impacts = predicted.impacts;
        }
        Ok(())
    }

    fn predict(&mut self, base: u64, predict: &Predict) -> Result<Ahead, CallError> {
        let step = StepRequest {
            t: predict.t,
            step: predict.step,
            signals: predict.signals.clone(),
            outputs: OutputSet::Coupling.into(),
            instants: predict.instants.clone(),
            integrals: predict.integrals,
            impacts: predict.impacts.clone(),
            interface: predict.interface.clone(),
            ..StepRequest::default()
        };
        let answer = self.step_from(base, step)?;
        let mut ahead = Ahead {
            outputs: answer.outputs,
            impacts: answer.impacts,
            ..Ahead::default()
        };
        if predict.perturbed.is_empty() && predict.directions.is_empty() {
            return Ok(ahead);
        }
        self.go_to(base)?;
        let answer = self.calls.perturbed_step(&PerturbedStepRequest {
            instance: self.place.instance,
            sequence: self.place.next(),
            t: predict.t,
            step: predict.step,
            signals: predict.signals.clone(),
            perturbed: predict.perturbed.clone(),
            directions: predict.directions.clone(),
            instants: predict.instants.clone(),
            integrals: predict.integrals,
            impacts: predict.impacts.clone(),
            interface: predict.interface.clone(),
        })?;
        self.count(answer.work);
        ahead.perturbed = answer.outputs;
        ahead.derivatives = answer.derivatives;
        Ok(ahead)
    }

    fn evaluate(&mut self, base: u64, evaluate: &Predict) -> Result<Ahead, CallError> {
        self.go_to(base)?;
        let mut request = EvaluateRequest {
            instance: self.place.instance,
            t: evaluate.t,
            signals: evaluate.signals.clone(),
            outputs: self.place.coupling_outputs.clone(),
            directions: evaluate.directions.clone(),
        };
        let answer = self.calls.evaluate(&request)?;
        let mut ahead = Ahead {
            outputs: answer.outputs,
            derivatives: answer.derivatives,
            ..Ahead::default()
        };
        request.directions.clear();
        for perturbed in &evaluate.perturbed {
            request.signals.clone_from(&evaluate.signals);
            request
                .signals
                .retain(|signal| signal.input != perturbed.input);
            request.signals.push(perturbed.clone());
            let outputs = self.calls.evaluate(&request)?.outputs;
            ahead.perturbed.push(outputs.unwrap_or_default());
        }
        Ok(ahead)
    }

    fn step_from(&mut self, start: u64, mut request: StepRequest) -> Result<StepReply, CallError> {
        self.go_to(start)?;
        request.instance = self.place.instance;
        request.sequence = self.place.next();
        self.place.stands_at = None;
        let answer = self.calls.step(&request)?;
        self.count(answer.work);
        Ok(answer)
    }

    /// Keeps the state that the instance has.
    fn snapshot(&mut self) -> Result<u64, CallError> {
        let request = SnapshotRequest {
            instance: self.place.instance,
            sequence: self.place.next(),
            replaces: self.place.replaceable(),
        };
        let snapshot = self.calls.snapshot(&request)?.snapshot;
        self.place.stands_at = Some(snapshot);
        Ok(snapshot)
    }

    fn go_to(&mut self, snapshot: u64) -> Result<(), CallError> {
        if self.place.stands_at == Some(snapshot) {
            return Ok(());
        }
        let request = RestoreRequest {
            instance: self.place.instance,
            sequence: self.place.next(),
            snapshot,
        };
        self.calls.restore(&request)?;
        self.place.stands_at = Some(snapshot);
        Ok(())
    }

    /// Lets the instance have its committed state, which is that of the start before the first exchange.
    pub fn go_to_committed(&mut self) -> Result<(), CallError> {
        match self.place.committed() {
            Some(committed) => self.go_to(committed),
            None => Ok(()),
        }
    }

    fn count(&mut self, work: Option<Work>) {
        self.work += work.unwrap_or_default();
    }
}
