//! The study file of `linchpin report`: which scenes run with which settings, as written and as resolved.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::assign::Assignment;
use super::coupling::METHOD_KEY;
use super::step_control::read_step;
use super::sweeps::{read_macro_steps, set_assignments};
use crate::reading::error::SceneErrors;
use crate::reading::lists::{collect, sections};
use crate::reading::names::Registry;
use crate::reading::overrides::Override;
use crate::reading::place::Source;
use crate::reading::reader::{Field, POSITIVE, Problems, Section};
use crate::reading::reference::find_name;
use crate::reading::text::text_of;
use crate::reading::written::{Value, Written};

/// A study: every scene with every setting that is meant for it, over the macro steps of the scene.
#[derive(Clone, Debug)]
pub struct StudyFile {
    /// Its name.
    pub name: String,
    /// Heading of its report; default the name.
    pub title: String,
    /// Relative errors whose cost is asked for, from the largest to the smallest; default 1e-4, 1e-6, 1e-8.
    pub targets: Vec<f64>,
    /// The scenes, one or more.
    pub scenes: Vec<StudyScene>,
    /// The settings, one or more.
    pub settings: Vec<StudySetting>,
}

/// A scene of a study.
#[derive(Clone, Debug)]
pub struct StudyScene {
    /// Its name, unique among the scenes.
    pub name: String,
    /// Its file.
    pub file: PathBuf,
    /// Two or more different macro steps in s.
    pub macro_steps: Vec<f64>,
    /// Macro step in s of the curves over time; default the middle one of `macro_steps`.
    pub trace_step: f64,
    /// What the errors are of.
    pub measure: Measure,
    /// What the study changes in the scene.
    pub set: Settings,
}

/// A coupling method with its parameters.
#[derive(Clone, Debug)]
pub struct StudySetting {
    /// Its name, unique among the settings.
    pub name: String,
    /// What it sets.
    pub set: Settings,
    /// Places of the scenes that it is meant for.
    pub scenes: Vec<usize>,
    /// Whether these are parameters that the paper itself uses.
    pub is_paper: bool,
}

/// What errors are of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Positions of all markers.
    Position,
    /// Velocities of all markers.
    Velocity,
    /// Positions and velocities of all markers as one vector.
    State,
    /// Multipliers of all joints.
    Multiplier,
}

/// Values for keys of a scene, with their places in the study file.
///
/// One that sets `coupling.method` describes the whole coupling: of what the scene says about it only the macro step stays.
#[derive(Clone, Debug)]
pub struct Settings {
    pub(super) source: Arc<Source>,
    pub(super) assignments: Vec<Assignment>,
}

impl StudyFile {
    /// The settings that are meant for a scene, by its place.
    pub fn settings_of(&self, scene: usize) -> impl Iterator<Item = &StudySetting> {
        let settings = self.settings.iter();
        settings.filter(move |setting| setting.scenes.contains(&scene))
    }

    /// The settings that are meant for all scenes of the study.
    pub fn general_settings(&self) -> Vec<StudySetting> {
        let is_general = |setting: &&StudySetting| setting.scenes.len() == self.scenes.len();
        self.settings.iter().filter(is_general).cloned().collect()
    }
}

impl Settings {
    /// No settings.
    pub fn none() -> Self {
        Self {
            source: Arc::new(Source::file("", "")),
            assignments: Vec::new(),
        }
    }

    /// The keys with their values.
    pub fn overrides(&self) -> Vec<Override> {
        let over_ride = |assignment: &Assignment| Override {
            key: assignment.key.clone(),
            value: assignment.node.to_toml().to_string(),
        };
        self.assignments.iter().map(over_ride).collect()
    }

    pub(super) fn choose_method(&self) -> bool {
        let mut keys = self.assignments.iter().map(|assignment| &assignment.key);
        keys.any(|key| key == METHOD_KEY)
    }
}

const STUDY_FILE: &str = "study file";
const MEASURES: [(&str, Measure); 4] = [
    ("position", Measure::Position),
    ("velocity", Measure::Velocity),
    ("state", Measure::State),
    ("multiplier", Measure::Multiplier),
];
const TARGETS: &str = "a list of one or more relative errors such as [1e-4, 1e-6]";
const DEFAULT_TARGETS: [f64; 3] = [1e-4, 1e-6, 1e-8];
const NAMES: &str = "a list of names of scenes of this study";

/// Whether the file at `path` is a study, as one with a table `study` is; false if it cannot be read.
pub fn is_study(path: &Path) -> bool {
    let text = text_of(path, STUDY_FILE).ok();
    let written = text.and_then(|text| Written::parse(&text, "", STUDY_FILE).ok());
    let root = written.map(|written| written.root.value);
    matches!(root, Some(Value::Table(table)) if table.contains_key("study"))
}

/// Reads a study file; its paths count from its own folder.
///
/// # Errors
/// All mistakes in the file. The scenes that it names are not read.
pub fn load_study(path: &Path) -> Result<StudyFile, SceneErrors> {
    let text = text_of(path, STUDY_FILE)?;
    parse_study(&text, &path.display().to_string())
}

/// Like [`load_study`], for the text of a study; `origin` is its path.
///
/// # Errors
/// All mistakes in the text.
pub fn parse_study(text: &str, origin: &str) -> Result<StudyFile, SceneErrors> {
    let written = Written::parse(text, origin, STUDY_FILE)?;
    let mut problems = Problems::new(&written);
    let study = read(&written, &mut problems);
    problems.finish(study)
}

