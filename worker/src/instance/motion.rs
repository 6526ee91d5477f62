//! A subsystem on its way: steps, outputs, and the states that it can go back to.

mod cut;
mod impacts;
mod integrals;
mod look_ahead;
mod meter;

use linchpin_proto::exchange::nothing_to_take_back;
use linchpin_proto::v1::{self, Failure};

use super::signals::{Signals, find};
use crate::{Inputs, Interval, Snapshot, StepFailure, Subsystem};

use impacts::Treated;
use integrals::Integrated;

pub(super) use impacts::resize;
pub(super) use look_ahead::{Horizon, Sequence};
pub(super) use meter::Meter;

/// Every state that the subsystem reaches gets a number, so that a step is known to start where another did.
type StateNumber = u64;

/// A state with its number.
#[derive(Default)]
pub(super) struct Kept {
    number: StateNumber,
    snapshot: Snapshot,
}

impl Kept {
    /// Copies into memory that is already there.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.number = other.number;
        self.snapshot.copy_from(&other.snapshot);
    }
}

/// A subsystem with its signals, and the state that it has for its master.
///
/// The solver itself may stand elsewhere, at the end of a step that was only tried; every call goes back first.
pub(super) struct Motion {
    subsystem: Box<dyn Subsystem>,
    signals: Signals,
    outputs: Vec<v1::Variable>,
    coupling_outputs: Vec<usize>,
    all_outputs: Vec<usize>,
    interior_outputs: Vec<usize>,
    integrated: Integrated,
    treated: Treated,
    stands_at: StateNumber,
    newest: StateNumber,
    last_step: Option<(Interval, StateNumber)>,
    committed: Kept,
    advanced: Kept,
    /// The state that the last advance started from.
    previous: Kept,
    can_go_back: bool,
    integrations: u64,
    derivatives: u64,
    /// States of a look-ahead and its perturbed ones at an instant inside the step.
    under_way: Vec<Snapshot>,
    /// Outputs that nobody asked for.
    unread: Vec<f64>,
    /// Derivatives at an instant.
    at_instant: Vec<v1::Outputs>,
}

/// What a request wants to know about the inside of a step.
#[derive(Clone, Copy)]
pub(super) struct Inside<'a> {
    /// Instants at which it is cut, s after its start.
    pub instants: &'a [f64],
    /// Number of integrals of each output.
    pub integrals: u32,
}

/// Which state a step starts from.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Base {
    Committed,
    Advanced,
}

impl Motion {
    pub(super) fn new(
        subsystem: Box<dyn Subsystem>,
        signals: Signals,
        model: &v1::Model,
        request: &v1::InitializeRequest,
    ) -> Result<Self, Failure> {
        let outputs = &model.outputs;
        let coupling_outputs = find(outputs, &request.coupling_outputs, "coupling_outputs")?;
        let mut all_outputs = coupling_outputs.clone();
        all_outputs.extend(find(
            outputs,
            &request.recorded_outputs,
            "recorded_outputs",
        )?);
        let interior_outputs = find(outputs, &request.interior_outputs, "interior_outputs")?;
        let integrated = find(outputs, &request.integrated_outputs, "integrated_outputs")?;
        let mut committed = Kept::default();
        subsystem.snapshot(&mut committed.snapshot);
        Ok(Self {
            subsystem,
            signals,
            outputs: outputs.clone(),
            coupling_outputs,
            all_outputs,
            interior_outputs,
            integrated: Integrated::new(integrated, model)?,
            treated: Treated::new(model),
            stands_at: committed.number,
            newest: committed.number,
            last_step: None,
            committed,
            advanced: Kept::default(),
            previous: Kept::default(),
            can_go_back: false,
            integrations: 0,
            derivatives: 0,
            under_way: Vec::new(),
            unread: Vec::new(),
            at_instant: Vec::new(),
        })
    }

    pub(super) fn committed(&self) -> &Kept {
        &self.committed
    }

    /// The committed state as bytes.
    pub(super) fn export(&mut self) -> Result<Vec<u8>, Failure> {
        let exported = self.subsystem.export(&self.committed.snapshot);
        exported.map_err(|failure| Failure::fatal(failure.to_string()))
    }

    /// Takes the signals of a request for the steps that follow.
    pub(super) fn set_signals(&mut self, signals: &[v1::Signal]) -> Result<(), Failure> {
        self.signals.set(signals)
    }

