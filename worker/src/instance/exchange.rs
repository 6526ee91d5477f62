//! The fused macro step on top of step, snapshot and restore.

use linchpin_proto::v1::{self, Failure};

use super::{Answer, Instance, Meter, Sequence, go_back, interval};
use crate::Interval;

impl Instance {
    /// Goes on with the corrected inputs and commits, then looks ahead from there.
    ///
    /// After a failure the committed state is the one before the request.
    pub(crate) fn exchange(
        &mut self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::Exchange => {
                    copy(&self.exchanged, reply);
                    Ok(())
                }
                other => Err(other.to_another_call("Exchange")),
            };
        }
        let done = self.advance_and_predict(request, reply);
        if done.is_ok() {
            copy(reply, &mut self.exchanged);
        }
        self.settle(done, |()| Answer::Exchange)
    }

    fn advance_and_predict(
        &mut self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), Failure> {
        let meter = Meter::start(self);
        reply.sequence = request.sequence;
        reply.failure = None;
        match &request.advance {
            Some(advance) => {
                let outputs = reply.advanced.get_or_insert_default();
                self.advance(advance, &mut outputs.values)?;
            }
            None => reply.advanced = None,
        }
        let base = if request.advance.is_some() {
            Base::Advanced
        } else {
            Base::Committed
        };
        match &request.predict {
            Some(predict) => self.predict(base, predict, reply)?,
            None => {
                reply.predicted = None;
                reply.perturbed.clear();
            }
        }
        if base == Base::Advanced {
            std::mem::swap(&mut self.committed, &mut self.advanced);
        }
        reply.work = Some(meter.stop(self));
        Ok(())
    }

    fn advance(&mut self, advance: &v1::Advance, values: &mut Vec<f64>) -> Result<(), Failure> {
        let interval = interval(advance.t, advance.step)?;
        self.go_to(Base::Committed)?;
        self.signals.set(&advance.signals)?;
        self.integrate(interval, Sequence::Own)?;
        self.read(interval, v1::OutputSet::All, values)?;
        self.advanced.snapshot.clear();
        self.subsystem.snapshot(&mut self.advanced.snapshot);
        self.advanced.state = self.state;
        Ok(())
    }

    fn predict(
        &mut self,
        base: Base,
        predict: &v1::Predict,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), Failure> {
        let horizon = Horizon::of(predict)?;
        let predicted = reply.predicted.get_or_insert_default();
        self.signals.set(&predict.signals)?;
        self.look_ahead(base, horizon, Sequence::Own, &mut predicted.values)?;
        reply
            .perturbed
            .resize_with(predict.perturbed.len(), v1::Outputs::default);
        for (signal, outputs) in predict.perturbed.iter().zip(&mut reply.perturbed) {
            let replaced = self.signals.replace(signal)?;
            let done = self.look_ahead(base, horizon, Sequence::Repeated, &mut outputs.values);
            self.signals.put_back(replaced);
            done?;
        }
        Ok(())
    }

    fn look_ahead(
        &mut self,
        base: Base,
        horizon: Horizon,
        sequence: Sequence,
        values: &mut Vec<f64>,
    ) -> Result<(), Failure> {
        self.go_to(base)?;
        match horizon {
            Horizon::Step(interval) => {
                self.integrate(interval, sequence)?;
                self.read(interval, v1::OutputSet::Coupling, values)
            }
            Horizon::Now(t) => {
                let now = Interval {
                    start: t,
                    length: 0.0,
                };
                self.read(now, v1::OutputSet::Coupling, values)
            }
        }
    }

    fn go_to(&mut self, base: Base) -> Result<(), Failure> {
        let kept = match base {
            Base::Committed => &self.committed,
            Base::Advanced => &self.advanced,
        };
        if self.state == kept.state {
            return Ok(());
        }
        go_back(&mut *self.subsystem, &mut self.state, kept)
    }
}

/// Which state a prediction starts from.
#[derive(Clone, Copy, PartialEq)]
enum Base {
    Committed,
    Advanced,
}

/// How far a prediction looks.
#[derive(Clone, Copy)]
enum Horizon {
    Step(Interval),
    Now(f64),
}

impl Horizon {
    fn of(predict: &v1::Predict) -> Result<Self, Failure> {
        if predict.step == 0.0 && predict.t.is_finite() {
            return Ok(Self::Now(predict.t));
        }
        interval(predict.t, predict.step).map(Self::Step)
    }
}

/// Copies an answer into memory that is already there.
fn copy(from: &v1::ExchangeReply, to: &mut v1::ExchangeReply) {
    to.sequence = from.sequence;
    copy_outputs(from.advanced.as_ref(), &mut to.advanced);
    copy_outputs(from.predicted.as_ref(), &mut to.predicted);
    to.perturbed
        .resize_with(from.perturbed.len(), v1::Outputs::default);
    for (from, to) in from.perturbed.iter().zip(&mut to.perturbed) {
        to.values.clone_from(&from.values);
    }
    to.work = from.work;
    to.failure = None;
}

fn copy_outputs(from: Option<&v1::Outputs>, to: &mut Option<v1::Outputs>) {
    match from {
        Some(from) => to.get_or_insert_default().values.clone_from(&from.values),
        None => *to = None,
    }
}
