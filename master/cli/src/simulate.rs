//! Runs a scene from start to end and hands every recorded row on.

use linchpin_master::results::Mechanism;
use linchpin_master::results::{Row, Statistics};
use linchpin_master::run::checkpoint::Checkpoint;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_master::workers::Subsystem;
use linchpin_master::{CoSimulation, Interrupt, RunError};

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

    /// Comes before the first row: the workers of the run.
    fn workers(&mut self, _subsystems: &[Subsystem]) {}

    /// The run starts; `row` has the column names and the values at the first macro point.
    fn begin(&mut self, row: &Row) -> Result<(), Self::Error>;

    /// One recorded macro point, the first one included.
    fn record(&mut self, row: &Row) -> Result<(), Self::Error>;

    /// After every macro step, recorded or not: the time that is reached, and how many attempts were repeated with a shorter step
    /// since the start.
    fn progress(&mut self, _t: f64, _rejected: u64) {}

    /// Asked before [`Recorder::begin`]: the checkpoint that the run goes on from, if it does. Then the row of the start is not recorded.
    fn resume(&mut self) -> Option<Checkpoint> {
        None
    }

    /// Asked after every macro step: whether a checkpoint is due.
    fn wants_checkpoint(&mut self) -> bool {
        false
    }

    /// The checkpoint that is due, or why there is none.
    fn checkpoint(
        &mut self,
        _t: f64,
        _checkpoint: Result<Checkpoint, RunError>,
    ) -> Result<(), Self::Error> {
        Ok(())
    }

    /// The run stops early: what it has cost so far.
    fn stop(&mut self, _statistics: Statistics) {}
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
    let interrupt = connector.interrupt();
    let resumed = recorder.resume();
    let mut simulation = start(scene, connector, options, resumed.as_ref())
        .map_err(|error| stopped(interrupt, scene.t_start, error))?;
    recorder.workers(simulation.subsystems());
    let mut story = Story::begin(scene);
    let ended = to_its_end(scene, interrupt, &mut simulation, &mut story, recorder);
    if ended.is_err() {
        recorder.stop(simulation.statistics());
    }
    ended?;
    if let Some(story) = &story {
        story.end(&simulation);
    }
    Ok(simulation.statistics())
}

/// Starts the run, at its start or where it was stopped, once more where a worker is lost meanwhile: nothing is computed yet that would be lost with it.
///
/// # Errors
/// What stands against it.
pub fn start(
    scene: &Scene,
    connector: &Connector,
    options: &Options,
    resumed: Option<&Checkpoint>,
) -> Result<CoSimulation, RunError> {
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    connector.begin(scene);
    let mut begin = || -> Result<CoSimulation, RunError> {
        let mut simulation = CoSimulation::start(scene, &mut connect, options)?;
        if let Some(checkpoint) = resumed {
            simulation.resume(checkpoint.clone())?;
        }
        Ok(simulation)
    };
    let mut attempts = 0;
    loop {
        match begin() {
            Err(error)
                if error.is_broken_connection()
                    && attempts < scene.run.recoveries
                    && !connector.interrupt().is_requested() =>
            {
                attempts += 1;
                tracing::warn!(attempt = attempts, "the run is started once more: {error}");
            }
            started => return started,
        }
    }
}

/// An interrupt makes calls under way fail, and it is the reason that counts.
fn stopped(interrupt: &Interrupt, t: f64, error: RunError) -> RunError {
    match interrupt.is_requested() {
        true => RunError::Interrupted { t },
        false => error,
    }
}

fn to_its_end<R: Recorder>(
    scene: &Scene,
    interrupt: &Interrupt,
    simulation: &mut CoSimulation,
    story: &mut Option<Story>,
    recorder: &mut R,
) -> Result<(), SimulateError<R::Error>> {
    if let Some(mechanism) = simulation.mechanism() {
        taken(recorder.mechanism(mechanism))?;
    }
    taken(recorder.begin(simulation.row()))?;
    if simulation.steps_done() == 0 {
        taken(recorder.record(simulation.row()))?;
    }
    while simulation
        .macro_step()
        .map_err(|error| stopped(interrupt, simulation.t(), error))?
    {
        record(scene, simulation, recorder)?;
        recorder.progress(simulation.t(), simulation.rejected());
        if recorder.wants_checkpoint() && !simulation.is_finished() {
            let checkpoint = simulation.checkpoint();
            taken(recorder.checkpoint(simulation.t(), checkpoint))?;
        }
        if let Some(story) = story {
            story.go_on(simulation);
        }
        if interrupt.is_requested() && !simulation.is_finished() {
            let t = simulation.t();
            return Err(RunError::Interrupted { t }.into());
        }
    }
    Ok(())
}

/// Records the samples inside the last macro step and the macro point at its end, as far as the scene wants them.
fn record<R: Recorder>(
    scene: &Scene,
    simulation: &mut CoSimulation,
    recorder: &mut R,
) -> Result<(), SimulateError<R::Error>> {
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
    Ok(())
}

fn taken<E>(by_recorder: Result<(), E>) -> Result<(), SimulateError<E>> {
    by_recorder.map_err(SimulateError::Record)
}
