//! Faults of a worker in how it keeps to the contract, around a sound one.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{self, Failure};

use super::replies;

/// What is wrong with the worker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    None,
    // Sequence numbers.
    RepeatedStepsTwice,
    AnswersOtherContent,
    TakesAnyNumber,
    SnapshotPerRepeat,
    // Snapshots.
    OneSnapshot,
    // States that leave.
    ImportsNothing,
    ImportsDamaged,
    // Wrong requests.
    TakesUnknownOutputs,
    TakesNaN,
    CutsHighDegrees,
    TakesZeroSteps,
    DiesOfRefusals,
    RefusesAsFatal,
    // Lists of outputs.
    OwnOrderOfOutputs,
    ForgetsAnOutput,
    // Perturbed steps and directions.
    PerturbsTheNeighbour,
    PerturbedBackwards,
    DerivativesTimesStep,
    DirectionsAreConstant,
    NoFeedthrough,
    // Inside a step.
    InteriorInterpolated,
    InteriorByOutput,
    InstantsFromTheEnd,
    IntegralsTimesStep,
    IntegralsNotFromZero,
    IntegralsWrongWeight,
    // Joint loads.
    JointLoadOtherEnd,
    JointLoadWithoutMoment,
    // Exchange.
    PredictionMoves,
    KeepsNoWayBack,
    PerturbedMissing,
    EvaluatesLater,
    SamplesAtTheEnd,
    // Instances.
    OneInstancePerStream,
    MixesInstances,
    // Description.
    ZeroTolerance,
    LongMarker,
    TwiceTheName,
    // Ends.
    HangsInRestore,
}

/// A worker with a fault.
pub struct Faulty {
    inner: Arc<dyn Contract>,
    fault: Fault,
    memory: Mutex<Memory>,
}

/// What the fault needs to know.
#[derive(Default)]
pub struct Memory {
    /// Sequence number that the sound worker has reached, by instance.
    sequences: BTreeMap<u64, u64>,
    /// The last step of each instance, with its answer.
    steps: BTreeMap<u64, (u64, v1::StepReply)>,
    /// The newest snapshot of each instance.
    newest: BTreeMap<u64, u64>,
    /// How each instance was made.
    made: BTreeMap<u64, v1::InitializeRequest>,
    /// The first instance of an exchange.
    first: Option<u64>,
    /// The last values of a step.
    last: Vec<f64>,
}

impl Faulty {
    pub fn new(inner: Arc<dyn Contract>, fault: Fault) -> Self {
        Self {
            inner,
            fault,
            memory: Mutex::default(),
        }
    }

    fn made(&self, instance: u64) -> v1::InitializeRequest {
        self.memory.lock().unwrap().made[&instance].clone()
    }

    /// The number that the sound worker expects, where the fault counts for itself.
    fn number(&self, instance: u64, asked: u64) -> u64 {
        let mut memory = self.memory.lock().unwrap();
        let counted = memory.sequences.get(&instance).copied().unwrap_or(asked);
        let next = match self.fault {
            Fault::RepeatedStepsTwice if asked <= counted + 2 => counted + 1,
            Fault::TakesAnyNumber | Fault::PredictionMoves => counted + 1,
            Fault::SnapshotPerRepeat => counted + 1,
            _ => asked,
        };
        memory.sequences.insert(instance, next);
        next
    }

    fn wrong_signals(&self, signals: &mut [v1::Signal], step: f64) {
        for signal in signals.iter_mut() {
            match self.fault {
                Fault::TakesNaN => signal
                    .values
                    .iter_mut()
                    .filter(|own| own.is_nan())
                    .for_each(|own| *own = 0.0),
                Fault::CutsHighDegrees => {
                    signal.nodes.truncate(8);
                    signal.values.truncate(8);
                }
                Fault::PerturbsTheNeighbour => signal.input = (signal.input + 1) % 6,
                Fault::DirectionsAreConstant => {
                    signal.values = vec![1.0];
                    signal.nodes = vec![step];
                }
                _ => {}
            }
        }
    }

