//! The same system in one subsystem, without coupling.

use linchpin_master::scene::{self, Override, Scene};

use super::{Reference, Trajectory};
use crate::study::StudyError;
use crate::study::columns::{Column, terms};
use crate::study::runs::{Variant, number, watched, with_macro_step};

/// The monolithic scene of a coupled one.
#[derive(Debug, Clone)]
pub struct Monolithic {
    scene: Scene,
    /// What it calls the judged columns of the coupled scene.
    names: Vec<Option<String>>,
}

/// A reference that is interpolated has at least this many macro points.
const LEAST_STEPS: f64 = 20.0;

impl Monolithic {
    /// That of `scene`, over the same time; `None` if it names none, or if its system was changed since the file.
    ///
    /// # Errors
    /// The monolithic scene is wrong, or a column is not one of those that are compared.
    pub fn of(scene: &Scene, columns: &[Column]) -> Result<Option<Self>, StudyError> {
        let Some(named) = &scene.monolithic else {
            return Ok(None);
        };
        if !scene.is_system_of_file() {
            return Ok(None);
        }
        let strange = named.columns.keys().find(|name| {
            let mut columns = columns.iter();
            columns.all(|column| column.name != **name)
        });
        if let Some(strange) = strange {
            let message = format!("{strange:?} is not compared in studies");
            let known: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
            let help = format!("these columns are: {}", known.join(", "));
            let key = "monolithic.columns";
            return Err(scene.error(key, message, Some(help)).into());
        }
        let times = [
            number("scene.t_start", scene.t_start),
            number("scene.t_end", scene.t_end),
        ];
        let mut monolithic = scene::load(&named.scene, &times)?;
        let longest = (scene.t_end - scene.t_start) / LEAST_STEPS;
        if monolithic.coupling.macro_step > longest {
            monolithic = with_macro_step(&monolithic, longest)?;
        }
        let outputs = named.columns.values().flat_map(|sum| terms(sum));
        let variables = monolithic.output.variables.get_or_insert_default();
        variables.extend(outputs.map(str::to_owned));
        monolithic.output.every = 1;
        let names = columns
            .iter()
            .map(|own| named.columns.get(&own.name).cloned());
        Ok(Some(Self {
            scene: monolithic,
            names: names.collect(),
        }))
    }

    /// The reference: a run of the scene as it is.
    ///
    /// # Errors
    /// The run fails.
    pub fn reference(&self, variant: &Variant) -> Result<Reference, StudyError> {
        let mut trajectory = Trajectory::new(self.names.len());
        let outcome = watched(&self.scene, &self.names, |t, values| {
            trajectory.add(t, values);
        });
        let outcome = outcome.map_err(|error| variant.failed(error))?;
        outcome.map_err(|reason| StudyError::MonolithicDiverged {
            case: variant.in_words(),
            reason,
        })?;
        Ok(Reference::Run {
            at_points_only: vec![false; self.names.len()],
            trajectory,
        })
    }

    /// The scene with another tolerance of its solver and macro points so far apart, which leave the solver its own steps.
    ///
    /// # Errors
    /// The scene cannot have it.
    pub fn with_tolerance(&self, tolerance: f64, macro_step: f64) -> Result<Scene, StudyError> {
        let solver = Override {
            key: "subsystem.*.solver".to_owned(),
            value: format!("{{ kind = \"radau5\", rtol = {tolerance:?}, atol = {tolerance:?} }}"),
        };
        let step = number("coupling.macro_step", macro_step);
        let mut scene = self.scene.with(&[solver, step])?;
        scene.output = self.scene.output.clone();
        Ok(scene)
    }

    /// What it calls the judged columns of the coupled scene.
    pub fn names(&self) -> &[Option<String>] {
        &self.names
    }
}