fn read(written: &Written, problems: &mut Problems<'_>) -> Option<StudyFile> {
    let Value::Table(table) = &written.root.value else {
        return None;
    };
    let root = Section::root(written, table);
    root.allow_only(&["study", "scene", "setting"], problems);
    let head = root
        .require("study", "[study] with name", problems)
        .and_then(|field| field.section(problems))
        .and_then(|section| read_head(&section, problems));
    root.require(
        "scene",
        "[[scene]] with name, file and macro_steps",
        problems,
    );
    root.require("setting", "[[setting]] with name and set", problems);
    let scene_tables = sections(&root, "scene", problems);
    let setting_tables = sections(&root, "setting", problems);
    let scene_names = Registry::collect("scene", &scene_tables, None, problems);
    Registry::collect("setting", &setting_tables, None, problems);
    let measure = head.as_ref().map_or(Measure::Position, |head| head.measure);
    let scenes = collect(&scene_tables, |table| read_scene(table, measure, problems));
    let settings = collect(&setting_tables, |table| {
        read_setting(table, &scene_names, scene_tables.len(), problems)
    });
    let head = head?;
    Some(StudyFile {
        title: head.title,
        name: head.name,
        targets: head.targets,
        scenes: scenes?,
        settings: settings?,
    })
}

struct Head {
    name: String,
    title: String,
    measure: Measure,
    targets: Vec<f64>,
}

fn read_head(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Head> {
    section.allow_only(&["name", "title", "measure", "targets"], problems);
    let name = section
        .require("name", "name = \"report\"", problems)
        .and_then(|field| field.name(problems));
    let title = match section.get("title") {
        Some(field) => field.text(problems).map(Some),
        None => Some(None),
    };
    let measure = read_measure(section, Measure::Position, problems);
    let targets = match section.get("targets") {
        Some(field) => read_targets(&field, problems),
        None => Some(DEFAULT_TARGETS.to_vec()),
    };
    let name = name?;
    Some(Head {
        title: title?.unwrap_or(name).to_owned(),
        name: name.to_owned(),
        measure: measure?,
        targets: targets?,
    })
}

fn read_measure(
    section: &Section<'_>,
    default: Measure,
    problems: &mut Problems<'_>,
) -> Option<Measure> {
    let field = section.get("measure");
    field.map_or(Some(default), |field| field.choice(&MEASURES, problems))
}

fn read_targets(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
    let items = field.items(TARGETS, problems)?;
    if items.is_empty() {
        return field.wrong_type(TARGETS, problems);
    }
    let mut targets = collect(&items, |item| item.number(&POSITIVE, problems))?;
    targets.sort_by(|one, other| other.total_cmp(one));
    Some(targets)
}

fn read_scene(
    section: &Section<'_>,
    measure: Measure,
    problems: &mut Problems<'_>,
) -> Option<StudyScene> {
    let keys = [
        "name",
        "file",
        "macro_steps",
        "trace_step",
        "measure",
        "set",
    ];
    section.allow_only(&keys, problems);
    let name = section
        .require("name", "name = \"oscillator\"", problems)
        .and_then(|field| field.name(problems));
    let file = section
        .require("file", "file = \"oscillator.toml\"", problems)
        .and_then(|field| field.text(problems));
    let macro_steps = section
        .require("macro_steps", "macro_steps = [1e-2, 1e-3, 1e-4]", problems)
        .and_then(|field| read_macro_steps(&field, None, problems));
    let trace_step = match section.get("trace_step") {
        Some(field) => read_step(&field, None, problems).map(Some),
        None => Some(None),
    };
    let measure = read_measure(section, measure, problems);
    let set = read_set(section, problems);
    let macro_steps = macro_steps?;
    Some(StudyScene {
        name: name?.to_owned(),
        file: problems.written.folder().join(file?),
        trace_step: trace_step?.unwrap_or_else(|| middle(&macro_steps)),
        macro_steps,
        measure: measure?,
        set: set?,
    })
}

fn middle(macro_steps: &[f64]) -> f64 {
    let mut sorted = macro_steps.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}

fn read_setting(
    section: &Section<'_>,
    scene_names: &Registry<'_>,
    scenes: usize,
    problems: &mut Problems<'_>,
) -> Option<StudySetting> {
    section.allow_only(&["name", "set", "scenes", "paper"], problems);
    let name_field = section.require("name", "name = \"weighted, k = 1\"", problems);
    let name = name_field.and_then(|field| match field.text(problems)? {
        "" => field.wrong_type("a text that is not empty", problems),
        name => Some(name.to_owned()),
    });
    section.require(
        "set",
        "set = { \"coupling.method\" = \"weighted\" }",
        problems,
    );
    let set = read_set(section, problems);
    let places = match section.get("scenes") {
        Some(field) => field.texts(NAMES, problems).and_then(|names| {
            collect(&names, |name| {
                find_name(name.text(problems)?, name, scene_names, problems)
            })
        }),
        None => Some((0..scenes).collect()),
    };
    let is_paper = match section.get("paper") {
        Some(field) => field.flag(problems),
        None => Some(false),
    };
    Some(StudySetting {
        name: name?,
        set: set?,
        scenes: places?,
        is_paper: is_paper?,
    })
}

/// The key `set` of an entry; no settings if it is absent.
fn read_set(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Settings> {
    if let Some(field) = section.get("set") {
        field.section(problems)?;
    }
    Some(Settings {
        source: Arc::clone(problems.written.sources.first()?),
        assignments: set_assignments(section.table),
    })
}
