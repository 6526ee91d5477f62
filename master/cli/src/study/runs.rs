//! What all studies need to know about a scene and its runs.

use std::convert::Infallible;

use linchpin_master::RunError;
use linchpin_master::results::{Row, Statistics};
use linchpin_master::scene::{Override, Scene, SceneErrors};
use linchpin_master::setup::{Connect, Options, describe};
use linchpin_proto::v1::Model;

use super::StudyError;
use super::columns::{self, Column, places, sum};
use crate::connect::{Connector, Place};
use crate::interrupt;
use crate::simulate::{Recorder, SimulateError, simulate};

/// A variant of the scene that is studied on its own.
pub struct Variant {
    /// Name of the case; that of the scene if it has no cases.
    pub name: String,
    /// The scene with what the case changes.
    pub scene: Scene,
}

impl Variant {
    /// The cases of the scene, or the scene itself if it has none.
    pub fn all(scene: &Scene) -> Result<Vec<Self>, StudyError> {
        if scene.cases.is_empty() {
            let name = scene.name.clone();
            let scene = scene.clone();
            return Ok(vec![Self { name, scene }]);
        }
        let variant = |case| {
            let scene = scene.with_case(case)?;
            let name = case.name.clone();
            Ok(Self { name, scene })
        };
        scene.cases.iter().map(variant).collect()
    }

    /// For messages.
    pub fn in_words(&self) -> String {
        format!("\"{}\"", self.name)
    }

    /// The error of a run of this variant.
    pub fn failed(&self, source: RunError) -> StudyError {
        StudyError::Run {
            case: self.in_words(),
            source,
        }
    }

    /// Nothing where a run of this variant diverged; an error that has nothing to do with the numbers is given back.
    pub fn nothing_if_diverged<T>(&self, error: RunError) -> Result<Option<T>, StudyError> {
        let diverged = divergence(error).map(|_| None);
        diverged.map_err(|error| self.failed(error))
    }

    /// The result columns that studies judge; `models` are those of [`Variant::models`].
    pub fn judged_columns(&self, models: &[Model]) -> Result<Vec<Column>, StudyError> {
        columns::judged(&self.scene, models).map_err(|source| self.failed(source))
    }

    /// The models of all subsystems.
    pub fn models(&self) -> Result<Vec<Model>, StudyError> {
        in_process(|connect| describe(&self.scene, connect)).map_err(|source| self.failed(source))
    }
}

/// Gives `action` connections to built-in models in this process; they end with it.
pub fn in_process<T>(action: impl FnOnce(&mut Connect<'_>) -> T) -> T {
    let connector = Connector::new(Place::InProcess);
    action(&mut |scene, subsystem| connector.connect(scene, subsystem))
}

/// How a run diverged; an error that has nothing to do with the numbers is given back.
pub fn divergence(error: RunError) -> Result<String, RunError> {
    let has_diverged = match &error {
        RunError::Diverged { .. }
        | RunError::Grown { .. }
        | RunError::NotFinite { .. }
        | RunError::Singular { .. } => true,
        RunError::Worker { source, .. } => source.is_recoverable(),
        _ => false,
    };
    if has_diverged {
        Ok(error.to_string())
    } else {
        Err(error)
    }
}

/// One run in this process; the inner result says whether it came to its end, or how it diverged.
pub fn simulated(
    scene: &Scene,
    recorder: &mut impl Recorder<Error = Infallible>,
) -> Result<Result<Statistics, String>, RunError> {
    let interrupt = interrupt::of_process();
    if interrupt.is_requested() {
        return Err(RunError::Interrupted { t: scene.t_start });
    }
    let connector = Connector::new(Place::InProcess).stopped_by(interrupt);
    match simulate(scene, &connector, &Options::default(), recorder) {
        Ok(statistics) => Ok(Ok(statistics)),
        Err(SimulateError::Run(error)) => divergence(error).map(Err),
        Err(SimulateError::Record(never)) => match never {},
    }
}

/// The same; `take` gets the time and the values of the named columns at every macro point, `None` for those that the
/// run does not have.
pub fn watched(
    scene: &Scene,
    names: &[Option<String>],
    take: impl FnMut(f64, &[Option<f64>]),
) -> Result<Result<Statistics, String>, RunError> {
    let mut watcher = Watcher {
        names,
        places: Vec::new(),
        values: Vec::new(),
        take,
    };
    simulated(scene, &mut watcher)
}

/// Looks at sums of result columns.
struct Watcher<'a, F> {
    names: &'a [Option<String>],
    places: Vec<Option<Vec<usize>>>,
    values: Vec<Option<f64>>,
    take: F,
}

impl<F: FnMut(f64, &[Option<f64>])> Recorder for Watcher<'_, F> {
    type Error = Infallible;

    fn begin(&mut self, row: &Row) -> Result<(), Infallible> {
        let names = self.names.iter();
        self.places = names.map(|name| places(row, name.as_deref()?)).collect();
        Ok(())
    }

    fn record(&mut self, row: &Row) -> Result<(), Infallible> {
        let value = |places: &Option<Vec<usize>>| Some(sum(row, places.as_deref()?));
        self.values.clear();
        self.values.extend(self.places.iter().map(value));
        (self.take)(row.values()[0], &self.values);
        Ok(())
    }
}

/// A number for a key.
pub fn number(key: &str, value: f64) -> Override {
    Override {
        key: key.to_owned(),
        value: format!("{value:?}"),
    }
}

/// The scene with another macro step.
pub fn with_macro_step(scene: &Scene, macro_step: f64) -> Result<Scene, SceneErrors> {
    let changed = scene.with(&[number("coupling.macro_step", macro_step)])?;
    let mut changed = changed.with_fixed_steps();
    changed.output = scene.output.clone();
    Ok(changed)
}
