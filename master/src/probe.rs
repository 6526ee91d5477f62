//! The matrix `A` of the macro-step map `s_{N+1} = A s_N` of a linear autonomous scene.
//!
//! The state `s` holds the state variables of all subsystems and the multipliers at the last macro points, as far back
//! as the coupling method looks. Column `j` of `A` is what the co-simulation itself makes of the unit state `e_j` in
//! one macro step: the workers start in that state, and the polynomials of the multipliers have their full degree from
//! the first step on.

mod error;
pub mod spectrum;

use faer::Mat;

use crate::CoSimulation;
use crate::results::Row;
use crate::scene::{Increment, JointKind, Scene};
use crate::setup::{Connect, Options, describe, multiplier_columns};

use linchpin_proto::v1::{self, value::Kind};

pub use error::ProbeError;

/// Size of the unit states, a power of two, so that it divides out without rounding.
///
/// Far below 1: the increments of the finite differences, which are not smaller than `1e-3`, then stand far above the
/// states, and the columns of the coupling Jacobian lose no digits.
const UNIT: f64 = 1.0 / (1_u64 << 40) as f64;

/// Two macro steps from a mixed state may differ by this share of all terms from what the matrix says: rounding.
const LINEAR: f64 = 1e-8;

/// What one entry of the state is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Coordinate {
    /// Result column, such as `mass1.x` or `link.lambda`.
    pub column: String,
    /// How many macro points ago; 0 is the present one.
    pub age: usize,
    setting: Setting,
}

/// How an entry of the state is given at the start.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Setting {
    Parameter { subsystem: usize, name: String },
    Multiplier { row: usize },
}

/// The linear map from one macro point to the next.
#[derive(Debug, Clone)]
pub struct MacroStepMap {
    coordinates: Vec<Coordinate>,
    matrix: Mat<f64>,
}

/// Obtains the macro-step map of `scene` from the co-simulation.
///
/// # Errors
/// [`ProbeError`]: the scene is not linear and autonomous, a subsystem hides its state, a solver is not exact, or the
/// co-simulation failed.
pub fn macro_step_map(
    scene: &Scene,
    connect: &mut Connect<'_>,
) -> Result<MacroStepMap, ProbeError> {
    let mut probe = Probe::new(scene, connect)?;
    probe.check_rest()?;
    let columns = (0..probe.coordinates.len())
        .map(|unit| probe.column(unit))
        .collect::<Result<Vec<_>, _>>()?;
    let size = columns.len();
    let map = MacroStepMap {
        matrix: Mat::from_fn(size, size, |row, column| columns[column][row]),
        coordinates: probe.coordinates.clone(),
    };
    probe.check_linear(&map)?;
    Ok(map)
}

impl MacroStepMap {
    /// What the entries of the state are.
    pub fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    /// The matrix `A`.
    pub fn matrix(&self) -> &Mat<f64> {
        &self.matrix
    }

    /// `A s`
    ///
    /// # Panics
    /// If `state` has not one entry for each coordinate.
    pub fn apply(&self, state: &[f64]) -> Vec<f64> {
        assert_eq!(
            state.len(),
            self.coordinates.len(),
            "one entry for each coordinate"
        );
        let row = |row: usize| {
            let entries = state.iter().enumerate();
            entries.map(|(j, s)| self.matrix[(row, j)] * s).sum()
        };
        (0..state.len()).map(row).collect()
    }

    /// Sum of the sizes of all terms of each entry of `A s`.
    fn sizes(&self, state: &[f64]) -> Vec<f64> {
        let row = |row: usize| {
            let entries = state.iter().enumerate();
            entries
                .map(|(j, s)| (self.matrix[(row, j)] * s).abs())
                .sum()
        };
        (0..state.len()).map(row).collect()
    }

    /// Largest absolute value of the eigenvalues of `A`: the co-simulation is stable if it is not above 1.
    ///
    /// # Errors
    /// [`ProbeError::NoConvergence`] if the eigenvalues cannot be computed.
    pub fn spectral_radius(&self) -> Result<f64, ProbeError> {
        spectrum::spectral_radius(&self.matrix)
    }
}

/// A scene that is started in chosen states.
struct Probe<'a, 'b> {
    scene: Scene,
    connect: &'a mut Connect<'b>,
    coordinates: Vec<Coordinate>,
    /// Number of multipliers.
    multipliers: usize,
    /// Macro points at which the method remembers multipliers.
    memory: usize,
}

impl<'a, 'b> Probe<'a, 'b> {
    fn new(scene: &Scene, connect: &'a mut Connect<'b>) -> Result<Self, ProbeError> {
        check_exchanged(scene)?;
        let memory = memory_of(scene)?;
        let models = describe(scene, connect)?;
        let multipliers = multiplier_columns(scene, &models)?;
        let mut coordinates = states_of(scene, &models)?;
        let mut scene = scene.clone();
        let columns = coordinates.iter().map(|state| state.column.clone());
        scene.output.variables = Some(columns.collect());
        scene.output.panels.clear();
        scene.coupling.increment = Increment::Automatic;
        scene.t_start = 0.0;
        for age in 0..memory {
            let rows = multipliers.iter().enumerate();
            coordinates.extend(rows.map(|(row, column)| Coordinate {
                column: column.clone(),
                age,
                setting: Setting::Multiplier { row },
            }));
        }
        Ok(Self {
            scene,
            connect,
            coordinates,
            multipliers: multipliers.len(),
            memory,
        })
    }

    fn column(&mut self, unit: usize) -> Result<Vec<f64>, ProbeError> {
        let mut state = vec![0.0; self.coordinates.len()];
        state[unit] = UNIT;
        let reached = self.after(1, &state)?;
        Ok(reached.iter().map(|value| value / UNIT).collect())
    }

