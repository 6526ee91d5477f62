//! `linchpin check`: validates a scene and starts no worker but those of FMUs.

use std::path::Path;

use linchpin_master::CoSimulation;
use linchpin_master::scene::{
    Case, Scene, Served, Subsystem, is_spectrum, is_study, load_spectrum, load_study,
};
use linchpin_master::setup::{Options, check_some};
use serde::Serialize;

use super::CommandError;
use super::common::{SceneArguments, case_folders, print, print_json, warn};
use crate::connect::{Connector, Place};
use crate::study::report::{Depth, Plan};

/// Validate a scene without running it
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin check scenes/oscillator.toml
  linchpin check scenes/oscillator.toml --set coupling.index=3 --set coupling.degree=1
  linchpin check scenes/oscillator.toml --json

No worker is started but those of FMUs, which are asked what they can do.

Exit code 0: the scene can run (warnings may have been printed); 2: it cannot.")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,

    /// Print what was found as JSON: mistakes with their places, warnings
    #[arg(long)]
    json: bool,
}

/// What was found in a file that is sound.
struct Checked {
    /// What kind of file it is.
    kind: Kind,
    /// What is known to go wrong nevertheless.
    warnings: Vec<String>,
    /// Subsystems of workers that would have to be started.
    unchecked: Vec<String>,
}

/// Kinds of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Scene,
    Study,
    Spectrum,
}

impl Checked {
    fn sound(kind: Kind) -> Self {
        Self {
            kind,
            warnings: Vec::new(),
            unchecked: Vec::new(),
        }
    }
}

/// Checks the scene and all its cases, or a file for `linchpin spectrum` or `linchpin report`.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let path = &arguments.scene.scene;
    let checked = if is_spectrum(path) {
        check_spectrum(&arguments.scene)
    } else if is_study(path) {
        check_study(&arguments.scene)
    } else {
        check_scene(&arguments.scene)
    };
    if arguments.json {
        print_json(&Document::of(path, &checked))?;
        return checked.map(|_| ());
    }
    let checked = checked?;
    let file = path.display();
    match (checked.kind, &checked.unchecked[..]) {
        (Kind::Study, _) => print(format_args!(
            "{file}: ok as a study; linchpin report runs it\n"
        )),
        (_, []) => print(format_args!("{file}: ok\n")),
        (_, unchecked) => print(format_args!(
            "{file}: ok as far as it can be told without the workers of {}; their models and parameters, and the joints, were \
             not checked\n",
            unchecked.join(", ")
        )),
    }
}

/// What was found, as JSON.
#[derive(Serialize)]
struct Document<'a> {
    file: String,
    ok: bool,
    /// Absent for a file with mistakes.
    kind: Option<Kind>,
    errors: Vec<Mistake>,
    warnings: &'a [String],
    unchecked: &'a [String],
}

/// A mistake and where it is.
#[derive(Serialize)]
struct Mistake {
    message: String,
    help: Option<String>,
    /// The file, or the setting of the command line.
    origin: Option<String>,
    line: Option<usize>,
    column: Option<usize>,
    case: Option<String>,
}

impl<'a> Document<'a> {
    fn of(path: &Path, checked: &'a Result<Checked, CommandError>) -> Self {
        let found = checked.as_ref().ok();
        Self {
            file: path.display().to_string(),
            ok: checked.is_ok(),
            kind: found.map(|own| own.kind),
            errors: checked.as_ref().err().map_or_else(Vec::new, mistakes),
            warnings: found.map_or(&[], |own| &own.warnings),
            unchecked: found.map_or(&[], |own| &own.unchecked),
        }
    }
}

fn mistakes(error: &CommandError) -> Vec<Mistake> {
    let Some(errors) = error.scene_errors() else {
        return vec![Mistake {
            message: error.to_string(),
            help: None,
            origin: None,
            line: None,
            column: None,
            case: None,
        }];
    };
    let mistakes = errors.iter().map(|error| {
        let place = error.place.as_ref();
        Mistake {
            message: error.message(),
            help: error.help(),
            origin: place.map(|place| place.origin().to_owned()),
            line: place.map(|place| place.line),
            column: place.map(|place| place.column),
            case: error.case.clone(),
        }
    });
    mistakes.collect()
}

fn check_scene(arguments: &SceneArguments) -> Result<Checked, CommandError> {
    let scene = arguments.load()?;
    let mut checked = Checked::sound(Kind::Scene);
    let told = linchpin_master::scene::warnings(&scene);
    checked.warnings = told.iter().map(ToString::to_string).collect();
    case_folders(&scene)?;
    check(&scene)?;
    for case in &scene.cases {
        checked.warnings.extend(check_case(&scene, case)?);
    }
    let elsewhere = scene.subsystems.into_iter();
    let elsewhere = elsewhere.filter(|subsystem| !can_be_asked(subsystem));
    checked.unchecked = elsewhere.map(|subsystem| subsystem.name).collect();
    Ok(checked)
}

fn check_spectrum(arguments: &SceneArguments) -> Result<Checked, CommandError> {
    let path = &arguments.scene;
    if !arguments.set.is_empty() {
        return Err(CommandError::NoSettings {
            path: path.clone(),
            what: "describes spectra of integration schemes",
        });
    }
    load_spectrum(path)?;
    Ok(Checked::sound(Kind::Spectrum))
}

/// Checks a study with its scenes and settings.
fn check_study(arguments: &SceneArguments) -> Result<Checked, CommandError> {
    let path = &arguments.scene;
    if !arguments.set.is_empty() {
        return Err(CommandError::NoSettings {
            path: path.clone(),
            what: "is a study",
        });
    }
    Plan::of_study(&load_study(path)?, Depth::Full)?;
    Ok(Checked::sound(Kind::Study))
}

/// Checks a case; its warnings go to the error output, and are given.
fn check_case(scene: &Scene, case: &Case) -> Result<Vec<String>, CommandError> {
    let scene = scene.with_case(case)?;
    let told = linchpin_master::scene::warnings(&scene);
    let told = told
        .iter()
        .map(|warning| format!("case \"{}\": {warning}", case.name));
    let told: Vec<String> = told.collect();
    told.iter().for_each(warn);
    check(&scene).map_err(|error| error.in_case(&case.name))?;
    Ok(told)
}

/// Built-in models are asked in this process, FMUs each in one that is started for it.
fn can_be_asked(subsystem: &Subsystem) -> bool {
    matches!(subsystem.served, Served::BuiltIn | Served::Fmu(_))
}

/// Starts the scene, with built-in models in this process; where other workers would be needed, only what can be told without them.
fn check(scene: &Scene) -> Result<(), CommandError> {
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    let checked = match scene.subsystems.iter().all(can_be_asked) {
        true => CoSimulation::start(scene, &mut connect, &Options::default()).map(|_| ()),
        false => check_some(scene, can_be_asked, &mut connect),
    };
    checked.map_err(CommandError::Run)
}
