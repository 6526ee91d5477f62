//! `linchpin check`: validates a scene and starts nothing.

use linchpin_master::CoSimulation;
use linchpin_master::scene::{
    Case, Scene, Served, Subsystem, is_spectrum, is_study, load_spectrum, load_study,
};
use linchpin_master::setup::{Options, check_some};

use super::CommandError;
use super::common::{SceneArguments, case_folders, print, warn};
use crate::connect::{Connector, Place};
use crate::study::report::{Depth, Plan};

/// Validate a scene without starting anything
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin check scenes/oscillator.toml
  linchpin check scenes/oscillator.toml --set coupling.index=3 --set coupling.degree=1

Exit code 0: the scene can run (warnings may have been printed); 2: it cannot.")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
}

/// Checks the scene and all its cases, or a file for `linchpin spectrum` or `linchpin report`.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    if is_spectrum(&arguments.scene.scene) {
        return check_spectrum(&arguments.scene);
    }
    if is_study(&arguments.scene.scene) {
        return check_study(&arguments.scene);
    }
    let scene = arguments.scene.load()?;
    case_folders(&scene)?;
    check(&scene)?;
    for case in &scene.cases {
        check_case(&scene, case)?;
    }
    let elsewhere: Vec<&str> = scene
        .subsystems
        .iter()
        .filter(|subsystem| subsystem.served != Served::BuiltIn)
        .map(|subsystem| subsystem.name.as_str())
        .collect();
    if elsewhere.is_empty() {
        return print(format_args!("{}: ok\n", arguments.scene.scene.display()));
    }
    print(format_args!(
        "{}: ok as far as it can be told without the workers of {}; their models and parameters, and the joints, were \
         not checked\n",
        arguments.scene.scene.display(),
        elsewhere.join(", ")
    ))
}

fn check_spectrum(arguments: &SceneArguments) -> Result<(), CommandError> {
    let path = &arguments.scene;
    if !arguments.set.is_empty() {
        return Err(CommandError::NoSettings {
            path: path.clone(),
            what: "describes spectra of integration schemes",
        });
    }
    load_spectrum(path)?;
    print(format_args!("{}: ok\n", path.display()))
}

/// Checks a study with its scenes and settings.
fn check_study(arguments: &SceneArguments) -> Result<(), CommandError> {
    let path = &arguments.scene;
    if !arguments.set.is_empty() {
        return Err(CommandError::NoSettings {
            path: path.clone(),
            what: "is a study",
        });
    }
    Plan::of_study(&load_study(path)?, Depth::Full)?;
    print(format_args!(
        "{}: ok as a study; linchpin report runs it\n",
        path.display()
    ))
}

fn check_case(scene: &Scene, case: &Case) -> Result<(), CommandError> {
    let scene = scene.with_case(case)?;
    for warning in linchpin_master::scene::warnings(&scene) {
        warn(format_args!("case \"{}\": {warning}", case.name));
    }
    check(&scene).map_err(|error| error.in_case(&case.name))
}

/// Starts the scene in this process; where other workers would be needed, only what can be told of the built-in models.
fn check(scene: &Scene) -> Result<(), CommandError> {
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    let is_built_in = |subsystem: &Subsystem| subsystem.served == Served::BuiltIn;
    let checked = match scene.subsystems.iter().all(is_built_in) {
        true => CoSimulation::start(scene, &mut connect, &Options::default()).map(|_| ()),
        false => check_some(scene, is_built_in, &mut connect),
    };
    checked.map_err(CommandError::Run)
}
