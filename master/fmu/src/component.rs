//! A scene that somebody else steps.

use std::path::Path;

use linchpin::connect::{Connector, Place};
use linchpin::export::fmu::contents::{find_parameter, set_parameter};
use linchpin::export::fmu::variables::number_of;
use linchpin::export::fmu::{Contents, FmuExportError};
use linchpin::simulate;
use linchpin_master::run::checkpoint::Checkpoint;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_master::{CoSimulation, RunError};

/// Times that differ by less than this share of the communication step are the same.
const ROUNDING: f64 = 1e-9;

/// Why a call has failed.
#[derive(Debug, thiserror::Error)]
pub enum ComponentError {
    /// What was exported cannot be read.
    #[error(transparent)]
    Contents(#[from] FmuExportError),
    /// The description and the resources are of different exports.
    #[error(
        "the description has the token \"{found}\", and the resources have \"{expected}\": they belong to different FMUs"
    )]
    Token {
        /// That of the description.
        found: String,
        /// That of the resources.
        expected: String,
    },
    /// The run does not start, or a macro step has failed.
    #[error(transparent)]
    Run(#[from] Box<RunError>),
    /// Another start time than that of the scene.
    #[error("the start time is {found} s, and the scene starts at {expected} s")]
    StartTime {
        /// What was asked for.
        found: f64,
        /// That of the scene.
        expected: f64,
    },
    /// A step from another time than the present one.
    #[error("a step from t = {found} s, and the scene stands at t = {expected} s")]
    Time {
        /// What was asked for.
        found: f64,
        /// Where it stands.
        expected: f64,
    },
    /// A communication step that is none.
    #[error("a communication step of {0} s, which must be greater than 0")]
    StepSize(f64),
    /// No variable has this value reference.
    #[error("no {kind} has the value reference {reference}")]
    NoVariable {
        /// What was looked for.
        kind: &'static str,
        /// The number.
        reference: u32,
    },
    /// As many values as variables are wanted, since none is an array.
    #[error("{values} values for {variables} variables, none of which is an array")]
    WrongCount {
        /// Number of variables.
        variables: usize,
        /// Number of values.
        values: usize,
    },
    /// A parameter that is set after the start.
    #[error("parameter \"{0}\" is set after the start; it can be set before that only")]
    TooLate(String),
    /// A call out of order.
    #[error("{0} before the scene is initialised")]
    TooEarly(&'static str),
    /// A state that is none.
    #[error("this is no state of this FMU: {0}")]
    NoState(String),
}

/// The scene of an FMU.
pub struct Component {
    contents: Contents,
    scene: Scene,
    /// The scene as it was exported.
    given: Scene,
    run: Option<CoSimulation>,
}

impl Component {
    /// The scene in a folder of resources, if it belongs to the description with this token.
    ///
    /// # Errors
    /// [`ComponentError::Contents`], [`ComponentError::Token`].
    pub fn new(resources: &Path, token: &str) -> Result<Self, ComponentError> {
        let contents = Contents::read(resources)?;
        if contents.token != token {
            return Err(ComponentError::Token {
                found: token.to_owned(),
                expected: contents.token,
            });
        }
        let scene = contents.scene()?;
        Ok(Self {
            given: scene.clone(),
            contents,
            scene,
            run: None,
        })
    }

    /// Takes the times of the experiment: the scene must start there, and ends there if that is later than its own end.
    ///
    /// # Errors
    /// [`ComponentError::StartTime`].
    pub fn set_up(&mut self, start: f64, stop: Option<f64>) -> Result<(), ComponentError> {
        let expected = self.scene.t_start;
        if start != expected {
            let found = start;
            return Err(ComponentError::StartTime { found, expected });
        }
        self.scene.t_end = stop.map_or(self.given.t_end, |stop| stop.max(self.given.t_end));
        self.run = None;
        Ok(())
    }

    /// Starts the run, if it is not started.
    ///
    /// # Errors
    /// What stands against it.
    pub fn start(&mut self) -> Result<&mut CoSimulation, ComponentError> {
        let run = match self.run.take() {
            Some(run) => run,
            None => start(&self.scene)?,
        };
        Ok(self.run.insert(run))
    }

    /// Value of an output, of a parameter, or, behind these, the time.
    ///
    /// # Errors
    /// [`ComponentError::NoVariable`], and those of [`Component::start`].
    pub fn get(&mut self, reference: u32) -> Result<f64, ComponentError> {
        let none = ComponentError::NoVariable {
            kind: "variable",
            reference,
        };
        let place = reference as usize;
        if let Some(output) = self.contents.outputs.get(place).cloned() {
            return self.start()?.row().get(&output).ok_or(none);
        }
        let parameters = &self.contents.parameters;
        let place = place - self.contents.outputs.len();
        let name = match parameters.get(place) {
            Some(name) => name,
            None if place == parameters.len() => return Ok(self.t()),
            None => return Err(none),
        };
        let found = find_parameter(&self.scene, name);
        found
            .and_then(|(number, own)| number_of(&self.scene, number, own))
            .ok_or(none)
    }

    /// Gives a parameter another value, before the first step.
    ///
    /// # Errors
    /// [`ComponentError::NoVariable`], [`ComponentError::TooLate`].
    pub fn set(&mut self, reference: u32, value: f64) -> Result<(), ComponentError> {
        let none = ComponentError::NoVariable {
            kind: "parameter",
            reference,
        };
        let place = (reference as usize).checked_sub(self.contents.outputs.len());
        let name = place.and_then(|place| self.contents.parameters.get(place));
        let name = name.ok_or(none)?;
        if self.run.as_ref().is_some_and(|run| run.steps_done() > 0) {
            return Err(ComponentError::TooLate(name.clone()));
        }
        if let Some(found) = find_parameter(&self.scene, name) {
            set_parameter(&mut self.scene, found, value);
        }
        // The scene starts anew with it.
        self.run = None;
        Ok(())
    }

    /// The time at which it stands, s.
    pub fn t(&self) -> f64 {
        self.run
            .as_ref()
            .map_or(self.scene.t_start, CoSimulation::t)
    }

    /// Goes on from `t` by `step` (both in s).
    ///
    /// # Errors
    /// What ends the run; a time at which it does not stand.
    pub fn step(&mut self, t: f64, step: f64) -> Result<(), ComponentError> {
        let Some(run) = &mut self.run else {
            return Err(ComponentError::TooEarly("a step"));
        };
        if step.is_nan() || step <= 0.0 {
            return Err(ComponentError::StepSize(step));
        }
        let expected = run.t();
        if (t - expected).abs() > ROUNDING * step {
            let found = t;
            return Err(ComponentError::Time { found, expected });
        }
        run.advance_to(t + step).map_err(Box::new)?;
        Ok(())
    }

    /// The present state.
    ///
    /// # Errors
    /// A worker does not give its state.
    pub fn save(&mut self) -> Result<Checkpoint, ComponentError> {
        Ok(self.start()?.checkpoint().map_err(Box::new)?)
    }

    /// Goes back, or on, to a state.
    ///
    /// # Errors
    /// It belongs to another scene; a worker refuses its state.
    pub fn load(&mut self, state: &Checkpoint) -> Result<(), ComponentError> {
        let resumed = self.start()?.resume(state.clone());
        Ok(resumed.map_err(Box::new)?)
    }

    /// As it was before anything was set.
    pub fn reset(&mut self) {
        self.run = None;
        self.scene = self.given.clone();
    }
}

fn start(scene: &Scene) -> Result<CoSimulation, ComponentError> {
    let connector = Connector::new(Place::InProcess);
    let started = simulate::start(scene, &connector, &Options::default(), None);
    Ok(started.map_err(Box::new)?)
}

/// The bytes of a state.
pub fn to_bytes(state: &Checkpoint) -> Result<Vec<u8>, ComponentError> {
    postcard::to_stdvec(state).map_err(|error| ComponentError::NoState(error.to_string()))
}

/// The state that these bytes are of.
pub fn from_bytes(bytes: &[u8]) -> Result<Checkpoint, ComponentError> {
    postcard::from_bytes(bytes).map_err(|error| ComponentError::NoState(error.to_string()))
}
