//! What every check starts from: instances of the subject that are in motion.
//!
//! An instance that has just begun shows little: a body at rest, parallel to the inertial axes, hides wrong frames and wrong
//! rates. So the kit first drives every instance over [`PRELUDE`] macro steps with inputs that go up and down, each as large
//! as it takes to move a marker about as much as gravity does.

mod describe;
mod sizes;

use std::cell::Cell;
use std::f64::consts::TAU;
use std::hash::{BuildHasher, RandomState};

use linchpin_master::connection::Connection;
use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1;
use linchpin_proto::version::PROTOCOL;

use super::compare::rounding;
use super::inputs::{HIGHEST_DEGREE, Inputs};
use super::instance::Instance;
use super::peer::Peer;
use super::subject::Subject;
use super::verdict::{Grade, Stop};
use super::{ConformanceError, Settings};
use describe::describe;
use sizes::sizes;

/// Macro steps before a check begins.
pub const PRELUDE: usize = 100;

/// The macro step from which on the inputs of the prelude stay: solvers that carry accelerations along from step to step, as
/// those of the generalised-alpha family, have forgotten how they changed when a check begins.
const SETTLED: usize = 80;

/// Shares of the inputs' sizes that are tried, before none, until the model takes the steps of the prelude.
const SHARES: [f64; 3] = [1.0, 0.1, 0.01];

/// Relative change of inputs that shows what rounding does to outputs.
const NUDGE: f64 = 1e-12;

/// Factor between the noise that is seen and the one that is allowed for.
const NOISE_MARGIN: f64 = 100.0;

/// Share of the largest value of any output above which nothing counts as noise.
const MOST_NOISE: f64 = 1e-9;

/// First sequence number: any is right, since the master chooses it.
const FIRST: u64 = 4001;

/// The subject with its worker and what is known of both.
pub struct Bench<'p> {
    peer: &'p dyn Peer,
    connection: Box<dyn Connection>,
    settings: &'p Settings,
    /// Name of the worker's program.
    pub worker: String,
    /// Its version.
    pub worker_version: String,
    /// The model.
    pub subject: Subject,
    /// How much each input is changed, in its unit.
    pub sizes: Vec<f64>,
    /// Protocol of the worker.
    pub protocol: Option<v1::ProtocolVersion>,
    /// Error tolerance that the solver says it has.
    pub told_tolerance: Option<f64>,
    /// Its value in the units of the outputs; 0 if the solver says that it is exact.
    pub tolerance: f64,
    /// Whether the solver has unilateral contacts: then motions have corners, and accelerations are not linear in the loads.
    pub has_contacts: bool,
    /// By how much rounding moves each output: see [`Bench::rounding`].
    noise: Vec<f64>,
    /// Share of the sizes during the prelude: 1, or 0 if the model takes its steps without loads only.
    share: f64,
    next_number: Cell<u64>,
}

impl<'p> Bench<'p> {
    /// Reads the description, finds sizes for the inputs, and drives a first instance.
    ///
    /// # Errors
    /// [`ConformanceError`] if no instance of the model takes steps.
    pub fn new(peer: &'p dyn Peer, settings: &'p Settings) -> Result<Self, ConformanceError> {
        let connection = peer.connect()?;
        let (reply, model) = describe(&*connection, settings)?;
        let subject = Subject::new(&model)?;
        let mut bench = Self {
            peer,
            connection,
            settings,
            worker: reply.worker,
            worker_version: reply.worker_version,
            sizes: vec![1.0; subject.inputs.len()],
            subject,
            protocol: reply.protocol,
            told_tolerance: None,
            tolerance: 0.0,
            has_contacts: false,
            noise: Vec::new(),
            share: 1.0,
            next_number: Cell::new(RandomState::new().hash_one(PROTOCOL.minor)),
        };
        let failed = |error| ConformanceError::Initialize {
            model: model.name.clone(),
            source: Box::new(error),
        };
        let (instance, reply) = bench.initialize(&bench.request()).map_err(failed)?;
        let (told, sizes) = (reply.tolerance, sizes(&instance));
        drop(instance);
        (bench.told_tolerance, bench.sizes) = (told, sizes);
        bench.tolerance = told.filter(|told| told.is_finite()).unwrap_or(0.0).max(0.0);
        bench.find_share()?;
        bench.noise = bench
            .measure_noise()
            .map_err(|stop| ConformanceError::useless(&model.name, stop))?;
        Ok(bench)
    }

    /// The largest differences of outputs between two preludes whose inputs and lengths of steps differ by rounding.
    fn measure_noise(&self) -> Result<Vec<f64>, Stop> {
        let mut noise = vec![0.0_f64; self.subject.outputs.len()];
        let mut largest = 0.0_f64;
        let [mut own, mut other] = [self.at_start()?, self.at_start()?];
        for number in 0..PRELUDE {
            let inputs = self.prelude(number);
            let found = own.step(self.step(), &inputs)?;
            let beside = other.step(self.step(), &inputs.scaled(1.0 + NUDGE))?;
            for ((noise, a), b) in noise.iter_mut().zip(&found).zip(&beside) {
                *noise = noise.max((a - b).abs());
                largest = largest.max(a.abs());
            }
        }
        let most = MOST_NOISE * largest;
        Ok(noise
            .iter()
            .map(|own| (NOISE_MARGIN * own).min(most))
            .collect())
    }

    /// By how much two computations of an output that has these values may differ by rounding alone. An output that is nothing
    /// but rounding, as a reaction that is zero, differs by as much as it is large, so this is measured.
    pub fn rounding(&self, output: usize, values: &[f64]) -> f64 {
        rounding(values) + self.noise[output]
    }

