//! What `run.json` says of a run before there are numbers.

use linchpin_master::run::settings::Settings;
use linchpin_master::scene::{Degree, Method, Scene, StepControl};
use serde::Serialize;

use crate::commands::common::SceneArguments;

/// The scene of a run with all that decides about its results.
#[derive(Debug, Clone, Serialize)]
pub struct About {
    scene: String,
    case: Option<String>,
    scene_file: String,
    scene_text: String,
    overrides: Vec<String>,
    t_start: f64,
    t_end: f64,
    macro_step: f64,
    step_control: Option<StepControl>,
    degree: Degree,
    exchanged_degree: Degree,
    method: Method,
    /// Absent for methods without a corrector, which leave nothing to decide.
    settings: Option<Settings>,
    /// The macro point at which this process went on from a checkpoint; absent if it began at the start.
    pub resumed_at: Option<f64>,
    /// The model of every subsystem; empty before all workers have answered.
    pub models: Vec<SubsystemModel>,
    /// The columns of the table; empty before its first row.
    pub columns: Vec<ColumnUnit>,
}

/// The model of a subsystem.
#[derive(Debug, Clone, Serialize)]
pub struct SubsystemModel {
    /// Name of the subsystem.
    pub subsystem: String,
    /// Name of its model.
    pub model: String,
}

/// A column of the table of results.
#[derive(Debug, Clone, Serialize)]
pub struct ColumnUnit {
    /// Its name.
    pub name: String,
    /// Its unit; 1 for numbers without one, empty if a worker does not tell.
    pub unit: String,
}

impl About {
    /// The run of a scene that was read by `arguments`, or of a case of it.
    pub fn new(scene: &Scene, arguments: &SceneArguments, case: Option<&str>) -> Self {
        Self {
            scene: scene.name.clone(),
            case: case.map(str::to_owned),
            scene_file: arguments.scene.display().to_string(),
            scene_text: scene.text().to_owned(),
            overrides: arguments.set.iter().map(ToString::to_string).collect(),
            t_start: scene.t_start,
            t_end: scene.t_end,
            macro_step: scene.coupling.macro_step,
            step_control: scene.coupling.step_control,
            degree: scene.coupling.degree,
            exchanged_degree: scene.coupling.exchanged_degree,
            method: scene.coupling.method,
            settings: settings(scene),
            resumed_at: None,
            models: Vec::new(),
            columns: Vec::new(),
        }
    }
}

/// The constants that decided about the macro steps.
fn settings(scene: &Scene) -> Option<Settings> {
    let coupling = &scene.coupling;
    let varies = coupling.step_control.is_some();
    let follow = coupling.has_automatic_degree();
    let corrects = coupling.method.corrects();
    corrects.then(|| Settings::new(varies, follow))
}