    /// A failure as the fault has it.
    fn refused<T>(&self, instance: u64, answer: Result<T, CallError>) -> Result<T, CallError> {
        match (self.fault, answer) {
            (Fault::DiesOfRefusals, Err(error)) => {
                self.inner.terminate(&v1::TerminateRequest { instance })?;
                Err(error)
            }
            (Fault::RefusesAsFatal, Err(CallError::Failed(failure))) => {
                Err(Failure::fatal(failure.message).into())
            }
            (_, answer) => answer,
        }
    }
}

impl Contract for Faulty {
    fn describe(&self, request: &v1::DescribeRequest) -> Result<v1::DescribeReply, CallError> {
        let mut reply = self.inner.describe(request)?;
        for model in &mut reply.models {
            let [first, second, ..] = &mut model.markers[..] else {
                continue;
            };
            match self.fault {
                Fault::LongMarker => first.load.push("end_moment".into()),
                Fault::TwiceTheName => second.name = first.name.clone(),
                _ => {}
            }
        }
        Ok(reply)
    }

    fn initialize(
        &self,
        request: &v1::InitializeRequest,
    ) -> Result<v1::InitializeReply, CallError> {
        let mut changed = request.clone();
        for load in &mut changed.joint_loads {
            match self.fault {
                Fault::JointLoadOtherEnd => load.end = 3 - load.end,
                Fault::JointLoadWithoutMoment => {
                    (load.point_a, load.point_b) = (vec![0.0; 3], vec![0.0; 3]);
                }
                _ => {}
            }
        }
        if self.fault == Fault::OwnOrderOfOutputs {
            changed.coupling_outputs.sort();
        }
        let mut reply = self.refused(request.instance, self.inner.initialize(&changed))?;
        let mut memory = self.memory.lock().unwrap();
        memory.sequences.insert(request.instance, request.sequence);
        memory.made.insert(request.instance, request.clone());
        if self.fault == Fault::ZeroTolerance {
            reply.tolerance = Some(0.0);
        }
        Ok(reply)
    }

    fn snapshot(&self, request: &v1::SnapshotRequest) -> Result<v1::SnapshotReply, CallError> {
        let sequence = self.number(request.instance, request.sequence);
        let reply = self.inner.snapshot(&v1::SnapshotRequest {
            sequence,
            ..*request
        })?;
        self.memory
            .lock()
            .unwrap()
            .newest
            .insert(request.instance, reply.snapshot);
        Ok(reply)
    }

    fn restore(&self, request: &v1::RestoreRequest) -> Result<v1::RestoreReply, CallError> {
        let sequence = self.number(request.instance, request.sequence);
        let mut snapshot = request.snapshot;
        match self.fault {
            Fault::OneSnapshot if snapshot != u64::MAX => {
                snapshot = self.memory.lock().unwrap().newest[&request.instance];
            }
            Fault::HangsInRestore => std::thread::sleep(std::time::Duration::from_secs(3)),
            _ => {}
        }
        let request = v1::RestoreRequest {
            sequence,
            snapshot,
            ..*request
        };
        self.refused(request.instance, self.inner.restore(&request))
    }

    fn step(&self, request: &v1::StepRequest) -> Result<v1::StepReply, CallError> {
        let mut changed = request.clone();
        match self.fault {
            Fault::AnswersOtherContent => {
                let memory = self.memory.lock().unwrap();
                if let Some((sequence, reply)) = memory.steps.get(&request.instance)
                    && *sequence == request.sequence
                {
                    return Ok(reply.clone());
                }
            }
            Fault::TakesZeroSteps if request.step == 0.0 => changed.step = 1e-12,
            Fault::InstantsFromTheEnd => {
                changed.instants = request
                    .instants
                    .iter()
                    .rev()
                    .map(|own| request.step - own)
                    .collect();
            }
            Fault::MixesInstances => {
                let mut memory = self.memory.lock().unwrap();
                let first = *memory.first.get_or_insert(request.instance);
                let others = memory.sequences.len() as f64;
                if request.instance != first
                    && let Some(value) = changed
                        .signals
                        .first_mut()
                        .and_then(|own| own.values.first_mut())
                {
                    *value += 1e-3 * others;
                }
            }
            _ => {}
        }
        let step = request.step;
        if matches!(self.fault, Fault::TakesNaN | Fault::CutsHighDegrees) {
            self.wrong_signals(&mut changed.signals, step);
        }
        changed.sequence = self.number(request.instance, request.sequence);
        let mut reply = self.refused(request.instance, self.inner.step(&changed))?;
        reply.sequence = Some(request.sequence);
        let values = &mut reply.outputs.get_or_insert_default().values;
        let count = self.made(request.instance).coupling_outputs.len();
        let mut memory = self.memory.lock().unwrap();
        replies::wrong_step(self.fault, request, (count, &memory.last), values);
        memory.last = values.clone();
        memory
            .steps
            .insert(request.instance, (request.sequence, reply.clone()));
        Ok(reply)
    }

