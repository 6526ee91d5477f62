//! What a report is to run: a study file, or scenes with the usual settings.

use std::path::PathBuf;

use linchpin_master::scene::{
    self, Measure, Scene, SceneErrors, Settings, StudyFile, StudyScene, StudySetting,
};

/// The study whose settings scenes get that stand in no study.
const USUAL: &str = include_str!("../../../../../scenes/report.toml");
const USUAL_ORIGIN: &str = "scenes/report.toml";

/// Macro steps of a scene that names none: shares of its time.
const SHARES: [f64; 5] = [50.0, 100.0, 200.0, 400.0, 800.0];

/// With [`Depth::Quick`] that many macro steps.
const QUICK_STEPS: usize = 3;

/// How much of a study is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// All of it, each run several times if it is short.
    Full,
    /// The largest macro steps, once, and coarse maps: whether everything works.
    Quick,
}

/// A study, ready to run.
pub struct Plan {
    /// Its name.
    pub name: String,
    /// Its heading.
    pub title: String,
    /// Relative errors whose cost is asked for.
    pub targets: Vec<f64>,
    /// How much of it is run.
    pub depth: Depth,
    /// Its scenes.
    pub scenes: Vec<PlannedScene>,
}

/// A scene with the settings that it runs with.
pub struct PlannedScene {
    pub(super) name: String,
    pub(super) file: PathBuf,
    pub(super) scene: Scene,
    /// What the study sets in it, as `KEY=VALUE`.
    set: Vec<String>,
    pub(super) measure: Measure,
    /// From the largest to the smallest.
    pub(super) macro_steps: Vec<f64>,
    pub(super) trace_step: f64,
    pub(super) settings: Vec<PlannedSetting>,
}

/// A setting in a scene.
pub struct PlannedSetting {
    pub(super) name: String,
    pub(super) is_paper: bool,
    pub(super) set: Vec<String>,
    pub(super) scene: Scene,
}

impl Plan {
    /// That of a study file.
    ///
    /// # Errors
    /// All mistakes in a scene, or the settings that do not fit it.
    pub fn of_study(study: &StudyFile, depth: Depth) -> Result<Self, SceneErrors> {
        let scenes = study.scenes.iter().enumerate().map(|(place, planned)| {
            let settings: Vec<&StudySetting> = study.settings_of(place).collect();
            PlannedScene::new(planned, &settings, depth)
        });
        Ok(Self {
            name: study.name.clone(),
            title: study.title.clone(),
            targets: study.targets.clone(),
            depth,
            scenes: scenes.collect::<Result<_, _>>()?,
        })
    }

    /// That of scenes alone: their own macro steps, and the settings of the shipped study that are for every scene.
    ///
    /// # Errors
    /// All mistakes in a scene.
    pub fn of_scenes(files: &[PathBuf], depth: Depth) -> Result<Self, SceneErrors> {
        let usual = scene::parse_study(USUAL, USUAL_ORIGIN)?;
        let settings = usual.general_settings();
        let settings: Vec<&StudySetting> = settings.iter().collect();
        let scenes = files.iter().map(|file| {
            let scene = scene::load(file, &[])?;
            PlannedScene::new(&with_its_own_steps(&scene, file.clone()), &settings, depth)
        });
        let scenes: Vec<PlannedScene> = scenes.collect::<Result<_, _>>()?;
        let names: Vec<&str> = scenes.iter().map(|scene| scene.name.as_str()).collect();
        Ok(Self {
            name: names.join("-"),
            title: names.join(", "),
            targets: usual.targets,
            depth,
            scenes,
        })
    }

    /// Everything that decides about its results.
    pub fn identity(&self) -> String {
        let mut parts = vec![format!("report, {:?}, {:?}", self.depth, self.targets)];
        for own in &self.scenes {
            let numbers = (&own.macro_steps, own.trace_step, own.measure);
            parts.push(format!("{}: {numbers:?}, {:?}", own.name, own.set));
            parts.push(own.scene.text().to_owned());
            let settings = own.settings.iter();
            parts.extend(settings.map(|setting| format!("{}: {:?}", setting.name, setting.set)));
        }
        parts.join("\n")
    }

    /// Number of runs and of points of stability maps, for the progress.
    pub fn number_of_tasks(&self) -> usize {
        let of_scene = |scene: &PlannedScene| scene.number_of_tasks(self.depth);
        self.scenes.iter().map(of_scene).sum()
    }
}

fn with_its_own_steps(scene: &Scene, file: PathBuf) -> StudyScene {
    let duration = scene.t_end - scene.t_start;
    let macro_steps = match &scene.converge {
        Some(settings) => settings.macro_steps.clone(),
        None => SHARES.map(|share| duration / share).to_vec(),
    };
    StudyScene {
        name: scene.name.clone(),
        file,
        trace_step: scene.coupling.macro_step,
        macro_steps,
        measure: Measure::Position,
        set: Settings::none(),
    }
}

impl PlannedScene {
    fn new(
        planned: &StudyScene,
        settings: &[&StudySetting],
        depth: Depth,
    ) -> Result<Self, SceneErrors> {
        let scene = scene::load(&planned.file, &[])?.with_settings(&planned.set)?;
        let settings = settings.iter().map(|setting| {
            let overrides = setting.set.overrides();
            Ok(PlannedSetting {
                name: setting.name.clone(),
                is_paper: setting.is_paper,
                set: overrides.iter().map(ToString::to_string).collect(),
                scene: scene.with_settings(&setting.set)?,
            })
        });
        let settings = settings.collect::<Result<_, SceneErrors>>()?;
        let mut macro_steps = planned.macro_steps.clone();
        macro_steps.sort_by(|one, other| other.total_cmp(one));
        if depth == Depth::Quick {
            macro_steps.truncate(QUICK_STEPS);
        }
        Ok(Self {
            name: planned.name.clone(),
            file: planned.file.clone(),
            scene,
            set: planned
                .set
                .overrides()
                .iter()
                .map(ToString::to_string)
                .collect(),
            measure: planned.measure,
            trace_step: match depth {
                Depth::Full => planned.trace_step,
                Depth::Quick => planned.trace_step.max(macro_steps[macro_steps.len() - 1]),
            },
            macro_steps,
            settings,
        })
    }
}
