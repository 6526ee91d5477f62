//! The fused macro step on top of step, snapshot and restore.

use linchpin_proto::exchange::{check_evaluation, check_samples};
use linchpin_proto::v1::{self, Failure};

use super::motion::resize;
use super::{Answer, Base, Horizon, Inside, Instance, Meter, Sequence, interval};
use crate::Interval;

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
                    self.same("Exchange", request)?;
                    copy(&self.exchanged, reply, &mut self.spare);
                    answer.clone()
                }
                other => Err(other.belongs_not_to("Exchange")),
            };
        }
        let answer = self.turn(request, reply);
        if answer.is_ok() {
            copy(reply, &mut self.exchanged, &mut self.spare);
        }
        self.settle(request, Answer::Exchange(answer.clone()));
        answer
    }

    fn turn(
        &mut self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), Failure> {
        if !request.go_back {
            return self.advance_and_look_ahead(request, reply);
        }
        self.motion.take_back()?;
        let answer = self.advance_and_look_ahead(request, reply);
        if answer.is_err() {
            self.motion.stay();
        }
        answer
    }

    fn advance_and_look_ahead(
        &mut self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), Failure> {
        let mut meter = Meter::start(&self.motion);
        reply.sequence = request.sequence;
        reply.instance = Some(request.instance);
        reply.failure = None;
        let base = match &request.advance {
            Some(advance) => {
                self.advance(advance, &mut meter, reply)?;
                Base::Advanced
            }
            None => {
                reply.advanced = None;
                reply.samples.clear();
                Base::Committed
            }
        };
        let mut evaluated = LookAhead {
            outputs: &mut reply.evaluated,
            perturbed: &mut reply.evaluated_perturbed,
            derivatives: &mut reply.evaluated_derivatives,
        };
        match &request.evaluate {
            Some(evaluate) => {
                check_evaluation(evaluate)?;
                self.look_ahead(base, evaluate, evaluated)?;
            }
            None => evaluated.clear(),
        }
        let mut predicted = LookAhead {
            outputs: &mut reply.predicted,
            perturbed: &mut reply.perturbed,
            derivatives: &mut reply.derivatives,
        };
        match &request.predict {
            Some(predict) => {
                self.look_ahead(base, predict, predicted)?;
                self.motion
                    .tell_impacts(&predict.instants, &mut reply.impacts);
            }
            None => {
                predicted.clear();
                reply.impacts = None;
            }
        }
        if base == Base::Advanced {
            self.motion.commit();
        }
        reply.work = Some(meter.stop(&self.motion));
        Ok(())
    }

    fn advance(
        &mut self,
        advance: &v1::Advance,
        meter: &mut Meter,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), Failure> {
        let interval = interval(advance.t, advance.step)?;
        check_samples(advance)?;
        let advanced = reply.advanced.get_or_insert_default();
        let inside = Inside {
            instants: &advance.instants,
            integrals: advance.integrals,
        };
        self.motion
            .treat_impacts(advance.step, advance.impacts.as_ref(), None)?;
        self.motion.advance(
            (interval, inside),
            &advance.signals,
            v1::OutputSet::All,
            &mut advanced.values,
        )?;
        meter.look_at_contacts(&self.motion);
        reply
            .samples
            .resize_with(advance.samples.len(), v1::Outputs::default);
        for (&length, outputs) in advance.samples.iter().zip(&mut reply.samples) {
            let shorter = Interval { length, ..interval };
            self.motion.sample(shorter, &mut outputs.values)?;
        }
        Ok(())
    }

    fn look_ahead(
        &mut self,
        base: Base,
        look: &v1::Predict,
        into: LookAhead,
    ) -> Result<(), Failure> {
        let horizon = Horizon::of(look)?;
        let outputs = into.outputs.get_or_insert_default();
        self.motion.set_signals(&look.signals)?;
        self.motion.integrate_outputs(look.integrals)?;
        let (impacts, interface) = (look.impacts.as_ref(), look.interface.as_ref());
        self.motion.treat_impacts(look.step, impacts, interface)?;
        if let (Horizon::Step(interval), true) = (horizon, self.motion.is_cut(&look.instants)) {
            let step = (interval, &look.instants[..]);
            let answers = (Some(&mut outputs.values), into.perturbed);
            self.motion
                .look_ahead_cut(base, step, &look.perturbed, answers)?;
            return self.motion.look_in_directions_cut(
                base,
                step,
                &look.directions,
                into.derivatives,
            );
        }
        self.motion
            .look_ahead(base, horizon, Sequence::Own, &mut outputs.values)?;
        self.motion
            .look_ahead_perturbed(base, horizon, &look.perturbed, into.perturbed)?;
        self.motion.look_ahead_in_directions(
            base,
            horizon,
            &look.directions,
            None,
            into.derivatives,
        )
    }
}

/// Where the answer of a prediction or an evaluation stands in a reply.
struct LookAhead<'a> {
    outputs: &'a mut Option<v1::Outputs>,
    perturbed: &'a mut Vec<v1::Outputs>,
    derivatives: &'a mut Vec<v1::Outputs>,
}

impl LookAhead<'_> {
    fn clear(&mut self) {
        *self.outputs = None;
        self.perturbed.clear();
        self.derivatives.clear();
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
fn copy(from: &v1::ExchangeReply, to: &mut v1::ExchangeReply, spare: &mut Vec<v1::Impact>) {
    (to.sequence, to.instance) = (from.sequence, from.instance);
    for (from, to) in [
        (&from.advanced, &mut to.advanced),
        (&from.evaluated, &mut to.evaluated),
        (&from.predicted, &mut to.predicted),
    ] {
        copy_outputs(from.as_ref(), to);
    }
    for (from, to) in [
        (&from.samples, &mut to.samples),
        (&from.evaluated_perturbed, &mut to.evaluated_perturbed),
        (&from.evaluated_derivatives, &mut to.evaluated_derivatives),
        (&from.perturbed, &mut to.perturbed),
        (&from.derivatives, &mut to.derivatives),
    ] {
        to.resize_with(from.len(), v1::Outputs::default);
        for (from, to) in from.iter().zip(to) {
            to.values.clone_from(&from.values);
        }
    }
    to.work = from.work;
    copy_impacts(from.impacts.as_ref(), &mut to.impacts, spare);
    to.failure = None;
}

fn copy_impacts(
    from: Option<&v1::Impacts>,
    to: &mut Option<v1::Impacts>,
    spare: &mut Vec<v1::Impact>,
) {
    let Some(from) = from else {
        *to = None;
        return;
    };
    let to = &mut to.get_or_insert_default().impacts;
    resize(to, from.impacts.len(), spare);
    for (from, to) in from.impacts.iter().zip(to) {
        to.at = from.at;
        to.contacts.clone_from(&from.contacts);
        to.multipliers.clone_from(&from.multipliers);
    }
}

fn copy_outputs(from: Option<&v1::Outputs>, to: &mut Option<v1::Outputs>) {
    match from {
        Some(from) => to.get_or_insert_default().values.clone_from(&from.values),
        None => *to = None,
    }
}
