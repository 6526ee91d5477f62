//! The study file of `linchpin report`: which scenes run with which settings, as written and as resolved.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::assign::Assignment;
use super::coupling::METHOD_KEY;
use super::step_control::read_step;
use super::sweeps::{MACRO_STEPS, SET, read_macro_steps, set_assignments};
use crate::reading::error::SceneErrors;
use crate::reading::key::{Key, POSITIVE, Takes, texts};
use crate::reading::lists::sections;
use crate::reading::names::Registry;
use crate::reading::overrides::Override;
use crate::reading::place::Source;
use crate::reading::reader::{Field, Problems, Section, choice, collect, given};
use crate::reading::reference::find_name;
use crate::reading::text::text_of;
use crate::reading::written::Written;

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

/// The tables of a study file.
pub const STUDY_KEYS: [Key; 3] = [
    Key::new("study", Takes::Table(|| HEAD.to_vec()))
        .required("[study] with name")
        .means("the study as a whole"),
    Key::new("scene", Takes::Tables(|| SCENE.to_vec()))
        .required("[[scene]] with name, file and macro_steps")
        .means("a scene that runs with every setting"),
    Key::new("setting", Takes::Tables(|| SETTING.to_vec()))
        .required("[[setting]] with name and set")
        .means("a coupling method with its parameters"),
];
const HEAD: [Key; 4] = [
    Key::new("name", Takes::Name)
        .required("name = \"report\"")
        .means("name of the results folder"),
    Key::new("title", Takes::Text)
        .default("`name`")
        .means("heading of the page"),
    Key::new("measure", Takes::Choice(&texts(&MEASURES)))
        .default_first()
        .means("what errors are of"),
    Key::new(
        "targets",
        Takes::List(
            &Takes::Number(POSITIVE),
            "a list of one or more relative errors such as [1e-4, 1e-6]",
        ),
    )
    .default("`[1e-4, 1e-6, 1e-8]`")
    .means("relative errors whose cost is asked for"),
];
const SCENE: [Key; 6] = [
    Key::new("name", Takes::Name)
        .required("name = \"oscillator\"")
        .means("names it in the page"),
    Key::new("file", Takes::Text)
        .required("file = \"oscillator.toml\"")
        .means("scene file, from the folder of the study"),
    MACRO_STEPS,
    Key::new("trace_step", Takes::Number(POSITIVE))
        .default("the middle one of `macro_steps`")
        .means("H of the curves over time, s"),
    Key::new("measure", Takes::Choice(&texts(&MEASURES)))
        .default("that of `[study]`")
        .means("what errors are of"),
    SET,
];
const SETTING: [Key; 4] = [
    Key::new("name", Takes::Text)
        .required("name = \"weighted, k = 1\"")
        .means("names it in the page"),
    Key::new("set", Takes::Open(&[]))
        .required("set = { \"coupling.method\" = \"weighted\" }")
        .means(
            "what it sets, as in a `[[case]]`. A setting with `coupling.method` describes the \
             coupling completely: of what the scene says about it only `macro_step` stays",
        ),
    Key::new(
        "scenes",
        Takes::List(&Takes::Text, "a list of names of scenes of this study"),
    )
    .default("all")
    .means("names of those it is meant for"),
    Key::new("paper", Takes::Flag)
        .default("`false`")
        .means("`true`: the paper's own"),
];
const STUDY_FILE: &str = "study file";
const MEASURES: [(&str, Measure); 4] = [
    ("position", Measure::Position),
    ("velocity", Measure::Velocity),
    ("state", Measure::State),
    ("multiplier", Measure::Multiplier),
];
const DEFAULT_TARGETS: [f64; 3] = [1e-4, 1e-6, 1e-8];

/// Whether the file at `path` is a study, as one with a table `study` is; false if it cannot be read.
pub fn is_study(path: &Path) -> bool {
    Written::has_table(path, STUDY_KEYS[0].name)
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
    let root = Section::root(written)?;
    let [head, scenes, settings] = root.read(&STUDY_KEYS, problems);
    let head = head.and_then(|field| read_head(&field.section(problems)?, problems));
    let scene_tables = sections(scenes, problems);
    let setting_tables = sections(settings, problems);
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
    let [name, title, measure, targets] = section.read(&HEAD, problems);
    let name = name.and_then(|field| field.name(problems));
    let title = given(title, |field| field.text(problems));
    let measure = choice(measure, &MEASURES, problems);
    let targets = match targets {
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

fn read_targets(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
    if field.items(problems)?.is_empty() {
        return field.refuse(&field.list().1, problems);
    }
    let mut targets = field.numbers(problems)?;
    targets.sort_by(|one, other| other.total_cmp(one));
    Some(targets)
}

fn read_scene(
    section: &Section<'_>,
    measure: Measure,
    problems: &mut Problems<'_>,
) -> Option<StudyScene> {
    let [name, file, macro_steps, trace_step, own_measure, set] = section.read(&SCENE, problems);
    let name = name.and_then(|field| field.name(problems));
    let file = file.and_then(|field| field.text(problems));
    let macro_steps = macro_steps.and_then(|field| read_macro_steps(&field, None, problems));
    let trace_step = given(trace_step, |field| read_step(field, None, problems));
    let own_measure = given(own_measure, |field| field.choice(&MEASURES, problems));
    let set = read_set(section, set, problems);
    let macro_steps = macro_steps?;
    Some(StudyScene {
        name: name?.to_owned(),
        file: problems.written.folder().join(file?),
        trace_step: trace_step?.unwrap_or_else(|| middle(&macro_steps)),
        macro_steps,
        measure: own_measure?.unwrap_or(measure),
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
    let [name, set, for_scenes, paper] = section.read(&SETTING, problems);
    let name = name.and_then(|field| field.filled_text(problems));
    let set = read_set(section, set, problems);
    let places = given(for_scenes, |field| {
        collect(&field.texts(problems)?, |name| {
            find_name(name.text(problems)?, name, scene_names, problems)
        })
    });
    let is_paper = paper.map_or(Some(false), |field| field.flag(problems));
    Some(StudySetting {
        name: name?,
        set: set?,
        scenes: places?.unwrap_or_else(|| (0..scenes).collect()),
        is_paper: is_paper?,
    })
}

/// The key `set` of an entry; no settings if it is absent.
fn read_set(
    section: &Section<'_>,
    set: Option<Field<'_>>,
    problems: &mut Problems<'_>,
) -> Option<Settings> {
    given(set, |field| field.section(problems))?;
    Some(Settings {
        source: Arc::clone(problems.written.sources.first()?),
        assignments: set_assignments(section.table),
    })
}
