//! `linchpin check`: validates a scene and starts nothing.

use linchpin_master::CoSimulation;
use linchpin_master::scene::{Case, Scene, Served, is_spectrum, load_spectrum};
use linchpin_master::setup::Options;

use super::CommandError;
use super::common::{SceneArguments, case_folders, print, warn};
use crate::connect::{Connector, Place};

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

/// Checks the scene and all its cases, or a file for `linchpin spectrum`.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    if is_spectrum(&arguments.scene.scene) {
        return check_spectrum(&arguments.scene);
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
        return Err(CommandError::NoSettings { path: path.clone() });
    }
    load_spectrum(path)?;
    print(format_args!("{}: ok\n", path.display()))
}

fn check_case(scene: &Scene, case: &Case) -> Result<(), CommandError> {
    let scene = scene.with_case(case)?;
    for warning in linchpin_master::scene::warnings(&scene) {
        warn(format_args!("case \"{}\": {warning}", case.name));
    }
    check(&scene).map_err(|error| error.in_case(&case.name))
}

/// Starts the scene with its built-in models in this process; joints only if there are no other models.
fn check(scene: &Scene) -> Result<(), CommandError> {
    let mut scene = scene.clone();
    let all = scene.subsystems.len();
    scene
        .subsystems
        .retain(|subsystem| subsystem.served == Served::BuiltIn);
    if scene.subsystems.len() < all {
        scene.joints.clear();
        scene.output.variables = None;
    }
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    CoSimulation::start(&scene, &mut connect, &Options::default()).map_err(CommandError::Run)?;
    Ok(())
}
