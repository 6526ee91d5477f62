//! One instance: a subsystem with its place in the sequence of calls.

mod exchange;
mod signals;

use std::collections::BTreeMap;
use std::time::Instant;

use linchpin_proto::v1::{self, Failure};

use crate::{Inputs, Interval, Snapshot, StepFailure, Subsystem};
use signals::{Signals, find};

/// A subsystem that is being driven by a master.
pub struct Instance {
    subsystem: Box<dyn Subsystem>,
    signals: Signals,
    coupling_outputs: Vec<usize>,
    all_outputs: Vec<usize>,
    output_names: Vec<String>,
    state: StateNumber,
    newest_state: StateNumber,
    last_step: Option<(Interval, StateNumber)>,
    committed: Kept,
    advanced: Kept,
    kept: BTreeMap<u64, Kept>,
    kept_ever: u64,
    most_kept: usize,
    sequence: u64,
    answer: Answer,
    exchanged: v1::ExchangeReply,
    integrations: u64,
}

/// Every state that the subsystem reaches gets a number, so that a step is known to start where another did.
type StateNumber = u64;

#[derive(Default)]
struct Kept {
    state: StateNumber,
    snapshot: Snapshot,
}

/// The answer to the last sequence number, given again when the number is repeated.
enum Answer {
    Initialized,
    Snapshot(v1::SnapshotReply),
    Restore,
    Step(v1::StepReply),
    PerturbedStep(v1::PerturbedStepReply),
    Exchange,
    Failed(Failure),
}

impl Instance {
    /// Wraps `subsystem`, which is in its initial state.
    pub(crate) fn new(
        subsystem: Box<dyn Subsystem>,
        model: &v1::Model,
        request: &v1::InitializeRequest,
        most_kept: usize,
    ) -> Result<Self, Failure> {
        let coupling_outputs = find(
            &model.outputs,
            &request.coupling_outputs,
            "coupling_outputs",
        )?;
        let recorded = find(
            &model.outputs,
            &request.recorded_outputs,
            "recorded_outputs",
        )?;
        let mut all_outputs = coupling_outputs.clone();
        all_outputs.extend(recorded);
        let mut instance = Self {
            signals: Signals::new(&model.inputs, &request.inputs)?,
            subsystem,
            coupling_outputs,
            all_outputs,
            output_names: model
                .outputs
                .iter()
                .map(|output| output.name.clone())
                .collect(),
            state: 0,
            newest_state: 0,
            last_step: None,
            committed: Kept::default(),
            advanced: Kept::default(),
            kept: BTreeMap::new(),
            kept_ever: 0,
            most_kept,
            sequence: request.sequence,
            answer: Answer::Initialized,
            exchanged: v1::ExchangeReply::default(),
            integrations: 0,
        };
        instance
            .subsystem
            .snapshot(&mut instance.committed.snapshot);
        Ok(instance)
    }

    pub(crate) fn initialized(&self) -> v1::InitializeReply {
        v1::InitializeReply {
            tolerance: self.subsystem.tolerance(),
        }
    }