    /// A scene that leaves the state of zeros is driven from outside.
    fn check_rest(&mut self) -> Result<(), ProbeError> {
        let zeros = vec![0.0; self.coordinates.len()];
        let reached = self.after(1, &zeros)?;
        match reached.iter().position(|value| *value != 0.0) {
            None => Ok(()),
            Some(place) => Err(ProbeError::Driven {
                column: self.coordinates[place].column.clone(),
                value: reached[place],
            }),
        }
    }

    /// Compares two macro steps from a state that mixes all coordinates with `A^2 s`: also a state that the
    /// coordinates do not show would make a difference.
    fn check_linear(&mut self, map: &MacroStepMap) -> Result<(), ProbeError> {
        let mixed: Vec<f64> = (0..self.coordinates.len())
            .map(|place| UNIT * (1.0 + place as f64).sqrt().sin())
            .collect();
        let reached = self.after(2, &mixed)?;
        let expected = map.apply(&map.apply(&mixed));
        let sizes = map.sizes(&map.sizes(&mixed));
        for (row, (&found, &expected)) in reached.iter().zip(&expected).enumerate() {
            let size = mixed[row].abs() + sizes[row];
            let difference = (found - expected).abs();
            if difference.is_nan() || difference > LINEAR * size {
                return Err(ProbeError::NotLinear {
                    column: self.coordinates[row].column.clone(),
                    found: found / UNIT,
                    expected: expected / UNIT,
                });
            }
        }
        Ok(())
    }

    /// The state after a number of macro steps from `state`.
    fn after(&mut self, steps: usize, state: &[f64]) -> Result<Vec<f64>, ProbeError> {
        let mut scene = self.scene.clone().with_fixed_steps();
        scene.t_end = steps as f64 * scene.coupling.macro_step;
        let mut multipliers = vec![vec![0.0; self.multipliers]; self.memory];
        for (coordinate, &value) in self.coordinates.iter().zip(state) {
            match &coordinate.setting {
                Setting::Parameter { subsystem, name } => {
                    let kind = Some(Kind::Number(value));
                    let parameters = &mut scene.subsystems[*subsystem].parameters;
                    parameters.insert(name.clone(), v1::Value { kind });
                }
                Setting::Multiplier { row } => multipliers[coordinate.age][*row] = value,
            }
        }
        let options = Options {
            watch_nothing: true,
            accept_open_joints: true,
            established: Some(multipliers),
            ..Options::default()
        };
        let mut simulation = CoSimulation::start(&scene, self.connect, &options)?;
        check_exact(&simulation)?;
        let mut values = state.to_vec();
        while simulation.macro_step()? {
            values = self.read(simulation.row(), &values)?;
        }
        Ok(values)
    }

    /// Reads the state at a macro point; `before` is that of the point before.
    fn read(&self, row: &Row, before: &[f64]) -> Result<Vec<f64>, ProbeError> {
        let multipliers = self.multipliers;
        let read_one = |(place, coordinate): (usize, &Coordinate)| match coordinate.age {
            0 => row
                .get(&coordinate.column)
                .ok_or_else(|| ProbeError::NotRecorded {
                    column: coordinate.column.clone(),
                }),
            _ => Ok(before[place - multipliers]),
        };
        self.coordinates.iter().enumerate().map(read_one).collect()
    }
}

/// Exchanged variables are remembered by the method, but a probe cannot start it with a memory of them.
fn check_exchanged(scene: &Scene) -> Result<(), ProbeError> {
    let mut joints = scene.joints.iter();
    let turning = joints.find(|joint| {
        let is_offset = joint.geometry.points.iter().any(Option::is_some);
        is_offset || !matches!(joint.kind, JointKind::RigidLink | JointKind::AtPoint)
    });
    let connection = scene.connections.first().map(|connection| &connection.name);
    match turning.map(|joint| &joint.name).or(connection) {
        None => Ok(()),
        Some(name) => Err(ProbeError::Exchanges { name: name.clone() }),
    }
}

/// Number of macro points at which the method remembers multipliers, the present one included.
fn memory_of(scene: &Scene) -> Result<usize, ProbeError> {
    let degree = scene.coupling.degree.fixed();
    let degree = degree.ok_or(ProbeError::ChangesDegree)?;
    let exchanged = scene.coupling.exchanged_degree.highest();
    let method = scene.coupling.method.parameters();
    let remembered = method.remembered_points(degree, exchanged);
    remembered.ok_or(ProbeError::RemembersOutputs { degree: exchanged })
}

fn states_of(scene: &Scene, models: &[v1::Model]) -> Result<Vec<Coordinate>, ProbeError> {
    let mut states = Vec::new();
    for (number, (subsystem, model)) in scene.subsystems.iter().zip(models).enumerate() {
        if model.states.is_empty() {
            return Err(ProbeError::HiddenState {
                subsystem: subsystem.name.clone(),
                model: model.name.clone(),
            });
        }
        states.extend(model.states.iter().map(|state| Coordinate {
            column: format!("{}.{}", subsystem.name, state.output),
            age: 0,
            setting: Setting::Parameter {
                subsystem: number,
                name: state.initial.clone(),
            },
        }));
    }
    Ok(states)
}

fn check_exact(simulation: &CoSimulation) -> Result<(), ProbeError> {
    for subsystem in simulation.subsystems() {
        if let Some(tolerance) = subsystem.tolerance {
            return Err(ProbeError::Inexact {
                subsystem: subsystem.name().to_owned(),
                tolerance,
            });
        }
    }
    Ok(())
}
