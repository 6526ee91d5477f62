//! Runs a scene from start to end and hands every recorded row on.

use linchpin_master::results::Mechanism;
use linchpin_master::results::{Row, Statistics};
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_master::{CoSimulation, RunError};

use crate::connect::Connector;
use crate::story::Story;

/// Gets the rows of a run.
pub trait Recorder {
    /// Why a row could not be taken.
    type Error;

    /// Comes first if [`Options::record_markers`] is set: which columns hold the positions of which markers.
    fn mechanism(&mut self, _mechanism: &Mechanism) -> Result<(), Self::Error> {
        Ok(())
    }

    /// The run starts; `row` has the column names and the values at the first macro point.
    fn begin(&mut self, row: &Row) -> Result<(), Self::Error>;

    /// One recorded macro point, the first one included.
    fn record(&mut self, row: &Row) -> Result<(), Self::Error>;

    /// After every macro step, recorded or not: the time that is reached.
    fn progress(&mut self, _t: f64) {}
}

/// A run that ended early.
#[derive(Debug, thiserror::Error)]
pub enum SimulateError<E> {
    /// The co-simulation stopped.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A result could not be kept.
    #[error("{0}")]
    Record(E),
}

/// Runs `scene` to its end. The first and the last macro point are always recorded, and every
/// `output.every`-th between them; with `output.interval` every `output.every`-th sample instead.
///
/// # Errors
/// What stopped the co-simulation, or the recorder's own error; [`RunError::Interrupted`] at the request of the
/// connector's interrupt.
pub fn simulate<R: Recorder>(
    scene: &Scene,
    connector: &Connector,
    options: &Options,
    recorder: &mut R,
) -> Result<Statistics, SimulateError<R::Error>> {
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    let interrupt = connector.interrupt();
    // An interrupt makes calls under way fail, and it is the reason that counts.
    let stopped = |t, error| match interrupt.is_requested() {
        true => RunError::Interrupted { t },
        false => error,
    };
    let mut simulation = CoSimulation::start(scene, &mut connect, options)
        .map_err(|error| stopped(scene.t_start, error))?;
    let mut story = Story::begin(scene);
    if let Some(mechanism) = simulation.mechanism() {
        taken(recorder.mechanism(mechanism))?;
    }
    taken(recorder.begin(simulation.row()))?;
    taken(recorder.record(simulation.row()))?;
    while simulation
        .macro_step()
        .map_err(|error| stopped(simulation.t(), error))?
    {
        let is_finished = simulation.is_finished();
        let every = scene.output.every as u64;
        for place in 0..simulation.samples() {
            if let Some((number, row)) = simulation.sample(place)
                && number.is_multiple_of(every)
            {
                taken(recorder.record(row))?;
            }
        }
        let number = match scene.output.interval {
            Some(_) => simulation.sample_here(),
            None => Some(simulation.steps_done() as u64),
        };
        if is_finished || number.is_some_and(|number| number.is_multiple_of(every)) {
            taken(recorder.record(simulation.row()))?;
        }
        recorder.progress(simulation.t());
        if let Some(story) = &mut story {
            story.go_on(&simulation);
        }
        if interrupt.is_requested() && !is_finished {
            let t = simulation.t();
            return Err(RunError::Interrupted { t }.into());
        }
    }
    if let Some(story) = &story {
        story.end(&simulation);
    }
    Ok(simulation.statistics())
}

fn taken<E>(by_recorder: Result<(), E>) -> Result<(), SimulateError<E>> {
    by_recorder.map_err(SimulateError::Record)
}