    pub(crate) fn snapshot(
        &mut self,
        request: &v1::SnapshotRequest,
    ) -> Result<v1::SnapshotReply, Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::Snapshot(reply) => Ok(*reply),
                other => Err(other.to_another_call("Snapshot")),
            };
        }
        let reply = self.keep_state(request.replaces);
        self.settle(reply, |reply| Answer::Snapshot(*reply))
    }

    pub(crate) fn restore(
        &mut self,
        request: &v1::RestoreRequest,
    ) -> Result<v1::RestoreReply, Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::Restore => Ok(v1::RestoreReply {}),
                other => Err(other.to_another_call("Restore")),
            };
        }
        let restored = match self.kept.get(&request.snapshot) {
            Some(kept) => go_back(&mut *self.subsystem, &mut self.state, kept),
            None => Err(Failure::misuse(
                "snapshot",
                format!(
                    "there is no snapshot {}; it was never taken or was replaced",
                    request.snapshot
                ),
            )),
        };
        self.settle(restored.map(|()| v1::RestoreReply {}), |_| Answer::Restore)
    }

    pub(crate) fn step(&mut self, request: &v1::StepRequest) -> Result<v1::StepReply, Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::Step(reply) => Ok(reply.clone()),
                other => Err(other.to_another_call("Step")),
            };
        }
        let reply = self.plain_step(request);
        self.settle(reply, |reply| Answer::Step(reply.clone()))
    }

    fn plain_step(&mut self, request: &v1::StepRequest) -> Result<v1::StepReply, Failure> {
        let meter = Meter::start(self);
        let interval = interval(request.t, request.step)?;
        let mut outputs = v1::Outputs::default();
        self.signals.set(&request.signals)?;
        self.integrate(interval, Sequence::Own)?;
        self.read(interval, request.outputs(), &mut outputs.values)?;
        Ok(v1::StepReply {
            outputs: Some(outputs),
            work: Some(meter.stop(self)),
        })
    }

    pub(crate) fn perturbed_step(
        &mut self,
        request: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::PerturbedStep(reply) => Ok(reply.clone()),
                other => Err(other.to_another_call("PerturbedStep")),
            };
        }
        let reply = self.perturbed_steps(request);
        self.settle(reply, |reply| Answer::PerturbedStep(reply.clone()))
    }

    fn perturbed_steps(
        &mut self,
        request: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, Failure> {
        let meter = Meter::start(self);
        let interval = interval(request.t, request.step)?;
        let mut here = Kept {
            state: self.state,
            snapshot: Snapshot::default(),
        };
        self.subsystem.snapshot(&mut here.snapshot);
        self.signals.set(&request.signals)?;
        let mut outputs = vec![v1::Outputs::default(); request.perturbed.len()];
        let done = request
            .perturbed
            .iter()
            .zip(&mut outputs)
            .try_for_each(|(signal, outputs)| {
                let replaced = self.signals.replace(signal)?;
                let done = self.integrate(interval, Sequence::Repeated).and_then(|()| {
                    self.read(interval, v1::OutputSet::Coupling, &mut outputs.values)
                });
                self.signals.put_back(replaced);
                go_back(&mut *self.subsystem, &mut self.state, &here)?;
                done
            });
        done?;
        Ok(v1::PerturbedStepReply {
            outputs,
            work: Some(meter.stop(self)),
        })
    }

    pub(crate) fn evaluate(
        &mut self,
        request: &v1::EvaluateRequest,
    ) -> Result<v1::EvaluateReply, Failure> {
        let mut wanted = Vec::with_capacity(request.outputs.len());
        for name in &request.outputs {
            let place = self.output_names.iter().position(|output| output == name);
            wanted.push(place.ok_or_else(|| {
                Failure::misuse(
                    "outputs",
                    format!(
                        "no output \"{name}\"; this model has: {}",
                        self.output_names.join(", ")
                    ),
                )
            })?);
        }
        self.signals.set(&request.signals)?;
        let mut values = vec![0.0; wanted.len()];
        let inputs = self.signals.values_at(0.0);
        self.subsystem
            .outputs(request.t, inputs, &wanted, &mut values)
            .map_err(|failure| tell(failure, request.t, 0.0))?;
        Ok(v1::EvaluateReply {
            outputs: Some(v1::Outputs { values }),
        })
    }

    /// Whether this call was answered before; refuses numbers that are neither the last nor the next.
    fn is_repeated(&self, sequence: u64) -> Result<bool, Failure> {
        if sequence == self.sequence {
            return Ok(true);
        }
        if sequence == self.sequence.wrapping_add(1) {
            return Ok(false);
        }
        Err(Failure::misuse(
            "sequence",
            format!(
                "sequence number {sequence} came after {}; the next one is {}",
                self.sequence,
                self.sequence.wrapping_add(1)
            ),
        ))
    }

    fn settle<T>(
        &mut self,
        result: Result<T, Failure>,
        answer: impl FnOnce(&T) -> Answer,
    ) -> Result<T, Failure> {
        self.sequence = self.sequence.wrapping_add(1);
        self.answer = match &result {
            Ok(reply) => answer(reply),
            Err(failure) => Answer::Failed(failure.clone()),
        };
        result
    }

    fn keep_state(&mut self, replaces: Option<u64>) -> Result<v1::SnapshotReply, Failure> {
        let mut kept = replaces
            .and_then(|old| self.kept.remove(&old))
            .unwrap_or_default();
        if self.kept.len() >= self.most_kept {
            return Err(Failure::fatal(format!(
                "{} snapshots are kept, which is the limit; name one that can go in Snapshot.replaces",
                self.kept.len()
            )));
        }
        kept.snapshot.clear();
        self.subsystem.snapshot(&mut kept.snapshot);
        kept.state = self.state;
        self.kept_ever += 1;
        self.kept.insert(self.kept_ever, kept);
        Ok(v1::SnapshotReply {
            snapshot: self.kept_ever,
        })
    }

    /// Steps under the present signals.
    fn integrate(&mut self, interval: Interval, sequence: Sequence) -> Result<(), Failure> {
        let start = self.state;
        self.newest_state += 1;
        self.state = self.newest_state;
        self.integrations += 1;
        let inputs: &Inputs = self.signals.inputs();
        let done = match sequence {
            Sequence::Repeated if self.last_step == Some((interval, start)) => {
                self.subsystem.perturbed_step(interval, inputs)
            }
            _ => {
                self.last_step = Some((interval, start));
                self.subsystem.step(interval, inputs)
            }
        };
        done.map_err(|failure| tell(failure, interval.start, interval.length))
    }

    /// Reads outputs at the end of `interval` under the present signals.
    fn read(
        &mut self,
        interval: Interval,
        set: v1::OutputSet,
        values: &mut Vec<f64>,
    ) -> Result<(), Failure> {
        let wanted = match set {
            v1::OutputSet::Coupling => &self.coupling_outputs,
            v1::OutputSet::All => &self.all_outputs,
        };
        values.clear();
        values.resize(wanted.len(), 0.0);
        let inputs = self.signals.values_at(interval.length);
        self.subsystem
            .outputs(interval.end(), inputs, wanted, values)
            .map_err(|failure| tell(failure, interval.start, interval.length))
    }
}

