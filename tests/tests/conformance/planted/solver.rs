//! Faults of a solver, behind the SDK.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem};

use super::body::Body;

/// What is wrong with the solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    None,
    // Loads.
    NoMoment,
    NoMomentInStep,
    NoLoadInStep,
    HalfLoadInStep,
    HalfLoadEverywhere,
    BodyAxesLoad,
    LoadAtTheCentre,
    MomentSign,
    ForceSign,
    SwappedForces,
    SwappedMoments,
    SwappedMarkers,
    FrozenAtStart,
    FrozenInTheMiddle,
    FrozenAtEnd,
    StraightLine,
    TimeOfSignalsOff,
    // Outputs.
    NoGravityInAcceleration,
    AccelerationIgnoresLoad,
    AccelerationOfTheCentre,
    VelocityOfTheCentre,
    BodyAxesVelocity,
    BodyAxesAcceleration,
    BodyAxesRate,
    RateSign,
    Degrees,
    ConjugateQuaternion,
    RealPartLast,
    QuaternionNotNormalised,
    ZeroOutputs,
    ZeroVelocities,
    StaleOutputs,
    HalfOldOutputs,
    HalfPositions,
    WrongEnergy,
    NaNAfterAWhile,
    // States.
    RestoresNothing,
    RestoresHalf,
    HiddenHistory,
    SharedHistory,
    EvaluateMoves,
    PerturbedStepMoves,
    PerturbedStepIgnores,
    RandomSolver,
}

/// A built-in body with a fault.
pub struct Faulty {
    inner: Box<dyn Model>,
    body: Body,
    fault: Fault,
    shared: Arc<Mutex<f64>>,
}

impl Faulty {
    pub fn new(inner: Box<dyn Model>, body: Body, fault: Fault) -> Self {
        Self {
            inner,
            body,
            fault,
            shared: Arc::default(),
        }
    }
}

impl Model for Faulty {
    /// Without what other parts of the SDK compute past the fault.
    fn describe(&self) -> v1::Model {
        v1::Model {
            capabilities: Some(v1::Capabilities::default()),
            ..self.inner.describe()
        }
    }

    fn describe_with(&self, _: &BTreeMap<String, v1::Value>) -> Result<v1::Model, SetupError> {
        Ok(self.describe())
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let history = match self.fault {
            Fault::SharedHistory => Arc::clone(&self.shared),
            _ => Arc::default(),
        };
        Ok(Box::new(Wrong {
            inner: self.inner.initialize(setup)?,
            body: self.body,
            fault: self.fault,
            outputs: self.inner.describe().outputs.len(),
            history,
            last: None,
            steps: 0,
            begun: Vec::new(),
        }))
    }
}

struct Wrong {
    inner: Box<dyn Subsystem>,
    body: Body,
    fault: Fault,
    outputs: usize,
    /// What the solver remembers beside its state.
    history: Arc<Mutex<f64>>,
    last: Option<Inputs>,
    steps: usize,
    /// Outputs at the start of the last step.
    begun: Vec<f64>,
}

impl Wrong {
    fn all_outputs(&mut self, t: f64, inputs: &[f64]) -> Result<Vec<f64>, StepFailure> {
        let places: Vec<usize> = (0..self.outputs).collect();
        let mut values = vec![0.0; self.outputs];
        self.inner.outputs(t, inputs, &places, &mut values)?;
        Ok(values)
    }

