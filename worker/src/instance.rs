//! One instance: a subsystem with its place in the sequence of calls.

mod exchange;
mod motion;
mod signals;
mod snapshots;

use linchpin_proto::exchange::other_content;
use linchpin_proto::v1::{self, Failure};
use prost::Message;

use crate::{Cancel, Subsystem};
use motion::{Base, Horizon, Inside, Meter, Motion, Sequence, interval};
use snapshots::Snapshots;

pub(crate) use signals::{Signals, find};

/// A subsystem that is being driven by a master.
///
/// It has one state: that of the start, of the last Step, Restore or ImportState, or of the last advance of an exchange, which can be
/// taken back. A call that fails leaves it as it was; one that is cancelled has not been.
pub struct Instance {
    motion: Motion,
    snapshots: Snapshots,
    model: String,
    /// Whether its states can leave the process.
    exports: bool,
    initialized: v1::InitializeReply,
    sequence: u64,
    /// The last request, encoded.
    asked: Vec<u8>,
    answer: Answer,
    exchanged: v1::ExchangeReply,
    /// Memory of answers with more impacts.
    spare: Vec<v1::Impact>,
}

/// The answer to the last sequence number, given again when the number is repeated.
enum Answer {
    Initialize,
    Snapshot(Result<v1::SnapshotReply, Failure>),
    Restore(Result<v1::RestoreReply, Failure>),
    ImportState(Result<v1::ImportStateReply, Failure>),
    Step(Result<v1::StepReply, Failure>),
    PerturbedStep(Result<v1::PerturbedStepReply, Failure>),
    Exchange(Result<(), Failure>),
}

impl Instance {
    /// Wraps `subsystem`, which is in its initial state and sees `signals`.
    pub(crate) fn new(
        subsystem: Box<dyn Subsystem>,
        signals: Signals,
        model: &v1::Model,
        request: &v1::InitializeRequest,
        most_snapshots: usize,
    ) -> Result<Self, Failure> {
        let initialized = v1::InitializeReply {
            tolerance: subsystem.tolerance(),
            ..v1::InitializeReply::default()
        };
        Ok(Self {
            motion: Motion::new(subsystem, signals, model, request)?,
            snapshots: Snapshots::new(most_snapshots),
            model: model.name.clone(),
            exports: model
                .capabilities
                .is_some_and(|own| own.exportable_snapshot),
            initialized,
            sequence: request.sequence,
            asked: Vec::new(),
            answer: Answer::Initialize,
            exchanged: v1::ExchangeReply::default(),
            spare: Vec::new(),
        })
    }

    /// The answer to Initialize.
    pub(crate) fn initialized(&self) -> v1::InitializeReply {
        self.initialized
    }

    /// The number of the last call that was answered.
    pub(crate) fn sequence(&self) -> u64 {
        self.sequence
    }

    /// Whether no call that has a sequence number came after Initialize.
    pub(crate) fn is_new(&self) -> bool {
        matches!(self.answer, Answer::Initialize)
    }

