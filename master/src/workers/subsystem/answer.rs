//! The answer of a worker: whole, finite, and what the coupling reads of it.

use linchpin_proto::v1;

use super::{Ahead, Inside, NOTHING, Subsystem};
use crate::error::RunError;
use crate::time::MacroStep;

/// What became of a request to advance and to look ahead from there.
#[derive(Debug)]
pub(crate) enum Answered {
    /// All of it was done.
    Whole,
    /// The advance was done; the look-ahead came to nothing, but over a shorter step it may not.
    Advanced(RunError),
    /// Nothing was done, because of the look-ahead or of the advance; over a shorter step it may be.
    Refused(RunError),
}

impl Subsystem {
    /// Takes the answer to a request to advance and to look ahead, as [`Subsystem::collect`] does. What ends the run is an error.
    pub(crate) fn collect_advance(&mut self, step: MacroStep) -> Result<Answered, RunError> {
        let may_be_repeated = |error: &RunError| error.may_vanish_with_a_shorter_step();
        match self.receive(step) {
            Err(error) if may_be_repeated(&error) => return Ok(Answered::Refused(error)),
            received => received?,
        }
        self.take_advanced(step)?;
        let predicted = self.check_prediction(step);
        self.check_evaluation(step)?;
        match predicted {
            Ok(()) => Ok(Answered::Whole),
            Err(error) if may_be_repeated(&error) => Ok(Answered::Advanced(error)),
            Err(error) => Err(error),
        }
    }

    /// Coupling outputs at the present macro point.
    pub(crate) fn coupling_values(&self) -> &[f64] {
        &self.outputs[..self.coupling_outputs]
    }

    /// Coupling outputs of the last prediction.
    pub(crate) fn predicted(&self) -> &[f64] {
        values(self.reply.predicted.as_ref())
    }

    /// What was told at the instants inside the last advance.
    pub(crate) fn advanced_inside(&self) -> &[f64] {
        let advanced = values(self.reply.advanced.as_ref());
        advanced.get(self.output_names.len()..).unwrap_or_default()
    }

    /// Outputs at a sample inside the last advance, in the order of the names.
    pub(crate) fn sample(&self, place: usize) -> &[f64] {
        let sample = self.reply.samples.get(place);
        sample.map_or(&[], |outputs| &outputs.values)
    }

    /// Directional derivatives of the coupling outputs of the last look-ahead.
    pub(crate) fn derivatives(&self, ahead: Ahead) -> &[v1::Outputs] {
        match ahead {
            Ahead::Step => &self.reply.derivatives,
            Ahead::Now => &self.reply.evaluated_derivatives,
        }
    }

    /// Coupling outputs of the last look-ahead, and those of its perturbed signals.
    pub(crate) fn looked(&self, ahead: Ahead) -> (&[f64], &[v1::Outputs]) {
        let reply = &self.reply;
        match ahead {
            Ahead::Step => (self.predicted(), &reply.perturbed),
            Ahead::Now => (values(reply.evaluated.as_ref()), &reply.evaluated_perturbed),
        }
    }

    pub(super) fn take_advanced(&mut self, step: MacroStep) -> Result<(), RunError> {
        let Some(advance) = &self.request.advance else {
            return Ok(());
        };
        let samples = (&self.reply.samples[..], advance.samples.len());
        self.check_each(
            ["samples", "sampled outputs"],
            samples,
            &self.output_names,
            NOTHING,
            step,
        )?;
        let advanced = values(self.reply.advanced.as_ref());
        let named = ("advanced outputs", &self.output_names[..]);
        let inside = Inside {
            integrals: advance.integrals,
            instants: advance.instants.len(),
        };
        self.check(named, advanced, inside, step)?;
        let at_end = &advanced[..self.output_names.len()];
        self.outputs.clear();
        self.outputs.extend_from_slice(at_end);
        Ok(())
    }

    pub(super) fn check_prediction(&self, step: MacroStep) -> Result<(), RunError> {
        let names = &self.output_names[..self.coupling_outputs];
        let reply = &self.reply;
        if let Some(predict) = &self.request.predict {
            let inside = Inside {
                integrals: predict.integrals,
                instants: predict.instants.len(),
            };
            self.check(("predicted outputs", names), self.predicted(), inside, step)?;
            let perturbed = (&reply.perturbed[..], predict.perturbed.len());
            self.check_each(
                ["perturbed steps", "perturbed outputs"],
                perturbed,
                names,
                inside,
                step,
            )?;
            let derivatives = (&reply.derivatives[..], predict.directions.len());
            self.check_each(
                [
                    "directional derivatives",
                    "derivatives of predicted outputs",
                ],
                derivatives,
                names,
                inside,
                step,
            )?;
        }
        Ok(())
    }

