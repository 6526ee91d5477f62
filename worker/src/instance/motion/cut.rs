//! Steps that are cut at instants inside them.
//!
//! A look-ahead and its perturbed ones go from instant to instant side by side: between two instants the perturbed ones repeat the
//! internal steps of the one that is not perturbed, from states of their own.

use linchpin_proto::exchange::check_instants;
use linchpin_proto::v1::{self, Failure};

use super::look_ahead::{Horizon, Sequence};
use super::{Base, Motion, NOWHERE, outputs_of, tell};
use crate::{Interval, Snapshot};

/// A part of a step, from one instant to the next.
#[derive(Clone, Copy)]
struct Part {
    /// Its start, s after that of the step.
    from: f64,
    /// Its end, likewise.
    to: f64,
    /// Number of the instant at its end; absent at the end of the step.
    instant: Option<usize>,
}

fn parts(length: f64, instants: &[f64]) -> impl Iterator<Item = Part> {
    let starts = std::iter::once(0.0).chain(instants.iter().copied());
    let ends = instants.iter().copied().chain([length]);
    starts
        .zip(ends)
        .enumerate()
        .map(|(number, (from, to))| Part {
            from,
            to,
            instant: (number < instants.len()).then_some(number),
        })
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
        for part in parts(interval.length, instants) {
            self.integrate_part(interval, part, Sequence::Own)?;
            self.read_part(interval, part, outputs, values)?;
        }
        self.newest += 1;
        self.stands_at = self.newest;
        Ok(())
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
        let mut done = Ok(());
        for part in parts(interval.length, instants) {
            done = self.look_over(interval, part, perturbed, &mut under_way, (values, outputs));
            if done.is_err() {
                break;
            }
        }
        (self.under_way, self.unread) = (under_way, unread);
        self.stands_at = NOWHERE;
        done
    }

    fn begin_under_way(&self, under_way: &mut [Snapshot]) {
        if let Some((first, others)) = under_way.split_first_mut() {
            first.clear();
            self.subsystem.snapshot(first);
            for other in others {
                other.clear();
                other.put_bytes(first.bytes());
            }
        }
    }

    /// Over one part of the step, first as it is, then with every perturbed signal.
    fn look_over(
        &mut self,
        interval: Interval,
        part: Part,
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
                .and_then(|()| self.read_part(interval, part, v1::OutputSet::Coupling, values));
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
        part: Part,
        sequence: Sequence,
    ) -> Result<(), Failure> {
        let own = Interval {
            start: interval.start + part.from,
            length: part.to - part.from,
        };
        let inputs = self.signals.inputs_from(part.from);
        self.stands_at = NOWHERE;
        self.last_step = None;
        let done = match sequence {
            Sequence::Own => self.subsystem.step(own, inputs),
            Sequence::Repeated => self.subsystem.perturbed_step(own, inputs),
        };
        done.map_err(|failure| tell(failure, interval.start, interval.length))
    }

    /// Reads what is wanted at the end of a part to its place among `values`, and adds the integrals over it.
    fn read_part(
        &mut self,
        interval: Interval,
        part: Part,
        at_end: v1::OutputSet,
        values: &mut [f64],
    ) -> Result<(), Failure> {
        let at_end = outputs_of(at_end, [&self.coupling_outputs, &self.all_outputs]);
        let interior = &self.interior_outputs;
        let integrals = at_end.len()..at_end.len() + self.integrated.values();
        let (wanted, first) = match part.instant {
            None => (at_end, 0),
            Some(instant) => (&interior[..], integrals.end + instant * interior.len()),
        };
        let inputs = self.signals.values_at(part.to);
        let told = &mut values[first..first + wanted.len()];
        self.subsystem
            .outputs(interval.start + part.to, inputs, wanted, told)
            .map_err(|failure| tell(failure, interval.start, interval.length))?;
        self.add_integrals_of_part(interval, [part.from, part.to], &mut values[integrals])
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
