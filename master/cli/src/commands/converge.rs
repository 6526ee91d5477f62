//! `linchpin converge`: errors, observed orders and cost over the macro step.

use linchpin_master::scene::Override;

use super::CommandError;
use super::common::{OutputArguments, SceneArguments, print};
use crate::study::converge::{
    converge, draw_errors, draw_work_precision, number_of_runs, summary, write_csv,
};
use crate::study::progress;

/// Run a scene over a list of macro steps and compare with the exact or the finest solution
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin converge scenes/s1/fig06a.toml --out out/fig06a
  linchpin converge scenes/oscillator.toml --macro-steps 1e-2,1e-3,1e-4 --reference closed-form

Runs in parallel and in this process. Writes DIR/converge.csv, DIR/converge.svg and .png (errors over H) and
DIR/work-precision.svg and .png (errors over the number of integrations). A scene with cases gives one curve for each.")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,

    /// Macro steps in s, in place of converge.macro_steps of the scene
    #[arg(long, value_name = "H,H,..")]
    macro_steps: Option<String>,

    /// closed-form (scenes with an exact solution), monolithic (the scene that [monolithic] names), finest (the run with the
    /// smallest H), or automatic (the first of these that there is), in place of converge.reference of the scene
    #[arg(long, value_name = "REFERENCE")]
    reference: Option<String>,

    #[command(flatten)]
    output: OutputArguments,
}

impl Arguments {
    /// The scene with what the flags say; the flags are checked like the keys of the file.
    fn scene_with_flags(&self) -> SceneArguments {
        let mut arguments = self.scene.clone();
        let steps = self.macro_steps.iter().map(|steps| Override {
            key: "converge.macro_steps".to_owned(),
            value: format!("[{steps}]"),
        });
        let reference = self.reference.iter().map(|reference| Override {
            key: "converge.reference".to_owned(),
            value: reference.clone(),
        });
        arguments.set.extend(steps.chain(reference));
        arguments
    }
}

/// Runs the study and writes table and pictures.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let scene = arguments.scene_with_flags().load()?;
    let settings = scene
        .converge
        .as_ref()
        .ok_or_else(|| CommandError::NothingToStudy {
            path: arguments.scene.scene.clone(),
            section: "converge",
            flags: "--macro-steps 1e-2,1e-3,1e-4",
        })?;
    let folder = arguments.output.prepare(&scene)?;
    let bar = progress::bar(
        number_of_runs(&scene, settings),
        "runs",
        arguments.output.shows_progress(),
    );
    let cases = converge(&scene, settings, &|| bar.inc(1))?;
    bar.finish_and_clear();
    let table = folder.join("converge.csv");
    write_csv(&cases, &table).map_err(|source| CommandError::Table {
        path: table,
        source,
    })?;
    draw_errors(&cases, &folder.join("converge"))?;
    draw_work_precision(&cases, &folder.join("work-precision"))?;
    if !arguments.output.quiet {
        print(format_args!(
            "{}\nresults in {}\n",
            summary(&cases),
            folder.display()
        ))?;
    }
    Ok(())
}