    pub(super) fn check_evaluation(&self, step: MacroStep) -> Result<(), RunError> {
        let names = &self.output_names[..self.coupling_outputs];
        let reply = &self.reply;
        if let Some(evaluate) = &self.request.evaluate {
            let evaluated = values(reply.evaluated.as_ref());
            self.check(("evaluated outputs", names), evaluated, NOTHING, step)?;
            let perturbed = (&reply.evaluated_perturbed[..], evaluate.perturbed.len());
            self.check_each(
                ["perturbed evaluations", "perturbed outputs"],
                perturbed,
                names,
                NOTHING,
                step,
            )?;
            let derivatives = (&reply.evaluated_derivatives[..], evaluate.directions.len());
            self.check_each(
                [
                    "directional derivatives of an evaluation",
                    "derivatives of evaluated outputs",
                ],
                derivatives,
                names,
                NOTHING,
                step,
            )?;
        }
        Ok(())
    }

    /// Checks that a list, which is called `list`, has as many entries as expected, and that each `entry` is whole and finite.
    fn check_each(
        &self,
        [list, entry]: [&'static str; 2],
        (found, expected): (&[v1::Outputs], usize),
        names: &[String],
        inside: Inside,
        step: MacroStep,
    ) -> Result<(), RunError> {
        if found.len() != expected {
            return Err(self.wrong_count(list, found.len(), expected, step));
        }
        for outputs in found {
            self.check((entry, names), &outputs.values, inside, step)?;
        }
        Ok(())
    }

    /// Checks that outputs are whole and finite: those with `names`, then what is told of the `inside` of the step.
    pub(super) fn check(
        &self,
        (what, names): (&'static str, &[String]),
        values: &[f64],
        inside: Inside,
        step: MacroStep,
    ) -> Result<(), RunError> {
        let integrals = inside.integrals as usize * self.integrated_names.len();
        let expected = names.len() + integrals + inside.instants * self.interior_names.len();
        if values.len() != expected {
            return Err(self.wrong_count(what, values.len(), expected, step));
        }
        match values.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(place) => Err(RunError::NotFinite {
                subsystem: self.name.clone(),
                variable: self.name_of(names, integrals, place),
                value: values[place],
                t: step.start,
                step: step.length,
            }),
        }
    }

    /// That there is an impulse for each multiplier of its joints, all finite.
    pub(crate) fn check_impulses(
        &self,
        impulses: &[f64],
        expected: usize,
        step: MacroStep,
    ) -> Result<(), RunError> {
        if impulses.len() != expected {
            let what = "impulses of multipliers in an impact";
            return Err(self.wrong_count(what, impulses.len(), expected, step));
        }
        match impulses.iter().find(|impulse| !impulse.is_finite()) {
            None => Ok(()),
            Some(impulse) => Err(RunError::NotFinite {
                subsystem: self.name.clone(),
                variable: "the impulse of a multiplier".to_owned(),
                value: *impulse,
                t: step.start,
                step: step.length,
            }),
        }
    }

    fn name_of(&self, names: &[String], integrals: usize, place: usize) -> String {
        if let Some(name) = names.get(place) {
            return name.clone();
        }
        let place = place - names.len();
        match place.checked_sub(integrals) {
            None => {
                let number = place / self.integrated_names.len();
                let name = &self.integrated_names[place % self.integrated_names.len()];
                format!("integral {number} of {name}")
            }
            Some(place) => {
                let name = self.interior_names.iter().cycle().nth(place);
                name.cloned().unwrap_or_default()
            }
        }
    }

    fn wrong_count(
        &self,
        what: &'static str,
        found: usize,
        expected: usize,
        step: MacroStep,
    ) -> RunError {
        RunError::WrongCount {
            subsystem: self.name.clone(),
            what,
            found,
            expected,
            t: step.start,
        }
    }
}

fn values(outputs: Option<&v1::Outputs>) -> &[f64] {
    outputs.map_or(&[], |outputs| &outputs.values)
}