    /// Steps from the committed state and reads outputs; [`Motion::commit`] makes the end the committed state.
    pub(super) fn advance(
        &mut self,
        (interval, inside): (Interval, Inside<'_>),
        signals: &[v1::Signal],
        outputs: v1::OutputSet,
        values: &mut Vec<f64>,
    ) -> Result<(), Failure> {
        self.signals.set(signals)?;
        self.integrate_outputs(inside.integrals)?;
        self.go_to(Base::Committed)?;
        if !self.is_cut(inside.instants) {
            self.integrate(interval, Sequence::Own)?;
            self.read(interval, outputs, values)?;
            self.append_integrals(interval, values)?;
        } else {
            self.step_cut((interval, inside.instants), outputs, values)?;
        }
        self.advanced.snapshot.clear();
        self.subsystem.snapshot(&mut self.advanced.snapshot);
        self.advanced.number = self.stands_at;
        Ok(())
    }

    /// All outputs after a shorter step than the advance, from where it started and under its signals.
    pub(super) fn sample(
        &mut self,
        interval: Interval,
        values: &mut Vec<f64>,
    ) -> Result<(), Failure> {
        self.go_to(Base::Committed)?;
        if self.is_struck() {
            self.step_to_sample(interval)?;
        } else {
            self.begin_part([0.0, interval.length])?;
            self.integrate(interval, Sequence::Own)?;
        }
        self.read(interval, v1::OutputSet::All, values)
    }

    /// Makes the end of the advance the committed state.
    pub(super) fn commit(&mut self) {
        std::mem::swap(&mut self.previous, &mut self.committed);
        std::mem::swap(&mut self.committed, &mut self.advanced);
        self.can_go_back = true;
    }

    /// Makes the state that the last advance started from the committed one again.
    pub(super) fn take_back(&mut self) -> Result<(), Failure> {
        if !self.can_go_back {
            return Err(nothing_to_take_back());
        }
        std::mem::swap(&mut self.committed, &mut self.previous);
        self.can_go_back = false;
        Ok(())
    }

    /// Undoes [`Motion::take_back`], after which nothing was committed.
    pub(super) fn stay(&mut self) {
        std::mem::swap(&mut self.committed, &mut self.previous);
        self.can_go_back = true;
    }

    /// Makes `kept` the committed state.
    pub(super) fn restore(&mut self, kept: &Kept) -> Result<(), Failure> {
        go_back(&mut *self.subsystem, &mut self.stands_at, kept)?;
        self.committed.copy_from(kept);
        self.can_go_back = false;
        Ok(())
    }

    /// Makes a state that another instance has exported the committed one.
    pub(super) fn import(&mut self, state: &[u8]) -> Result<(), Failure> {
        self.newest += 1;
        let imported = Kept {
            number: self.newest,
            snapshot: Snapshot::from_bytes(state.to_vec()),
        };
        self.restore(&imported)
    }

    fn go_to(&mut self, base: Base) -> Result<(), Failure> {
        let kept = match base {
            Base::Committed => &self.committed,
            Base::Advanced => &self.advanced,
        };
        go_back(&mut *self.subsystem, &mut self.stands_at, kept)
    }

    /// Steps under the present signals.
    fn integrate(&mut self, interval: Interval, sequence: Sequence) -> Result<(), Failure> {
        let step = (interval, self.stands_at);
        let is_repeated = sequence == Sequence::Repeated && self.last_step == Some(step);
        self.newest += 1;
        self.stands_at = self.newest;
        self.integrations += 1;
        let inputs: &Inputs = self.signals.inputs();
        let done = if is_repeated {
            self.subsystem.perturbed_step(interval, inputs)
        } else {
            let done = self.subsystem.step(interval, inputs);
            // What a failed step left behind cannot be repeated.
            self.last_step = done.is_ok().then_some(step);
            done
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
        let wanted = outputs_of(set, [&self.coupling_outputs, &self.all_outputs]);
        values.clear();
        values.resize(wanted.len(), 0.0);
        let inputs = self.signals.values_at(interval.length);
        self.subsystem
            .outputs(interval.end(), inputs, wanted, values)
            .map_err(|failure| tell(failure, interval.start, interval.length))
    }
}

/// The outputs of a set, of the coupling outputs and of all.
fn outputs_of(set: v1::OutputSet, [coupling, all]: [&[usize]; 2]) -> &[usize] {
    match set {
        v1::OutputSet::Coupling => coupling,
        v1::OutputSet::All => all,
    }
}

/// A number that no state has: where the solver stands while it cannot be said.
const NOWHERE: StateNumber = StateNumber::MAX;

fn go_back(
    subsystem: &mut dyn Subsystem,
    stands_at: &mut StateNumber,
    kept: &Kept,
) -> Result<(), Failure> {
    if *stands_at == kept.number {
        return Ok(());
    }
    *stands_at = NOWHERE;
    subsystem
        .restore(&kept.snapshot)
        .map_err(|failure| Failure::fatal(failure.to_string()))?;
    *stands_at = kept.number;
    Ok(())
}

/// The interval of a request.
pub(super) fn interval(start: f64, length: f64) -> Result<Interval, Failure> {
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
        StepFailure::NotOffered { .. } => Failure::misuse("directions", failure.to_string()),
        StepFailure::Cancelled { .. } => Failure::fatal(failure.to_string()),
        StepFailure::Fatal { message } => Failure {
            t: Some(t),
            step: Some(step),
            ..Failure::fatal(message.clone())
        },
    }
}
