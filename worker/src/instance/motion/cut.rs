//! Steps that are cut at instants inside them, to tell outputs there, or because loads have impulses.
//!
//! A look-ahead and its perturbed ones go from instant to instant side by side: between two instants the perturbed ones repeat the
//! internal steps of the one that is not perturbed, from states of their own.

use linchpin_proto::exchange::{check_instants, is_until};
use linchpin_proto::v1::{self, Failure};

use super::look_ahead::{Horizon, Sequence};
use super::{Base, Motion, NOWHERE, outputs_of, tell};
use crate::{Impact, Interval, Snapshot};

/// A part of a step, from one instant to the next.
#[derive(Clone, Copy)]
struct Part<'a> {
    /// Its start, s after that of the step.
    from: f64,
    /// Its end, likewise.
    to: f64,
    /// What is there.
    at_end: AtEnd<'a>,
}

/// What is at the end of a part.
#[derive(Clone, Copy, PartialEq)]
enum AtEnd<'a> {
    /// The end of the step.
    Step,
    /// An instant, by its number.
    Instant(usize),
    /// Impulses, one for each input.
    Impact(&'a [f64]),
}

/// The parts of a step, one after the other.
struct Parts<'a> {
    length: f64,
    instants: &'a [f64],
    strikes: &'a [Impact],
    /// Instants and impacts so far.
    done: [usize; 2],
    from: f64,
    is_over: bool,
}

impl<'a> Parts<'a> {
    fn new(length: f64, instants: &'a [f64], strikes: &'a [Impact]) -> Self {
        Self {
            length,
            instants,
            strikes,
            done: [0; 2],
            from: 0.0,
            is_over: false,
        }
    }
}

impl<'a> Iterator for Parts<'a> {
    type Item = Part<'a>;

    /// Where both are at one time, outputs are told before the impact.
    fn next(&mut self) -> Option<Part<'a>> {
        if self.is_over {
            return None;
        }
        let [instants, strikes] = &mut self.done;
        let instant = self.instants.get(*instants).copied();
        let strike = self.strikes.get(*strikes);
        let strike = strike.filter(|strike| is_until(strike.at, self.length));
        let (to, at_end) = match (instant, strike) {
            (Some(instant), strike) if strike.is_none_or(|strike| instant <= strike.at) => {
                *instants += 1;
                (instant, AtEnd::Instant(*instants - 1))
            }
            (_, Some(strike)) => {
                *strikes += 1;
                (strike.at.min(self.length), AtEnd::Impact(&strike.loads))
            }
            (_, None) => {
                self.is_over = true;
                (self.length, AtEnd::Step)
            }
        };
        let from = std::mem::replace(&mut self.from, to);
        Some(Part { from, to, at_end })
    }
}

impl Motion {
    /// Steps over `interval` under the present signals, cut at `instants`, and reads outputs: those at its end, integrals, then interior
    /// ones.
    pub(super) fn step_cut(
        &mut self,
        (interval, instants): (Interval, &[f64]),
        outputs: v1::OutputSet,
        values: &mut Vec<f64>,
    ) -> Result<(), Failure> {
        check_instants(instants, interval.length)?;
        self.make_room(outputs, instants, values);
        self.integrations += 1;
        let strikes = std::mem::take(&mut self.treated.strikes);
        let done = Parts::new(interval.length, instants, &strikes).try_for_each(|part| {
            self.integrate_part(interval, part, Sequence::Own)?;
            self.end_part(interval, part, outputs, values)
        });
        self.treated.strikes = strikes;
        done?;
        self.newest += 1;
        self.stands_at = self.newest;
        Ok(())
    }

    /// Steps over `interval` under the present signals to where outputs are told that nobody waits for.
    pub(super) fn step_to_sample(&mut self, interval: Interval) -> Result<(), Failure> {
        let mut unread = std::mem::take(&mut self.unread);
        let done = self.step_cut((interval, &[]), v1::OutputSet::Coupling, &mut unread);
        self.unread = unread;
        done
    }

    fn make_room(&self, outputs: v1::OutputSet, instants: &[f64], values: &mut Vec<f64>) {
        let interior = instants.len() * self.interior_outputs.len();
        values.clear();
        let at_end = outputs_of(outputs, [&self.coupling_outputs, &self.all_outputs]);
        values.resize(at_end.len() + self.integrated.values() + interior, 0.0);
    }

    /// Coupling outputs at the horizon and interior outputs at `instants`, under the present signals and once more for every perturbed
    /// signal, in place of the present signal of its input. The committed state stays. Without `values` the step under the present
    /// signals is taken for its internal steps alone, which the others repeat.
    pub(in crate::instance) fn look_ahead_cut(
        &mut self,
        base: Base,
        (interval, instants): (Interval, &[f64]),
        perturbed: &[v1::Signal],
        (values, outputs): (Option<&mut Vec<f64>>, &mut Vec<v1::Outputs>),
    ) -> Result<(), Failure> {
        check_instants(instants, interval.length)?;
        outputs.resize_with(perturbed.len(), v1::Outputs::default);
        self.integrations += perturbed.len() as u64;
        let mut unread = std::mem::take(&mut self.unread);
        let values = match values {
            Some(values) => {
                self.integrations += 1;
                values
            }
            None => &mut unread,
        };
        self.make_room(v1::OutputSet::Coupling, instants, values);
        for outputs in &mut *outputs {
            self.make_room(v1::OutputSet::Coupling, instants, &mut outputs.values);
        }
        self.go_to(base)?;
        let mut under_way = std::mem::take(&mut self.under_way);
        under_way.resize_with(perturbed.len() + 1, Snapshot::default);
        self.begin_under_way(&mut under_way);
        let strikes = std::mem::take(&mut self.treated.strikes);
        let done = Parts::new(interval.length, instants, &strikes).try_for_each(|part| {
            self.look_over(interval, part, perturbed, &mut under_way, (values, outputs))
        });
        self.treated.strikes = strikes;
        (self.under_way, self.unread) = (under_way, unread);
        self.stands_at = NOWHERE;
        done
    }

