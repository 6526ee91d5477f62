//! The fused macro step on top of step, snapshot and restore.

use linchpin_proto::v1::{self, Failure};

use super::{Answer, Base, Horizon, Instance, Meter, Sequence, interval};

impl Instance {
    /// Goes on with the corrected inputs and commits, then looks ahead from there.
    pub(crate) fn exchange(
        &mut self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::Exchange(answer) => {
                    copy(&self.exchanged, reply);
                    answer.clone()
                }
                other => Err(other.belongs_not_to("Exchange")),
            };
        }
        let answer = self.advance_and_predict(request, reply);
        if answer.is_ok() {
            copy(reply, &mut self.exchanged);
        }
        self.settle(Answer::Exchange(answer.clone()));
        answer
    }

    fn advance_and_predict(
        &mut self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), Failure> {
        let meter = Meter::start(&self.motion);
        reply.sequence = request.sequence;
        reply.failure = None;
        let base = match &request.advance {
            Some(advance) => {
                let outputs = reply.advanced.get_or_insert_default();
                self.advance(advance, &mut outputs.values)?;
                Base::Advanced
            }
            None => {
                reply.advanced = None;
                Base::Committed
            }
        };
        match &request.predict {
            Some(predict) => self.predict(base, predict, reply)?,
            None => {
                reply.predicted = None;
                reply.perturbed.clear();
            }
        }
        if base == Base::Advanced {
            self.motion.commit();
        }
        reply.work = Some(meter.stop(&self.motion));
        Ok(())
    }

    fn advance(&mut self, advance: &v1::Advance, values: &mut Vec<f64>) -> Result<(), Failure> {
        let interval = interval(advance.t, advance.step)?;
        self.motion
            .advance(interval, &advance.signals, v1::OutputSet::All, values)
    }

    fn predict(
        &mut self,
        base: Base,
        predict: &v1::Predict,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), Failure> {
        let horizon = Horizon::of(predict)?;
        let predicted = reply.predicted.get_or_insert_default();
        self.motion.set_signals(&predict.signals)?;
        self.motion
            .look_ahead(base, horizon, Sequence::Own, &mut predicted.values)?;
        self.motion
            .look_ahead_perturbed(base, horizon, &predict.perturbed, &mut reply.perturbed)
    }
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
