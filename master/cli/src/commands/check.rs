//! `linchpin check`: validates a scene and starts nothing.

use linchpin_master::CoSimulation;
use linchpin_master::cosimulation::Options;
use linchpin_master::scene::{Case, Scene, Served};

use super::CommandError;
use super::common::SceneArguments;
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

/// Checks the scene and all its cases.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let scene = arguments.scene.load()?;
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
        println!("{}: ok", arguments.scene.scene.display());
    } else {
        println!(
            "{}: ok as far as it can be told without the workers of {}; their models, markers and parameters were \
             not checked",
            arguments.scene.scene.display(),
            elsewhere.join(", ")
        );
    }
    Ok(())
}

fn check_case(scene: &Scene, case: &Case) -> Result<(), CommandError> {
    let scene = scene.with_case(case)?;
    for warning in linchpin_master::scene::warnings(&scene) {
        eprintln!("warning: case \"{}\": {warning}", case.name);
    }
    check(&scene).map_err(|error| error.in_case(&case.name))
}

/// Builds the built-in models in this process; if there are no others, the whole start is tried.
fn check(scene: &Scene) -> Result<(), CommandError> {
    if scene
        .subsystems
        .iter()
        .any(|subsystem| subsystem.served != Served::BuiltIn)
    {
        return Ok(());
    }
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    CoSimulation::start(scene, &mut connect, &Options::default()).map_err(CommandError::Run)?;
    Ok(())
}
