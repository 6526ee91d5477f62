//! What `run.json` says of a run before there are numbers.

use linchpin_master::results::{Column, Quantity, Row};
use linchpin_master::run::settings::Settings;
use linchpin_master::scene::{Degree, Method, Panel, Scene, StepControl};
use serde::{Deserialize, Serialize};

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
    /// The panels that the scene asks for; none: those of the quantities.
    panels: Vec<Panel>,
    /// By how much pictures show multipliers earlier (s).
    multiplier_delay: f64,
    /// The model of every subsystem; empty before all workers have answered.
    pub models: Vec<SubsystemModel>,
    /// The columns of the table; empty before its first row.
    pub columns: Vec<ReportedColumn>,
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
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReportedColumn {
    /// What it shows.
    #[serde(flatten)]
    pub column: Column,
    /// Whether the picture shows it, unless it is told what to show.
    #[serde(default)]
    pub drawn: bool,
}

impl ReportedColumn {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.column.name
    }

    /// What kind of number it is.
    pub fn quantity(&self) -> Quantity {
        self.column.quantity
    }

    /// The columns of a row, of which the picture shows the usual ones and those that the scene asks for.
    pub fn of_row(row: &Row, scene: &Scene) -> Vec<Self> {
        let asked = scene.output.variables.as_deref().unwrap_or_default();
        let columns = row.descriptions().iter().enumerate();
        let reported = columns.map(|(place, column)| Self {
            drawn: row.is_drawn(place) || asked.contains(&column.name),
            column: column.clone(),
        });
        reported.collect()
    }
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
            panels: scene.output.panels.clone(),
            multiplier_delay: multiplier_delay(scene),
            models: Vec::new(),
            columns: Vec::new(),
        }
    }
}

/// With `k = 0` a corrected multiplier is the mean over its step, so it belongs to the middle of the step.
pub(super) fn multiplier_delay(scene: &Scene) -> f64 {
    if scene.coupling.multipliers_are_step_means() {
        scene.coupling.macro_step / 2.0
    } else {
        0.0
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

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A column that is drawn.
    pub fn column(name: &str, unit: &str, quantity: Quantity) -> ReportedColumn {
        ReportedColumn {
            column: Column {
                name: name.into(),
                unit: unit.into(),
                description: String::new(),
                quantity,
                marker: None,
            },
            drawn: true,
        }
    }
}
