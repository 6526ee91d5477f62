//! Stable or not by simulation.

use linchpin_master::cosimulation::{Connect, Options};
use linchpin_master::scene::Scene;
use linchpin_master::{CoSimulation, RunError};
use linchpin_proto::v1::{Model, Value, value::Kind as ValueKind};

use super::Simulated;
use crate::study::runs::{Kind, divergence};

/// The initial values of each further subsystem are larger than those of the first by this share, so that the joints
/// are open at first: the motion in which they open is excited from the start, and not only by rounding.
const EXCITATION: f64 = 0.01;

/// Share of the steps at the start and at the end that are compared.
const PART: usize = 10;

/// Simulates and compares the largest positions at the end with those at the start.
pub struct BlowUp {
    positions: Vec<String>,
}

impl BlowUp {
    pub fn new(columns: Vec<(String, Kind)>) -> Self {
        let positions = columns
            .into_iter()
            .filter(|(_, kind)| *kind == Kind::Position);
        Self {
            positions: positions.map(|(column, _)| column).collect(),
        }
    }

    pub fn simulate(
        &self,
        scene: &Scene,
        models: &[Model],
        connect: &mut Connect<'_>,
    ) -> Result<Simulated, RunError> {
        let scene = excited(scene, models);
        let options = Options {
            watch_nothing: true,
            accept_open_joints: true,
            established: None,
        };
        let mut simulation = CoSimulation::start(&scene, connect, &options)?;
        let steps = simulation.grid().len();
        match self.growth(&mut simulation) {
            Ok(growth) => Ok(Simulated { growth, steps }),
            Err(error) => divergence(error).map(|_| Simulated {
                growth: f64::INFINITY,
                steps,
            }),
        }
    }

    fn growth(&self, simulation: &mut CoSimulation) -> Result<f64, RunError> {
        let columns = simulation.row().columns().iter();
        let places: Vec<usize> = columns
            .enumerate()
            .filter(|(_, column)| self.positions.contains(column))
            .map(|(place, _)| place)
            .collect();
        let steps = simulation.grid().len();
        let part = steps.div_ceil(PART);
        let (mut at_start, mut at_end) = (0.0_f64, 0.0_f64);
        while simulation.macro_step()? {
            let values = simulation.row().values();
            let largest = places.iter().map(|&place| values[place].abs());
            let largest = largest.fold(0.0, f64::max);
            if simulation.steps_done() <= part {
                at_start = at_start.max(largest);
            }
            if simulation.steps_done() > steps - part {
                at_end = at_end.max(largest);
            }
        }
        // Positions that stay 0 do not grow.
        Ok(if at_end == 0.0 {
            0.0
        } else {
            at_end / at_start
        })
    }
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
