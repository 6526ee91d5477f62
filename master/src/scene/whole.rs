//! The scene as resolved.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::resolved::{
    Case, Connection, ConvergeSettings, Coupling, Joint, Monolithic, Output, RunSettings, Security,
    StabilitySettings, Subsystem,
};
use crate::reading::error::{SceneError, SceneErrors};
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::place::Place;
use crate::reading::written::Written;

/// A scene as resolved. Times in s, all units SI; everything is finite and within its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Start of the simulated time; default 0.
    pub t_start: f64,
    /// End of the simulated time, after the start.
    pub t_end: f64,
    /// How the subsystems are coupled.
    pub coupling: Coupling,
    /// What is coupled, at least one.
    pub subsystems: Vec<Subsystem>,
    /// The constraints between the subsystems.
    pub joints: Vec<Joint>,
    /// The signals between the subsystems.
    pub connections: Vec<Connection>,
    /// What is recorded.
    pub output: Output,
    /// How the run treats its workers.
    pub run: RunSettings,
    /// By what right workers on other machines are called.
    pub security: Security,
    /// Variants that one command runs side by side.
    pub cases: Vec<Case>,
    /// The convergence study.
    pub converge: Option<ConvergeSettings>,
    /// The stability map.
    pub stability: Option<StabilitySettings>,
    /// What runs of the scene are compared with.
    pub monolithic: Option<Monolithic>,
    pub(super) written: Arc<Written>,
}

/// Sections that do not decide about a run.
const APART: [&str; 5] = ["case", "converge", "monolithic", "security", "stability"];

impl Scene {
    /// The same with macro steps of one length: studies look at the method, not at the control of its steps.
    #[must_use]
    pub fn with_fixed_steps(mut self) -> Self {
        self.coupling.step_control = None;
        self
    }

    /// The text of the scene file.
    pub fn text(&self) -> &str {
        self.written.text()
    }

    /// Every setting of the scene by its dotted key, with all that is put into it beside the file: entries of a list go by their
    /// names. What is about studies and cases is left out, for it decides about no run. Numbers of equal value have equal texts.
    pub fn settings(&self) -> BTreeMap<String, String> {
        let mut settings = self.written.settings();
        let is_of_run = |key: &String| {
            let section = key.split('.').next().unwrap_or_default();
            !APART.contains(&section)
        };
        settings.retain(|key, _| is_of_run(key));
        settings
    }

    /// Where a key is set, such as `subsystem.mass1.parameters.m`, or the nearest key around it; absent if the scene
    /// says nothing about it.
    pub fn place(&self, key: &str) -> Option<Place> {
        let node = self.written.nearest_node(key)?;
        self.written.place(&node.spot)
    }

    /// A mistake that only a worker can find, with the place of its key.
    pub fn error(
        &self,
        key: &str,
        message: impl Into<String>,
        help: Option<String>,
    ) -> SceneErrors {
        let kind = SceneErrorKind::RefusedByWorker {
            key: key.to_owned(),
            message: message.into(),
            help,
        };
        SceneErrors::from(SceneError::new(self.place(key), kind))
    }
}
