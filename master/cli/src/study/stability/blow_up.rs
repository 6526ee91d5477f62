//! Stable or not by simulation.

use linchpin_master::scene::Scene;
use linchpin_master::setup::{Connect, Options};
use linchpin_master::{CoSimulation, RunError};
use linchpin_proto::v1::{Model, Value, value::Kind as ValueKind};

use super::Simulated;
use super::cell::MOST_GROWTH;
use crate::interrupt;
use crate::study::columns::{Column, Kind, record};
use crate::study::runs::divergence;

/// The initial values of each further subsystem are larger than those of the first by this share, so that the joints
/// are open at first: the motion in which they open is excited from the start, and not only by rounding.
const EXCITATION: f64 = 0.1;

/// Share of the time at the start and at the end that is compared, and a little more, so that a macro point on its end counts.
const PART: f64 = 0.1 + 1e-9;

/// Growth or decay by this factor since the start is decided; going on would only leave the range of numbers.
const DECIDED: f64 = 1e100;

/// Simulates and compares the largest positions and velocities at the end with those at the start.
///
/// Velocities as well: an unstable mode that changes its sign in every macro step moves the markers by little more than
/// `v H`, and shows in the positions late.
pub struct BlowUp {
    columns: Vec<Column>,
}

impl BlowUp {
    pub fn new(mut columns: Vec<Column>) -> Self {
        columns.retain(|column| matches!(column.kind, Kind::Position | Kind::Velocity));
        Self { columns }
    }

    pub fn simulate(
        &self,
        scene: &Scene,
        models: &[Model],
        connect: &mut Connect<'_>,
    ) -> Result<Simulated, RunError> {
        let mut scene = excited(scene, models);
        record(&mut scene, &self.columns);
        let options = Options {
            watch_nothing: true,
            accept_open_joints: true,
            ..Options::default()
        };
        let mut simulation = CoSimulation::start(&scene, connect, &options)?;
        let growth = match self.growth(&scene, &mut simulation) {
            Ok(growth) => growth,
            Err(error) => divergence(error).map(|_| f64::INFINITY)?,
        };
        Ok(Simulated::new(growth, MOST_GROWTH, &scene))
    }

    /// The largest growth of all columns.
    fn growth(&self, scene: &Scene, simulation: &mut CoSimulation) -> Result<f64, RunError> {
        let names = simulation.row().columns();
        let place = |column: &Column| names.iter().position(|name| *name == column.name);
        let places = self.columns.iter().filter_map(place);
        let mut extents: Vec<Extent> = places.map(Extent::of_column).collect();
        let part = PART * (scene.t_end - scene.t_start);
        let (early, late) = (scene.t_start + part, scene.t_end - part);
        let first_size = largest(simulation, &extents);
        let interrupt = interrupt::of_process();
        while simulation.macro_step()? {
            let t = simulation.t();
            if interrupt.is_requested() {
                return Err(RunError::Interrupted { t });
            }
            for extent in &mut extents {
                extent.add(simulation.row().values(), t <= early, t > late);
            }
            let size = largest(simulation, &extents);
            if first_size > 0.0 && size > DECIDED * first_size {
                return Ok(f64::INFINITY);
            }
            if size < first_size / DECIDED {
                return Ok(0.0);
            }
        }
        Ok(extents.iter().map(Extent::growth).fold(0.0, f64::max))
    }
}

/// Largest sizes of one column.
struct Extent {
    place: usize,
    at_start: f64,
    at_end: f64,
}

impl Extent {
    fn of_column(place: usize) -> Self {
        Self {
            place,
            at_start: 0.0,
            at_end: 0.0,
        }
    }

    fn add(&mut self, values: &[f64], is_start: bool, is_end: bool) {
        let size = values[self.place].abs();
        if is_start {
            self.at_start = self.at_start.max(size);
        }
        if is_end {
            self.at_end = self.at_end.max(size);
        }
    }

    fn growth(&self) -> f64 {
        // What stays 0 does not grow.
        if self.at_end == 0.0 {
            0.0
        } else {
            self.at_end / self.at_start
        }
    }
}

fn largest(simulation: &CoSimulation, extents: &[Extent]) -> f64 {
    let values = simulation.row().values();
    let sizes = extents.iter().map(|extent| values[extent.place].abs());
    sizes.fold(0.0, f64::max)
}

fn excited(scene: &Scene, models: &[Model]) -> Scene {
    let mut scene = scene.clone();
    for (number, (subsystem, model)) in scene.subsystems.iter_mut().zip(models).enumerate() {
        let factor = 1.0 + EXCITATION * number as f64;
        for state in &model.states {
            let value = subsystem.parameters.get_mut(&state.initial);
            if let Some(Value {
                kind: Some(ValueKind::Number(value)),
            }) = value
            {
                *value *= factor;
            }
        }
    }
    scene
}
