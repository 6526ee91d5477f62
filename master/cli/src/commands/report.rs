//! `linchpin report`: scenes with many settings, and what their errors cost, on one page.

use std::path::PathBuf;

use linchpin_master::scene::{is_study, load_study};

use super::CommandError;
use super::common::{OutputArguments, print};
use super::sharing::{SharingArguments, Sweep};
use crate::files::{write_table, write_text};
use crate::output::study::{StudyAbout, Told};
use crate::study::StudyError;
use crate::study::report::{Depth, Picture, Plan, Report, assemble, json, page, scenes};

/// Compare coupling methods on scenes: errors against cost, residuals, energy, stability, on one page
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin report
  linchpin report scenes/report.toml --out out/report
  linchpin report scenes/oscillator.toml scenes/double-pendulum.toml --quick
  linchpin report --slurm 5 > report.sbatch     on a cluster, each part with whole scenes

A study lists scenes, settings and macro steps; a scene alone gets the settings that the shipped study has for every scene.
Runs one after the other, in this process, since their time is measured. Writes DIR/report.html, which needs no network and
nothing beside it, DIR/report.csv (a row for every run), DIR/report.json, and every picture of the page as DIR/SCENE-NAME.svg
and .png. A run that diverges is a row that says so.")]
pub struct Arguments {
    /// One study file, or scene files
    #[arg(
        value_name = "STUDY.toml | SCENE.toml",
        default_value = "scenes/report.toml"
    )]
    files: Vec<PathBuf>,

    /// The three largest macro steps, once, and coarse maps: whether everything works
    #[arg(long)]
    quick: bool,

    #[command(flatten)]
    sharing: SharingArguments,

    #[command(flatten)]
    output: OutputArguments,
}

impl Arguments {
    fn plan(&self) -> Result<Plan, CommandError> {
        let depth = match self.quick {
            true => Depth::Quick,
            false => Depth::Full,
        };
        let study = self.files.iter().find(|file| is_study(file));
        match (study, &self.files[..]) {
            (Some(study), [_]) => Ok(Plan::of_study(&load_study(study)?, depth)?),
            (Some(study), _) => Err(CommandError::StudyAmongOthers {
                path: study.clone(),
            }),
            (None, files) => Ok(Plan::of_scenes(files, depth)?),
        }
    }
}

/// Runs the study and writes page and tables.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let plan = arguments.plan()?;
    let output = &arguments.output;
    let sweep = Sweep {
        command: "report",
        name: &plan.name,
        about: StudyAbout::of_files("report", &plan.name, &arguments.files),
        identity: plan.identity(),
        tasks: plan.scenes.len(),
        unit: "scenes",
        progress: (plan.number_of_tasks(), "runs"),
    };
    arguments.sharing.carry_out(
        sweep,
        output,
        |share, tick| Ok(scenes(&plan, share, tick)),
        |pieces, told, folder| {
            let found = assemble(&plan, pieces);
            told.missing(found.missing);
            write(&found.results, told)?;
            if !output.quiet {
                let page = folder.path().join(PAGE);
                print(format_args!("report in {}\n", page.display()))?;
            }
            Ok(found.stopped)
        },
    )
}

const PAGE: &str = "report.html";

fn write(found: &Report, told: &mut Told<'_>) -> Result<(), CommandError> {
    write_table(&told.file("report.csv"), found.rows())?;
    let json = json(found).map_err(StudyError::Json)?;
    write_text(&told.file("report.json"), &json)?;
    write_text(&told.file(PAGE), &page(found)?)?;
    for scene in &found.scenes {
        for picture in Picture::all(scene) {
            let stem = told.picture(&format!("{}-{}", scene.name, picture.ending));
            picture.chart.write(&stem)?;
        }
    }
    Ok(())
}
