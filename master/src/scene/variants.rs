//! The same scene with other values: overrides, cases, and the points of a stability map.

use super::assign::Assignment;
use super::resolve::resolve;
use super::resolved::{Axis, Case, Subsystem};
use super::study::Settings;
use super::sweeps::{axis_assignments, set_assignments};
use super::whole::Scene;
use crate::reading::error::{SceneError, SceneErrors};
use crate::reading::overrides::Override;
use crate::reading::written::{Value, Written};

impl Scene {
    /// The same file with further overrides; those that it has already stay, and later ones win.
    ///
    /// Nothing is read from the disk again; the cost is that of walking through the settings once.
    ///
    /// # Errors
    /// Every mistake that the overrides bring in.
    pub fn with(&self, overrides: &[Override]) -> Result<Self, SceneErrors> {
        let mut written = Written::clone(&self.written);
        let errors = written.apply_overrides(overrides);
        resolve(written, errors)
    }

    /// The scene of one of its cases. Unlike [`Scene::with`], mistakes have their place in the file.
    ///
    /// # Errors
    /// Every mistake that the case brings in; none for the cases of a scene that was loaded as it is.
    pub fn with_case(&self, case: &Case) -> Result<Self, SceneErrors> {
        match self
            .written
            .list_entry("case", &case.name)
            .map(|entry| &entry.value)
        {
            Some(Value::Table(entry)) => self.assigned(&set_assignments(entry)),
            _ => self.with(&case.overrides),
        }
    }

    /// The scene with settings of a study.
    ///
    /// # Errors
    /// Every mistake that they bring in, with its place in the study file.
    pub fn with_settings(&self, settings: &Settings) -> Result<Self, SceneErrors> {
        let mut written = Written::clone(&self.written);
        if settings.choose_method() {
            written.set_coupling_aside();
        }
        let errors = written.assign_from(&settings.source, &settings.assignments);
        resolve(written, errors)
    }

    /// Whether this is the same system as the file has without overrides: subsystems, joints, connections and start, whatever
    /// the solvers and the coupling.
    pub fn is_system_of_file(&self) -> bool {
        let file = Written::clone(&self.written).without_overrides();
        let same = |file: Self| {
            let subsystem = |own: &Subsystem| Subsystem {
                solver: None,
                ..own.clone()
            };
            let subsystems = self.subsystems.iter().map(subsystem);
            subsystems.eq(file.subsystems.iter().map(subsystem))
                && self.joints == file.joints
                && self.connections == file.connections
                && self.t_start == file.t_start
        };
        let file = file.and_then(|file| resolve(file, Vec::new()).ok());
        file.is_some_and(same)
    }

    fn assigned(&self, assignments: &[Assignment]) -> Result<Self, SceneErrors> {
        let mut written = Written::clone(&self.written);
        let errors = written.assign(assignments);
        resolve(written, errors)
    }

    /// The scene, if all its variants are sound.
    pub(super) fn check_variants(self) -> Result<Self, SceneErrors> {
        let mut errors: Vec<SceneError> = Vec::new();
        for case in &self.cases {
            for mut error in self.with_case(case).err().into_iter().flatten() {
                error.case = Some(case.name.clone());
                errors.push(error);
            }
        }
        errors.extend(self.check_map().err().into_iter().flatten());
        if errors.is_empty() {
            Ok(self)
        } else {
            Err(SceneErrors::new(errors))
        }
    }

    /// Tries the lower and the left edge of the stability map, so that every value of both axes is tried once.
    fn check_map(&self) -> Result<(), SceneErrors> {
        let Some(map) = &self.stability else {
            return Ok(());
        };
        let at = |axis: &Axis, name: &str, value: f64| {
            let node = self.written.nearest_node(name);
            node.map_or_else(Vec::new, |node| axis_assignments(axis, node, value))
        };
        let (first_x, first_y) = (map.x.values.first(), map.y.values.first());
        let lower = map.x.values.iter().zip(first_y.into_iter().cycle());
        let left = first_x.into_iter().cycle().zip(&map.y.values);
        for (&x, &y) in lower.chain(left) {
            let mut assignments = at(&map.x, "stability.x", x);
            assignments.extend(at(&map.y, "stability.y", y));
            self.assigned(&assignments)?;
        }
        Ok(())
    }
}

/// Resolves a scene with overrides and checks all that can be derived from it.
pub(super) fn resolve_checked(
    mut written: Written,
    overrides: &[Override],
) -> Result<Scene, SceneErrors> {
    let errors = written.apply_overrides(overrides);
    resolve(written, errors)?.check_variants()
}