    /// What the solver's tolerance and rounding may do to an output.
    pub fn floor(&self, output: usize, values: &[f64]) -> f64 {
        4.0 * self.tolerance + self.rounding(output, values)
    }

    /// Finds how large the inputs of the prelude may be.
    fn find_share(&mut self) -> Result<(), ConformanceError> {
        let sizes = self.sizes.clone();
        for share in SHARES {
            self.sizes = sizes.iter().map(|size| share * size).collect();
            if self.notice_contacts().is_ok() {
                return Ok(());
            }
        }
        self.share = 0.0;
        self.notice_contacts()
            .map_err(|stop| ConformanceError::useless(&self.subject.name, stop))
    }

    fn notice_contacts(&mut self) -> Result<(), Stop> {
        let has_contacts = self.in_motion()?.has_contacts;
        self.has_contacts = has_contacts;
        Ok(())
    }

    /// The macro steps (s) at which the model will be used.
    pub fn steps(&self) -> &[f64] {
        &self.settings.steps
    }

    /// The first of them.
    pub fn step(&self) -> f64 {
        self.settings.steps[0]
    }

    /// The request for a further instance: all inputs, all outputs, and all that the model offers of them.
    pub fn request(&self) -> v1::InitializeRequest {
        let number = self.next_number.get();
        self.next_number.set(number.wrapping_add(1));
        let offered = |is_offered: bool| match is_offered {
            true => self.subject.outputs.clone(),
            false => Vec::new(),
        };
        v1::InitializeRequest {
            instance: number,
            sequence: FIRST,
            protocol: Some(PROTOCOL),
            model: self.subject.name.clone(),
            parameters: self.settings.parameters.clone(),
            solver: self.settings.solver.clone(),
            t_start: 0.0,
            inputs: self.subject.inputs.clone(),
            coupling_outputs: self.subject.outputs.clone(),
            interior_outputs: offered(self.subject.capabilities.interior_outputs),
            integrated_outputs: offered(self.subject.capabilities.output_integrals),
            ..v1::InitializeRequest::default()
        }
    }

    /// The instance that a request asks for.
    pub fn initialize(
        &self,
        request: &v1::InitializeRequest,
    ) -> Result<(Instance<'_>, v1::InitializeReply), CallError> {
        Instance::initialize(self.connection.contract(), &self.subject, request)
    }

    /// An instance at its start.
    pub fn at_start(&self) -> Result<Instance<'_>, Stop> {
        Ok(self.initialize(&self.request())?.0)
    }

    /// An instance behind the prelude.
    pub fn in_motion(&self) -> Result<Instance<'_>, Stop> {
        self.driven(&self.request(), &[])
    }

    /// The instance of a request that has joint inputs, behind the prelude; the joint inputs keep these values.
    pub fn driven(
        &self,
        request: &v1::InitializeRequest,
        joint_inputs: &[f64],
    ) -> Result<Instance<'_>, Stop> {
        let (mut instance, _) = self.initialize(request)?;
        for number in 0..PRELUDE {
            let inputs = self.prelude(number).and(joint_inputs);
            instance.step(self.step(), &inputs)?;
        }
        Ok(instance)
    }

    /// Inputs of the macro step number `number`: constants that go up and down, each at a pace of its own, and stay at last.
    pub fn prelude(&self, number: usize) -> Inputs {
        self.at_turn(number.min(SETTLED))
    }

    /// Inputs that are others for each `number`.
    pub fn at_turn(&self, number: usize) -> Inputs {
        let turns = number as f64 / PRELUDE as f64;
        let value = |input: usize| {
            let pace = 1.0 + 0.5 * (input % 3) as f64;
            let share = self.share * (TAU * pace * turns + input as f64).cos();
            self.subject.defaults[input] + share * self.sizes[input]
        };
        Inputs::constant(&(0..self.sizes.len()).map(value).collect::<Vec<_>>())
    }

    /// Nothing but the defaults.
    pub fn unloaded(&self) -> Inputs {
        Inputs::constant(&self.subject.defaults)
    }

    /// Every input changed by about its size, as a polynomial that has all powers up to `degree`, or up to what the model
    /// takes.
    pub fn loaded(&self, degree: usize) -> Inputs {
        let degree = degree
            .min(self.subject.highest_degree())
            .min(HIGHEST_DEGREE);
        let mut inputs = self.unloaded();
        for (input, size) in self.sizes.iter().enumerate() {
            for power in 0..=degree {
                let share = (1.0 + (2 * input + 3 * power) as f64).cos();
                inputs = inputs.plus(input, share * size, power);
            }
        }
        inputs
    }

    /// A further connection, with an exchange stream of its own.
    pub fn connect(&self) -> Result<Box<dyn Connection>, Stop> {
        Ok(self.peer.connect()?)
    }

    /// The same worker in another process, if the kit can start it.
    pub fn another_process(&self) -> Result<Option<Box<dyn Peer>>, Stop> {
        Ok(self.peer.another_process()?)
    }

    /// The connection that instances are called over.
    pub fn calls(&self) -> &dyn Contract {
        self.connection.contract()
    }

    /// Whether the worker still answers.
    pub fn is_alive(&self) -> bool {
        let request = v1::DescribeRequest {
            protocol: Some(PROTOCOL),
            ..Default::default()
        };
        let is_answer = |reply: &Result<_, CallError>| !matches!(reply, Err(error) if Stop::Call(error.clone()).is_loss());
        is_answer(&self.calls().describe(&request))
    }

    /// The grade of results that are not what smooth mechanics asks for: with contacts, there may be a reason.
    pub fn grade_of_motion(&self) -> Grade {
        match self.has_contacts {
            true => Grade::Warn,
            false => Grade::Fail,
        }
    }
}
