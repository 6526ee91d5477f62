//! The parts of a resolved scene: defaults filled in, references followed, units SI.

mod coupling;

use std::collections::BTreeMap;
use std::path::PathBuf;

use linchpin_proto::v1;
use serde::{Deserialize, Serialize};

pub use crate::joint::Kind as JointKind;
use crate::reading::overrides::Override;
pub use coupling::{
    Coupling, Degree, ImpactsAtJoints, Increment, Index, Iterations, Jacobian, Loads, Method,
    Order, Otherwise, Spring, StepControl, Variant,
};

/// Who serves a subsystem.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Served {
    /// A built-in model.
    BuiltIn,
    /// A worker that runs already, at `https://HOST:PORT`, `http://HOST:PORT` or `unix:/PATH`.
    Address(String),
    /// A program that the run starts: the program and its arguments.
    Command(Vec<String>),
    /// An FMU, which the run serves by a process of its own.
    Fmu(PathBuf),
}

/// Whether the fused exchange may be used with a worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Calls {
    /// The exchange stream where the worker serves it, otherwise single calls.
    Automatic,
    /// Single calls always.
    Unary,
}

/// One instance of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Subsystem {
    /// Its name, unique among subsystems and joints.
    pub name: String,
    /// Who serves it.
    pub served: Served,
    /// Its model; present for [`Served::BuiltIn`]. Absent: the only model of the worker.
    pub model: Option<String>,
    /// Parameters of the model, not yet checked against it.
    pub parameters: BTreeMap<String, v1::Value>,
    /// Parameters of the model, initial velocities, that are chosen so that the joints meet on velocity level.
    pub free_velocities: Vec<String>,
    /// Solver and its options; absent: the default of the model.
    pub solver: Option<v1::Solver>,
    /// How the worker is called.
    pub calls: Calls,
}

impl Subsystem {
    /// A subsystem with the name and the defaults of a built-in model.
    pub(super) fn built_in(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            served: Served::BuiltIn,
            model: Some(name.to_owned()),
            parameters: BTreeMap::new(),
            free_velocities: Vec::new(),
            solver: None,
            calls: Calls::Automatic,
        }
    }
}

/// One end of a joint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Side {
    /// Place in `Scene::subsystems`.
    pub subsystem: usize,
    /// Marker of that subsystem; absent: its only one.
    pub marker: Option<String>,
}

/// A constraint between two subsystems.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its name, unique among subsystems and joints.
    pub name: String,
    /// What it demands.
    pub kind: JointKind,
    /// The first side.
    pub a: Side,
    /// The second side, on another subsystem.
    pub b: Side,
    /// Where on the markers it holds.
    pub geometry: Geometry,
    /// Multipliers at the start, one for each condition of the joint, in N or N m; absent: computed.
    pub multiplier: Option<Vec<f64>>,
}

/// Points and axes of a joint as the scene gives them; how many components they must have depends on the markers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Points in the axes of markers a and b in m; default: the markers themselves.
    pub points: [Option<Vec<f64>>; 2],
    /// Axes in the axes of markers a and b, of any length.
    pub axes: [Option<Vec<f64>>; 2],
    /// Attitude of marker a in the axes of marker b that the joint keeps: in space a quaternion (w, x, y, z).
    pub attitude: Option<Vec<f64>>,
    /// The same in the plane: an angle in rad.
    pub angle: Option<f64>,
}

/// An output of one subsystem that is an input of another.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// Its name, unique among subsystems, joints and connections.
    pub name: String,
    /// Place in `Scene::subsystems`, and the output.
    pub from: (usize, String),
    /// Place in `Scene::subsystems`, and the input.
    pub to: (usize, String),
    /// Where the search for its value at the start begins.
    pub start: Option<f64>,
}