    fn begin_under_way(&self, under_way: &mut [Snapshot]) {
        if let Some((first, others)) = under_way.split_first_mut() {
            first.clear();
            self.subsystem.snapshot(first);
            for other in others {
                other.copy_from(first);
            }
        }
    }

    /// Over one part of the step, first as it is, then with every perturbed signal.
    fn look_over(
        &mut self,
        interval: Interval,
        part: Part<'_>,
        perturbed: &[v1::Signal],
        under_way: &mut [Snapshot],
        (values, outputs): (&mut Vec<f64>, &mut [v1::Outputs]),
    ) -> Result<(), Failure> {
        for (number, state) in under_way.iter_mut().enumerate() {
            let signal = number.checked_sub(1).map(|number| &perturbed[number]);
            let (sequence, values) = match number.checked_sub(1) {
                None => (Sequence::Own, &mut *values),
                Some(number) => (Sequence::Repeated, &mut outputs[number].values),
            };
            self.stands_at = NOWHERE;
            let restored = self.subsystem.restore(state);
            restored.map_err(|failure| Failure::fatal(failure.to_string()))?;
            let replaced = signal
                .map(|signal| self.signals.replace(signal))
                .transpose()?;
            let done = self
                .integrate_part(interval, part, sequence)
                .and_then(|()| self.end_part(interval, part, v1::OutputSet::Coupling, values));
            if let Some(replaced) = replaced {
                self.signals.put_back(replaced);
            }
            done?;
            state.clear();
            self.subsystem.snapshot(state);
        }
        Ok(())
    }

    fn integrate_part(
        &mut self,
        interval: Interval,
        part: Part<'_>,
        sequence: Sequence,
    ) -> Result<(), Failure> {
        let own = Interval {
            start: interval.start + part.from,
            length: part.to - part.from,
        };
        // Impacts may be at the start, at the end or at one instant.
        if own.length <= 0.0 {
            return Ok(());
        }
        if sequence == Sequence::Own {
            self.begin_part([part.from, part.to])?;
        }
        let inputs = self.signals.inputs_from(part.from);
        self.stands_at = NOWHERE;
        self.last_step = None;
        let done = match sequence {
            Sequence::Own => self.subsystem.step(own, inputs),
            Sequence::Repeated => self.subsystem.perturbed_step(own, inputs),
        };
        done.map_err(|failure| tell(failure, interval.start, interval.length))?;
        if sequence == Sequence::Own {
            self.end_impacts_of_part(part.from);
        }
        Ok(())
    }

    /// Reads what is wanted at the end of a part to its place among `values`, adds the integrals over it, and lets velocities jump there.
    fn end_part(
        &mut self,
        interval: Interval,
        part: Part<'_>,
        at_end: v1::OutputSet,
        values: &mut [f64],
    ) -> Result<(), Failure> {
        let at_end = outputs_of(at_end, [&self.coupling_outputs, &self.all_outputs]);
        let interior = &self.interior_outputs;
        let integrals = at_end.len()..at_end.len() + self.integrated.values();
        let (wanted, first) = match part.at_end {
            AtEnd::Step => (at_end, 0),
            AtEnd::Instant(instant) => (&interior[..], integrals.end + instant * interior.len()),
            AtEnd::Impact(_) => (&interior[..0], 0),
        };
        if !matches!(part.at_end, AtEnd::Impact(_)) {
            let inputs = self.signals.values_at(part.to);
            let told = &mut values[first..first + wanted.len()];
            self.subsystem
                .outputs(interval.start + part.to, inputs, wanted, told)
                .map_err(|failure| tell(failure, interval.start, interval.length))?;
        }
        if part.to > part.from {
            let integrals = &mut values[integrals];
            self.add_integrals_of_part(interval, [part.from, part.to], integrals)?;
        }
        match part.at_end {
            AtEnd::Impact(impulses) => self.strike(interval, part.to, impulses),
            AtEnd::Step | AtEnd::Instant(_) => Ok(()),
        }
    }

    /// Derivatives at the horizon, of integrals, and at the instants, one for each direction. They are those of steps from the start to each instant.
    pub(in crate::instance) fn look_in_directions_cut(
        &mut self,
        base: Base,
        (interval, instants): (Interval, &[f64]),
        directions: &[v1::Signal],
        outputs: &mut Vec<v1::Outputs>,
    ) -> Result<(), Failure> {
        let whole = Horizon::Step(interval);
        self.look_ahead_in_directions(base, whole, directions, None, outputs)?;
        let interior = std::mem::take(&mut self.interior_outputs);
        let mut at_instant = std::mem::take(&mut self.at_instant);
        let mut done = Ok(());
        for &length in instants {
            let shorter = Horizon::Step(Interval { length, ..interval });
            let counted = self.derivatives;
            let wanted = Some(&interior[..]);
            done =
                self.look_ahead_in_directions(base, shorter, directions, wanted, &mut at_instant);
            if done.is_err() {
                break;
            }
            self.derivatives = counted;
            for (outputs, own) in outputs.iter_mut().zip(&at_instant) {
                outputs.values.extend_from_slice(&own.values);
            }
        }
        (self.interior_outputs, self.at_instant) = (interior, at_instant);
        done
    }
}
