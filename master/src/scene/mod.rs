//! The scene: what is coupled, how, and for how long.
//!
//! [`load`] reads a TOML file into a tree of values with their places (the file as written) and resolves it into a
//! [`Scene`]: defaults filled in, names followed, every value checked. All mistakes are reported together, each with its
//! place, the value found, what is allowed, and the nearest name. [`warnings`] tells which sound scenes are known to be
//! unstable.

mod connection;
mod coupling;
mod degree;
mod error;
mod error_kind;
mod formula;
mod index;
mod joint;
mod monolithic;
mod names;
pub(crate) mod nearest;
mod output;
mod overrides;
mod place;
mod reader;
mod reference;
mod resolve;
mod resolved;
mod spectrum;
mod stability_rules;
mod step_control;
mod study;
mod subsystem;
mod sweeps;
#[cfg(test)]
mod tests;
mod variants;
mod written;

use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;

pub use error::{SceneError, SceneErrors};
pub use error_kind::{Names, SceneErrorKind};
pub use formula::Formula;
pub use overrides::{NotAnOverride, Override};
pub use place::Place;
pub use resolved::{
    Axis, Calls, Case, Connection, ConvergeSettings, Coupling, Degree, Geometry, Increment, Index,
    Iterations, Jacobian, Joint, JointKind, Loads, Method, Monolithic, Order, Otherwise, Output,
    Over, Panel, Reference, RunSettings, Served, Side, Spring, StabilitySettings, StepControl,
    Subsystem, Variant,
};
pub use spectrum::{
    RegionPoint, SpectrumCurve, SpectrumFile, SpectrumRegion, SpectrumScheme, is_spectrum,
    load_spectrum, parse_spectrum,
};
pub(crate) use stability_rules::highest_stable_degree;
pub use stability_rules::{Warning, warnings};
pub use study::{
    Measure, Settings, StudyFile, StudyScene, StudySetting, is_study, load_study, parse_study,
};
pub use subsystem::is_worker_address;

use written::Written;

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
    /// Variants that one command runs side by side.
    pub cases: Vec<Case>,
    /// The convergence study.
    pub converge: Option<ConvergeSettings>,
    /// The stability map.
    pub stability: Option<StabilitySettings>,
    /// What runs of the scene are compared with.
    pub monolithic: Option<Monolithic>,
    written: Arc<Written>,
}

/// Reads a scene file and puts overrides into it.
///
/// # Errors
/// All mistakes in the file, in its cases and studies, and in the overrides.
pub fn load(path: &Path, overrides: &[Override]) -> Result<Scene, SceneErrors> {
    let text = text_of(path, SCENE_FILE)?;
    parse(&text, &path.display().to_string(), overrides)
}

/// What a scene is, for messages.
const SCENE_FILE: &str = "scene file";

fn text_of(path: &Path, document: &'static str) -> Result<String, SceneErrors> {
    let bytes = std::fs::read(path).map_err(|source| {
        let path = path.to_owned();
        let kind = match source.kind() {
            ErrorKind::NotFound => SceneErrorKind::NotFound { document, path },
            _ => SceneErrorKind::Unreadable {
                document,
                path,
                source,
            },
        };
        SceneError::new(None, kind)
    })?;
    String::from_utf8(bytes).map_err(|error| {
        let kind = SceneErrorKind::NotUtf8 {
            document,
            path: path.to_owned(),
            offset: error.utf8_error().valid_up_to(),
        };
        SceneErrors::from(SceneError::new(None, kind))
    })
}

/// Like [`load`], for the text of a scene; `origin` names it in messages.
///
/// # Errors
/// All mistakes in the text, in its cases and studies, and in the overrides.
pub fn parse(text: &str, origin: &str, overrides: &[Override]) -> Result<Scene, SceneErrors> {
    let written = Written::parse(text, origin, SCENE_FILE)?;
    variants::resolve_checked(written, overrides)
}

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