    fn perturbed_step(
        &self,
        request: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, CallError> {
        let mut changed = request.clone();
        changed.sequence = self.number(request.instance, request.sequence);
        if self.fault == Fault::PerturbsTheNeighbour {
            self.wrong_signals(&mut changed.perturbed, request.step);
        }
        if self.fault == Fault::DirectionsAreConstant {
            self.wrong_signals(&mut changed.directions, request.step);
        }
        let mut reply = self.refused(request.instance, self.inner.perturbed_step(&changed))?;
        if self.fault == Fault::PerturbedBackwards {
            reply.outputs.reverse();
        }
        if self.fault == Fault::DerivativesTimesStep {
            let values = reply.derivatives.iter_mut().flat_map(|own| &mut own.values);
            values.for_each(|own| *own *= request.step);
        }
        Ok(reply)
    }

    fn evaluate(&self, request: &v1::EvaluateRequest) -> Result<v1::EvaluateReply, CallError> {
        let mut changed = request.clone();
        if self.fault == Fault::TakesUnknownOutputs {
            changed.outputs.retain(|own| own != "no-such-name");
        }
        let mut reply = self.refused(request.instance, self.inner.evaluate(&changed))?;
        if self.fault == Fault::NoFeedthrough {
            reply
                .derivatives
                .iter_mut()
                .for_each(|own| own.values.fill(0.0));
        }
        Ok(reply)
    }

    fn terminate(&self, request: &v1::TerminateRequest) -> Result<v1::TerminateReply, CallError> {
        self.inner.terminate(request)
    }

    fn export_state(
        &self,
        request: &v1::ExportStateRequest,
    ) -> Result<v1::ExportStateReply, CallError> {
        self.inner.export_state(request)
    }

    fn import_state(
        &self,
        request: &v1::ImportStateRequest,
    ) -> Result<v1::ImportStateReply, CallError> {
        let mut changed = request.clone();
        changed.sequence = self.number(request.instance, request.sequence);
        if let Some(state) = &mut changed.state {
            match self.fault {
                Fault::ImportsDamaged => {
                    *state =
                        v1::ExportedState::sealed(&state.model, &state.writer, state.state.clone());
                }
                Fault::ImportsNothing => {
                    let own = self.inner.export_state(&v1::ExportStateRequest {
                        instance: request.instance,
                    })?;
                    changed.state = own.state;
                }
                _ => {}
            }
        }
        self.inner.import_state(&changed)
    }

    fn exchange(
        &self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), CallError> {
        let mut changed = request.clone();
        changed.sequence = self.number(request.instance, request.sequence);
        match self.fault {
            Fault::OneInstancePerStream => {
                let mut memory = self.memory.lock().unwrap();
                changed.instance = *memory.first.get_or_insert(request.instance);
                let next = memory.sequences[&changed.instance]
                    + u64::from(changed.instance != request.instance);
                memory.sequences.insert(changed.instance, next);
                changed.sequence = next;
            }
            Fault::KeepsNoWayBack => changed.go_back = false,
            _ => {}
        }
        self.inner.exchange(&changed, reply)?;
        reply.sequence = request.sequence;
        reply.instance = Some(request.instance);
        replies::wrong_exchange(self.fault, reply);
        if self.fault == Fault::PredictionMoves
            && let Some(predict) = &request.predict
        {
            let sequence = self.number(request.instance, request.sequence);
            let step = v1::StepRequest {
                instance: request.instance,
                sequence,
                t: predict.t,
                step: predict.step,
                signals: predict.signals.clone(),
                ..v1::StepRequest::default()
            };
            self.inner.step(&step)?;
        }
        Ok(())
    }
}