    /// Loads as the fault has them, at a state with these outputs.
    fn loads(&self, outputs: &[f64], values: &mut [f64], in_step: bool) {
        let body = self.body;
        let forces = body.translations();
        match self.fault {
            Fault::NoMomentInStep | Fault::NoLoadInStep | Fault::HalfLoadInStep if !in_step => {
                return;
            }
            Fault::SwappedMarkers => values.rotate_left(body.loads()),
            _ => {}
        }
        for marker in 0..2 {
            let load = &mut values[body.load(marker)];
            match self.fault {
                Fault::NoMoment | Fault::NoMomentInStep => load[forces..].fill(0.0),
                Fault::NoLoadInStep => load.fill(0.0),
                Fault::HalfLoadInStep | Fault::HalfLoadEverywhere => {
                    load.iter_mut().for_each(|own| *own /= 2.0);
                }
                Fault::BodyAxesLoad => {
                    let turned = body.turned(outputs, &load[..forces]);
                    load[..forces].copy_from_slice(&turned);
                }
                Fault::LoadAtTheCentre => {
                    let moment = body.moment(&body.arm(outputs, marker), &load[..forces]);
                    for (own, part) in load[forces..].iter_mut().zip(moment) {
                        *own -= part;
                    }
                }
                Fault::MomentSign => load[forces..].iter_mut().for_each(|own| *own = -*own),
                Fault::ForceSign => load[..forces].iter_mut().for_each(|own| *own = -*own),
                Fault::SwappedForces => load.swap(0, 1),
                Fault::SwappedMoments => load.swap(forces, forces + 1),
                _ => {}
            }
        }
    }

    /// The inputs of a step as the fault has them.
    fn inputs(&mut self, interval: Interval, inputs: &Inputs) -> Result<Inputs, StepFailure> {
        let h = interval.length;
        let mut now = vec![0.0; inputs.len()];
        inputs.values_at(0.0, &mut now);
        self.begun = self.all_outputs(interval.start, &now)?;
        let at = match self.fault {
            Fault::FrozenAtStart => vec![0.0],
            Fault::FrozenInTheMiddle => vec![h / 2.0],
            Fault::FrozenAtEnd => vec![h],
            Fault::StraightLine => vec![0.0, h],
            _ => (0..4).map(|node| f64::from(node) * h / 3.0).collect(),
        };
        let off = if self.fault == Fault::TimeOfSignalsOff {
            h / 2.0
        } else {
            0.0
        };
        let remembered = self.remembered(inputs, h);
        let mut columns = vec![Vec::new(); inputs.len()];
        for &tau in &at {
            let mut values = vec![0.0; inputs.len()];
            inputs.values_at(tau + off, &mut values);
            self.loads(&self.begun.clone(), &mut values, true);
            for (column, value) in columns.iter_mut().zip(values) {
                column.push(value + remembered);
            }
        }
        let mut wrong = Inputs::constant(&now);
        for (input, column) in columns.iter().enumerate() {
            let polynomial = match at.len() {
                1 => Polynomial::constant(column[0]),
                _ => Polynomial::through(&at, column).unwrap(),
            };
            wrong.replace(input, polynomial);
        }
        Ok(wrong)
    }

    /// What earlier steps add to the loads.
    fn remembered(&self, inputs: &Inputs, h: f64) -> f64 {
        let mut history = self.history.lock().unwrap();
        let before = *history;
        match self.fault {
            Fault::HiddenHistory | Fault::SharedHistory => *history = 1e-3 * inputs.value(0, h),
            Fault::EvaluateMoves | Fault::PerturbedStepMoves => *history = 0.0,
            Fault::RandomSolver => *history += 1e-9,
            _ => {}
        }
        before
    }