/// Which internal steps the solver takes.
#[derive(Clone, Copy, PartialEq)]
enum Sequence {
    Own,
    Repeated,
}

impl Answer {
    fn to_another_call(&self, call: &str) -> Failure {
        match self {
            Self::Failed(failure) => failure.clone(),
            _ => Failure::misuse(
                "sequence",
                format!("{call} repeats a sequence number that belonged to another call"),
            ),
        }
    }
}

fn go_back(
    subsystem: &mut dyn Subsystem,
    state: &mut StateNumber,
    kept: &Kept,
) -> Result<(), Failure> {
    subsystem
        .restore(&kept.snapshot)
        .map_err(|failure| Failure::fatal(failure.to_string()))?;
    *state = kept.state;
    Ok(())
}

fn interval(start: f64, length: f64) -> Result<Interval, Failure> {
    if start.is_finite() && length.is_finite() && length > 0.0 {
        return Ok(Interval { start, length });
    }
    Err(Failure::misuse(
        "step",
        format!(
            "a step from t = {start} s over {length} s: both must be finite, the length greater than 0"
        ),
    ))
}

fn tell(failure: StepFailure, t: f64, step: f64) -> Failure {
    match &failure {
        StepFailure::Recoverable { t, .. } => Failure::recoverable(*t, step, failure.to_string()),
        StepFailure::Fatal { message } => Failure {
            t: Some(t),
            step: Some(step),
            ..Failure::fatal(message.clone())
        },
    }
}

/// Counts what one call costs.
struct Meter {
    started: Instant,
    integrations: u64,
    steps: u64,
}

impl Meter {
    fn start(instance: &Instance) -> Self {
        Self {
            started: Instant::now(),
            integrations: instance.integrations,
            steps: instance.subsystem.internal_steps(),
        }
    }

    fn stop(self, instance: &Instance) -> v1::Work {
        v1::Work {
            integrations: instance.integrations - self.integrations,
            steps: instance.subsystem.internal_steps() - self.steps,
            nanoseconds: u64::try_from(self.started.elapsed().as_nanos()).unwrap_or(u64::MAX),
        }
    }
}
