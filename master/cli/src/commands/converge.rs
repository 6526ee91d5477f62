//! `linchpin converge`: errors, observed orders and cost over the macro step.

use super::CommandError;
use super::common::{OutputArguments, SceneArguments};
use super::sharing::{SharingArguments, Sweep};
use crate::files::write_table;
use crate::output::study::StudyAbout;
use crate::study::converge::{
    assemble, draw_errors, draw_work_precision, number_of_runs, rows, runs, summary,
};

/// Run a scene over a list of macro steps and compare with the exact or the finest solution
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin converge scenes/s1/fig06a.toml --out out/fig06a
  linchpin converge scenes/oscillator.toml --macro-steps 1e-2,1e-3,1e-4 --reference closed-form
  linchpin converge scenes/s1/fig06a.toml --slurm 4 > fig06a.sbatch     in 4 parts on a cluster

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
    sharing: SharingArguments,

    #[command(flatten)]
    output: OutputArguments,
}

impl Arguments {
    /// The scene with what the flags say; the flags are checked like the keys of the file.
    fn scene_with_flags(&self) -> SceneArguments {
        let steps = self.macro_steps.iter();
        let steps = steps.map(|steps| ("converge.macro_steps", format!("[{steps}]")));
        let reference = self.reference.iter();
        let reference = reference.map(|own| ("converge.reference", own.clone()));
        self.scene.with(steps.chain(reference))
    }
}

/// Runs the study and writes table and pictures.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let given = arguments.scene_with_flags();
    let scene = given.load()?;
    let flags = "--macro-steps 1e-2,1e-3,1e-4";
    let settings = given.section(&scene.converge, "converge", flags)?;
    let output = &arguments.output;
    let tasks = number_of_runs(&scene, settings);
    let sweep = Sweep {
        command: "converge",
        name: &scene.name,
        about: StudyAbout::of_scene("converge", &scene, &given),
        identity: given.identity("converge", &scene),
        tasks,
        unit: "runs",
        progress: (tasks, "runs"),
    };
    arguments.sharing.carry_out(
        sweep,
        output,
        |share, tick| runs(&scene, settings, share, tick),
        |pieces, told, folder| {
            let found = assemble(&scene, settings, pieces)?;
            let cases = &found.results;
            told.missing(found.missing);
            write_table(&told.file("converge.csv"), rows(cases))?;
            draw_errors(cases, &told.picture("converge"))?;
            draw_work_precision(cases, &told.picture("work-precision"))?;
            output.conclude(&format!("{}\n", summary(cases)), folder.path())?;
            Ok(found.stopped)
        },
    )
}