    /// Outputs as the fault has them.
    fn wrong(&self, values: &mut [f64]) {
        let body = self.body;
        let right = values.to_vec();
        let (forces, loads) = (body.translations(), body.loads());
        match self.fault {
            Fault::ZeroOutputs => values.fill(0.0),
            Fault::StaleOutputs if !self.begun.is_empty() => values.copy_from_slice(&self.begun),
            Fault::HalfOldOutputs if !self.begun.is_empty() => {
                let pairs = values.iter_mut().zip(&self.begun);
                pairs.for_each(|(own, old)| *own = (*own + old) / 2.0);
            }
            Fault::WrongEnergy => values[body.energy()] *= 2.0,
            Fault::NaNAfterAWhile if self.steps > 110 => values[0] = f64::NAN,
            _ => {}
        }
        for marker in 0..2 {
            let [position, velocity, acceleration] = body.places(marker);
            let vector = |first: usize| right[first..first + forces].to_vec();
            let mut put = |first: usize, list: Vec<f64>| {
                values[first..first + list.len()].copy_from_slice(&list)
            };
            match self.fault {
                Fault::NoGravityInAcceleration => put(
                    acceleration + forces - 1,
                    vec![right[acceleration + forces - 1] + 9.81],
                ),
                Fault::AccelerationOfTheCentre => {
                    let arm = body.arm(&right, marker);
                    let rate = right[velocity + loads - 1];
                    let parts = arm
                        .iter()
                        .enumerate()
                        .map(|(place, arm)| right[acceleration + place] + rate * rate * arm);
                    put(acceleration, parts.collect());
                }
                Fault::VelocityOfTheCentre => put(velocity, vector(body.centre_velocity())),
                Fault::BodyAxesVelocity => put(velocity, body.turned(&right, &vector(velocity))),
                Fault::BodyAxesAcceleration => {
                    put(acceleration, body.turned(&right, &vector(acceleration)))
                }
                Fault::BodyAxesRate => put(
                    velocity + forces,
                    body.turned(&right, &vector(velocity + forces)),
                ),
                Fault::RateSign => put(
                    velocity + forces,
                    right[velocity + forces..velocity + loads]
                        .iter()
                        .map(|own| -own)
                        .collect(),
                ),
                Fault::Degrees => put(position + 2, vec![right[position + 2].to_degrees()]),
                Fault::HalfPositions => put(
                    position,
                    vector(position).iter().map(|own| own / 2.0).collect(),
                ),
                Fault::ZeroVelocities => put(velocity, vec![0.0; loads]),
                Fault::ConjugateQuaternion => put(
                    position + 4,
                    right[position + 4..position + 7]
                        .iter()
                        .map(|own| -own)
                        .collect(),
                ),
                Fault::RealPartLast => {
                    let mut list = right[position + 3..position + 7].to_vec();
                    list.rotate_left(1);
                    put(position + 3, list);
                }
                Fault::QuaternionNotNormalised => {
                    put(
                        position + 3,
                        right[position + 3..position + 7]
                            .iter()
                            .map(|own| 1.001 * own)
                            .collect(),
                    );
                }
                _ => {}
            }
        }
    }
}

impl Subsystem for Wrong {
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.last = Some(inputs.clone());
        self.steps += 1;
        let wrong = self.inputs(interval, inputs)?;
        self.inner.step(interval, &wrong)
    }

    fn perturbed_step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        let inputs = match (self.fault, &self.last) {
            (Fault::PerturbedStepIgnores, Some(last)) => last.clone(),
            _ => inputs.clone(),
        };
        let wrong = self.inputs(interval, &inputs)?;
        self.inner.perturbed_step(interval, &wrong)?;
        if self.fault == Fault::PerturbedStepMoves {
            *self.history.lock().unwrap() = 1e-3;
        }
        Ok(())
    }

    fn outputs(
        &mut self,
        t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        let state = self.all_outputs(t, inputs)?;
        let mut seen = inputs.to_vec();
        self.loads(&state, &mut seen, false);
        if self.fault == Fault::AccelerationIgnoresLoad {
            seen.fill(0.0);
        }
        let mut all = self.all_outputs(t, &seen)?;
        self.wrong(&mut all);
        if self.fault == Fault::EvaluateMoves {
            *self.history.lock().unwrap() += 1e-3 * inputs[0];
        }
        for (value, &output) in values.iter_mut().zip(wanted) {
            *value = all[output];
        }
        Ok(())
    }

    fn snapshot(&self, into: &mut Snapshot) {
        self.inner.snapshot(into);
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        match self.fault {
            Fault::RestoresNothing => Ok(()),
            Fault::RestoresHalf => {
                let mut now = Snapshot::default();
                self.inner.snapshot(&mut now);
                let half = now.bytes().len() / 16 * 8;
                let bytes = [&from.bytes()[..half], &now.bytes()[half..]].concat();
                self.inner.restore(&Snapshot::from_bytes(bytes))
            }
            _ => self.inner.restore(from),
        }
    }

    fn internal_steps(&self) -> u64 {
        self.inner.internal_steps()
    }

    fn tolerance(&self) -> Option<f64> {
        self.inner.tolerance()
    }
}
