//! A mass whose solver gives up, and runs with it.

use std::sync::Arc;

use linchpin_master::CoSimulation;
use linchpin_master::RunError;
use linchpin_master::connection::{Connection, Direct, Threaded, UnaryTurns};
use linchpin_master::results::Statistics;
use linchpin_master::scene::{self, Scene};
use linchpin_master::setup::Options;
use linchpin_models::oscillator::Oscillator;
use linchpin_proto::v1;
use linchpin_tests::scripted::Scripted;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Host, Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem};

/// What becomes of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fate {
    Done,
    Recoverable,
    Fatal,
    /// The first output is NaN.
    NotANumber,
}

/// Judges a step before it is taken.
pub type Judge = fn(Interval, &Inputs) -> Fate;

/// The built-in oscillator with a solver that does not take every step.
struct Brittle(Judge);

struct Run {
    inner: Box<dyn Subsystem>,
    judge: Judge,
    last: Fate,
}

impl Model for Brittle {
    fn describe(&self) -> v1::Model {
        Oscillator.describe()
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        Ok(Box::new(Run {
            inner: Oscillator.initialize(setup)?,
            judge: self.0,
            last: Fate::Done,
        }))
    }
}

impl Subsystem for Run {
    /// A step that fails has changed the state before it did.
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.inner.step(interval, inputs)?;
        self.last = (self.judge)(interval, inputs);
        match self.last {
            Fate::Done | Fate::NotANumber => Ok(()),
            Fate::Recoverable => Err(StepFailure::Recoverable {
                t: interval.start,
                message: "Newton did not converge".to_owned(),
            }),
            Fate::Fatal => Err(StepFailure::Fatal {
                message: "the mesh is torn".to_owned(),
            }),
        }
    }

    fn outputs(
        &mut self,
        t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        self.inner.outputs(t, inputs, wanted, values)?;
        if let (Fate::NotANumber, Some(value)) = (self.last, values.first_mut()) {
            *value = f64::NAN;
        }
        Ok(())
    }

    fn snapshot(&self, into: &mut Snapshot) {
        self.inner.snapshot(into);
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        self.last = Fate::Done;
        self.inner.restore(from)
    }
}

/// How the second mass is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Way {
    Direct,
    Threads,
    Unary,
}

/// What a run leaves behind: times, then the states of both masses and the multiplier, and the counts.
pub struct Ended {
    pub rows: Vec<Vec<f64>>,
    pub steps: Vec<f64>,
    pub statistics: Statistics,
}

impl Ended {
    pub fn bits(&self) -> Vec<Vec<u64>> {
        let bits = |row: &Vec<f64>| row.iter().map(|value| value.to_bits()).collect();
        self.rows.iter().map(bits).collect()
    }
}

/// Runs an oscillator scene whose second mass is brittle.
pub fn run_brittle(
    scene: &Scene,
    judge: Judge,
    way: Way,
    options: &Options,
) -> Result<Ended, RunError> {
    run_with(scene, options, &|| way.to(host(judge)))
}

/// Runs an oscillator scene whose second mass is a peer that plays a script.
pub fn run_scripted(
    scene: &Scene,
    script: impl Fn(Scripted) -> Scripted,
) -> Result<Ended, RunError> {
    // Unary calls below have numbers of their own, so they miss none that the script has answered.
    let calls = || UnaryTurns::new(host(|_, _| Fate::Done));
    let peer = || script(Scripted::new(Arc::new(calls())));
    run_with(scene, &Options::default(), &|| {
        Box::new(Direct::new(Arc::new(peer())))
    })
}

fn host(judge: Judge) -> Host {
    Host::new(vec![Box::new(Brittle(judge))])
}

impl Way {
    fn to(self, host: Host) -> Box<dyn Connection> {
        match self {
            Self::Direct => Box::new(Direct::new(Arc::new(host))),
            Self::Threads => Box::new(Threaded::new(Arc::new(host), "thread")),
            Self::Unary => Box::new(Threaded::new(Arc::new(UnaryTurns::new(host)), "unary")),
        }
    }
}

fn run_with(
    scene: &Scene,
    options: &Options,
    second: &dyn Fn() -> Box<dyn Connection>,
) -> Result<Ended, RunError> {
    let mut connect = |_: &Scene, subsystem: &scene::Subsystem| {
        Ok(match subsystem.name.as_str() {
            "mass2" => second(),
            _ => Way::Direct.to(host(|_, _| Fate::Done)),
        })
    };
    let mut simulation = CoSimulation::start(scene, &mut connect, options)?;
    let mut columns = simulation.row().columns().iter();
    let step = columns.position(|name| name == "step").unwrap_or_default();
    let mut ended = Ended {
        rows: vec![simulation.row().values().to_vec()],
        steps: Vec::new(),
        statistics: simulation.statistics(),
    };
    while !simulation.is_finished() {
        simulation.macro_step()?;
        ended.steps.push(simulation.row().values()[step]);
        ended.rows.push(simulation.row().values().to_vec());
    }
    ended.statistics = simulation.statistics();
    Ok(ended)
}
