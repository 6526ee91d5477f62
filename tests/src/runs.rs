//! Runs of a scene inside this process.

use std::convert::Infallible;

use linchpin::connect::{Connector, Place};
use linchpin::simulate::{self, Recorder, SimulateError, simulate};
use linchpin_master::results::{Row, Statistics};
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_master::{CoSimulation, RunError};

/// Time in s after which the multipliers no longer show the first steps.
const SETTLED: f64 = 0.05;

/// All rows of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trajectory {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// The values at the recorded macro points, the first one included.
    pub rows: Vec<Vec<f64>>,
    /// Integrations over a macro step that the run took.
    pub integrations: u64,
    /// Attempts at a macro step that were repeated.
    pub rejected: u64,
    /// Counts and times of the run.
    pub statistics: Statistics,
}

impl Trajectory {
    /// One column over all recorded macro points.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let place = self.columns.iter().position(|column| column == name);
        let place = place.unwrap_or_else(|| panic!("no column {name} among {:?}", self.columns));
        self.rows.iter().map(|row| row[place]).collect()
    }

    /// The rows after the 0.05 s, in which the multipliers settle.
    pub fn settled(mut self) -> Self {
        self.rows.retain(|row| row[0] > SETTLED);
        self
    }

    /// Every column with the bits of its values, by name.
    pub fn bits(&self) -> Vec<(String, Vec<u64>)> {
        let bits = |name: &String| self.column(name).into_iter().map(f64::to_bits).collect();
        let mut columns: Vec<_> = self
            .columns
            .iter()
            .map(|name| (name.clone(), bits(name)))
            .collect();
        columns.sort();
        columns
    }
}

impl Recorder for Trajectory {
    type Error = Infallible;

    fn begin(&mut self, row: &Row) -> Result<(), Infallible> {
        self.columns = row.columns().to_vec();
        Ok(())
    }

    fn record(&mut self, row: &Row) -> Result<(), Infallible> {
        self.rows.push(row.values().to_vec());
        Ok(())
    }
}

/// A run at its start, in this process.
///
/// # Panics
/// If it does not start.
pub fn start(scene: &Scene) -> CoSimulation {
    let connector = Connector::new(Place::InProcess);
    let started = simulate::start(scene, &connector, &Options::default(), None);
    started.unwrap_or_else(|error| panic!("{error}\nin {:?}", scene.coupling))
}

/// Runs a scene; the error is that of the run.
pub fn try_run(scene: &Scene, place: Place, options: &Options) -> Result<Trajectory, RunError> {
    let mut trajectory = Trajectory::default();
    match simulate(scene, &Connector::new(place), options, &mut trajectory) {
        Ok(statistics) => {
            trajectory.integrations = statistics.integrations;
            trajectory.rejected = statistics.steps.as_ref().map_or(0, |steps| steps.rejected);
            trajectory.statistics = statistics;
        }
        Err(SimulateError::Run(error)) => return Err(error),
        Err(SimulateError::Record(never)) => match never {},
    }
    Ok(trajectory)
}

/// Runs a scene that must reach its end.
pub fn run(scene: &Scene, place: Place) -> Trajectory {
    try_run(scene, place, &Options::default())
        .unwrap_or_else(|error| panic!("{error}\nin {:?}", scene.coupling))
}