/// What is recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Every how many macro steps, or samples, 1 or more; default 1.
    pub every: usize,
    /// Time in s between samples; absent: results are those of macro points.
    pub interval: Option<f64>,
    /// Outputs as `subsystem.output`, beyond those that the coupling needs.
    pub variables: Option<Vec<String>>,
    /// What the picture of a run shows; none: motion, residuals and multipliers.
    pub panels: Vec<Panel>,
}

/// One panel of the picture of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Panel {
    /// Label of its axis, with the unit.
    pub label: String,
    /// Its curves; each is the sum of one or more result columns.
    pub curves: Vec<Vec<String>>,
    /// What they are shown over; absent: the time.
    pub over: Option<Over>,
}

/// The x axis of a panel whose curves are not over the time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Over {
    /// The sum of one or more result columns.
    pub column: Vec<String>,
    /// Label of the axis, with the unit; default: the columns.
    pub label: String,
}

/// How a run treats its workers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunSettings {
    /// Longest time for one answer of a worker in s; default 30.
    pub deadline: f64,
    /// Longest time until a started worker listens in s; default 10.
    pub start_timeout: f64,
    /// How often a worker that is lost in an exchange is made anew; default 3.
    pub recoveries: usize,
    /// Macro steps after which states of workers are exported; default 1000.
    pub export_every: usize,
    /// Time between two checkpoints in s; default 30.
    pub checkpoint_every: f64,
    /// Macro steps between two checkpoints in place of a time.
    pub checkpoint_steps: Option<usize>,
    /// Share of the macro steps that may be poor.
    pub most_poor: f64,
}

/// By what right the master calls workers on other machines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Security {
    /// Folder with its certificates, see `linchpin_proto::certificates`; absent: no TLS.
    pub certificates: Option<PathBuf>,
    /// Whether plain text may leave this machine; default false.
    pub plain_text: bool,
    /// File with the token that is shown to workers; absent: none.
    pub token: Option<PathBuf>,
}

/// A variant of the scene; one command runs all of them side by side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// Its name, unique among cases.
    pub name: String,
    /// What it changes.
    pub overrides: Vec<Override>,
}

/// What a convergence study compares with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// The closed form where there is one, otherwise the monolithic scene if one is named, otherwise the finest run.
    Automatic,
    /// The closed form of the solution, for scenes that have one.
    ClosedForm,
    /// The run of the scene that [`Monolithic`] names.
    Monolithic,
    /// The run with the smallest macro step.
    Finest,
}

/// The same system in one subsystem, without coupling: what coupled runs are compared with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Monolithic {
    /// Its scene.
    pub scene: PathBuf,
    /// Result columns, or sums of them, and what the monolithic scene calls them; names of a sum have ` + ` between them.
    pub columns: BTreeMap<String, String>,
}

/// A convergence study.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvergeSettings {
    /// Two or more different macro steps in s.
    pub macro_steps: Vec<f64>,
    /// What the runs are compared with; default automatic.
    pub reference: Reference,
}

/// A stability map over two quantities.
#[derive(Clone, Debug, PartialEq)]
pub struct StabilitySettings {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
}

/// A quantity that is varied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// The keys that all take the value, as in an override.
    pub keys: Vec<String>,
    /// What the axis shows; default the last part of the first key.
    pub label: String,
    /// Two or more values.
    pub values: Vec<f64>,
}

impl Axis {
    /// The overrides that give the quantity a value.
    pub fn overrides(&self, value: f64) -> Vec<Override> {
        let over_ride = |key: &String| Override {
            key: key.clone(),
            value: toml_number(value).to_string(),
        };
        self.keys.iter().map(over_ride).collect()
    }
}

/// Largest size up to which every integer is a number of double precision.
const LARGEST_EXACT_INTEGER: f64 = 9_007_199_254_740_992.0;

/// A whole number is written as such, so that it may also stand where only whole numbers are allowed.
pub(super) fn toml_number(value: f64) -> toml::Value {
    if value.fract() == 0.0 && value.abs() <= LARGEST_EXACT_INTEGER {
        toml::Value::Integer(value as i64)
    } else {
        toml::Value::Float(value)
    }
}