    pub(crate) fn snapshot(
        &mut self,
        request: &v1::SnapshotRequest,
    ) -> Result<v1::SnapshotReply, Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::Snapshot(answer) => {
                    self.same("Snapshot", request).and_then(|()| answer.clone())
                }
                other => Err(other.belongs_not_to("Snapshot")),
            };
        }
        let kept = self
            .snapshots
            .keep(self.motion.committed(), request.replaces);
        let answer = kept.map(|snapshot| v1::SnapshotReply {
            snapshot,
            ..v1::SnapshotReply::default()
        });
        self.settle(request, Answer::Snapshot(answer.clone()));
        answer
    }

    pub(crate) fn restore(
        &mut self,
        request: &v1::RestoreRequest,
    ) -> Result<v1::RestoreReply, Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::Restore(answer) => {
                    self.same("Restore", request).and_then(|()| answer.clone())
                }
                other => Err(other.belongs_not_to("Restore")),
            };
        }
        let kept = self.snapshots.find(request.snapshot);
        let answer = kept
            .and_then(|kept| self.motion.restore(kept))
            .map(|()| v1::RestoreReply::default());
        self.settle(request, Answer::Restore(answer.clone()));
        answer
    }

    /// The committed state as bytes.
    pub(crate) fn export(&mut self) -> Result<v1::ExportStateReply, Failure> {
        let writer = self.writer()?;
        let state = self.motion.export()?;
        Ok(v1::ExportStateReply {
            state: Some(v1::ExportedState::sealed(&self.model, writer, state)),
            ..v1::ExportStateReply::default()
        })
    }

    pub(crate) fn import(
        &mut self,
        request: &v1::ImportStateRequest,
    ) -> Result<v1::ImportStateReply, Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::ImportState(answer) => self
                    .same("ImportState", request)
                    .and_then(|()| answer.clone()),
                other => Err(other.belongs_not_to("ImportState")),
            };
        }
        let imported = self.take_exported(request.state.as_ref());
        let answer = imported.map(|()| v1::ImportStateReply::default());
        self.settle(request, Answer::ImportState(answer.clone()));
        answer
    }

    fn take_exported(&mut self, state: Option<&v1::ExportedState>) -> Result<(), Failure> {
        let writer = self.writer()?;
        let state = state.ok_or_else(|| {
            Failure::misuse("state", "there is no state; send one of ExportState")
        })?;
        state.check(&self.model, writer)?;
        self.motion.import(&state.state)
    }

    /// Program and version, if its states can leave the process.
    fn writer(&self) -> Result<&'static str, Failure> {
        match self.exports {
            true => Ok(concat!("linchpin ", env!("CARGO_PKG_VERSION"))),
            false => Err(Failure::misuse(
                "state",
                format!(
                    "the states of model \"{}\" cannot leave their process: its capabilities do not say exportable_snapshot",
                    self.model
                ),
            )),
        }
    }

    pub(crate) fn step(&mut self, request: &v1::StepRequest) -> Result<v1::StepReply, Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::Step(answer) => self.same("Step", request).and_then(|()| answer.clone()),
                other => Err(other.belongs_not_to("Step")),
            };
        }
        let answer = self.plain_step(request);
        self.settle(request, Answer::Step(answer.clone()));
        answer
    }

    fn plain_step(&mut self, request: &v1::StepRequest) -> Result<v1::StepReply, Failure> {
        let mut meter = Meter::start(&self.motion);
        let interval = interval(request.t, request.step)?;
        let mut outputs = v1::Outputs::default();
        let inside = Inside {
            instants: &request.instants,
            integrals: request.integrals,
        };
        self.motion.treat_impacts(
            request.step,
            request.impacts.as_ref(),
            request.interface.as_ref(),
        )?;
        self.motion.advance(
            (interval, inside),
            &request.signals,
            request.outputs(),
            &mut outputs.values,
        )?;
        meter.look_at_contacts(&self.motion);
        let mut impacts = None;
        self.motion.tell_impacts(&request.instants, &mut impacts);
        self.motion.commit();
        Ok(v1::StepReply {
            outputs: Some(outputs),
            work: Some(meter.stop(&self.motion)),
            impacts,
            ..v1::StepReply::default()
        })
    }

    pub(crate) fn perturbed_step(
        &mut self,
        request: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, Failure> {
        if self.is_repeated(request.sequence)? {
            return match &self.answer {
                Answer::PerturbedStep(answer) => self
                    .same("PerturbedStep", request)
                    .and_then(|()| answer.clone()),
                other => Err(other.belongs_not_to("PerturbedStep")),
            };
        }
        let answer = self.perturbed_steps(request);
        self.settle(request, Answer::PerturbedStep(answer.clone()));
        answer
    }

    fn perturbed_steps(
        &mut self,
        request: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, Failure> {
        let meter = Meter::start(&self.motion);
        let interval = interval(request.t, request.step)?;
        let (mut outputs, mut derivatives) = (Vec::new(), Vec::new());
        self.motion.set_signals(&request.signals)?;
        self.motion.integrate_outputs(request.integrals)?;
        self.motion.treat_impacts(
            request.step,
            request.impacts.as_ref(),
            request.interface.as_ref(),
        )?;
        match self.motion.is_cut(&request.instants) {
            false => self.motion.look_ahead_perturbed(
                Base::Committed,
                Horizon::Step(interval),
                &request.perturbed,
                &mut outputs,
            )?,
            true => self.motion.look_ahead_cut(
                Base::Committed,
                (interval, &request.instants),
                &request.perturbed,
                (None, &mut outputs),
            )?,
        }
        self.motion.look_in_directions_cut(
            Base::Committed,
            (interval, &request.instants),
            &request.directions,
            &mut derivatives,
        )?;
        Ok(v1::PerturbedStepReply {
            outputs,
            work: Some(meter.stop(&self.motion)),
            derivatives,
            ..v1::PerturbedStepReply::default()
        })
    }

    pub(crate) fn evaluate(
        &mut self,
        request: &v1::EvaluateRequest,
    ) -> Result<v1::EvaluateReply, Failure> {
        self.motion.evaluate(request)
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

    /// That a request with the last sequence number is the last request.
    fn same(&self, call: &str, request: &impl Message) -> Result<(), Failure> {
        match request.encode_to_vec() == self.asked {
            true => Ok(()),
            false => Err(other_content(call, self.sequence)),
        }
    }

    /// Keeps an answer for when its number is repeated. There is none of a call that failed while nobody waited for it: the same
    /// request may come again.
    fn settle(&mut self, request: &impl Message, answer: Answer) {
        if answer.is_failed() && Cancel::current().is_requested() {
            return;
        }
        self.sequence = self.sequence.wrapping_add(1);
        self.asked.clear();
        // A Vec takes a message of any length.
        let _ = request.encode(&mut self.asked);
        self.answer = answer;
    }
}

impl Answer {
    fn is_failed(&self) -> bool {
        match self {
            Self::Initialize => false,
            Self::Snapshot(answer) => answer.is_err(),
            Self::Restore(answer) => answer.is_err(),
            Self::ImportState(answer) => answer.is_err(),
            Self::Step(answer) => answer.is_err(),
            Self::PerturbedStep(answer) => answer.is_err(),
            Self::Exchange(answer) => answer.is_err(),
        }
    }

    fn belongs_not_to(&self, call: &str) -> Failure {
        let own = match self {
            Self::Initialize => "Initialize",
            Self::Snapshot(_) => "Snapshot",
            Self::Restore(_) => "Restore",
            Self::ImportState(_) => "ImportState",
            Self::Step(_) => "Step",
            Self::PerturbedStep(_) => "PerturbedStep",
            Self::Exchange(_) => "Exchange",
        };
        Failure::misuse(
            "sequence",
            format!("{call} has the sequence number of the {own} before it; add 1 to it"),
        )
    }
}
