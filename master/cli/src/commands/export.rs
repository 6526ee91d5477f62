//! `linchpin export`: results, and scenes, for other programs.

use std::fs;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use linchpin_master::scene::Override;

use super::CommandError;
use super::common::{SceneArguments, print};
use crate::export::bodies::bodies;
use crate::export::fmu::{Contents, Exported, Version, archive};
use crate::export::vtk::Series;
use crate::results::Recorded;

/// Write the results of a run, or a scene as an FMU, for other programs
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin run scenes/four-bar.toml --animate
  linchpin export out/four-bar --format vtk
  linchpin export out/four-bar --every 10 --to /tmp/four-bar
  linchpin export scenes/oscillator.toml oscillator.fmu
  linchpin export scenes/oscillator.toml oscillator.fmu --fmi 3 --output mass1.x --parameter mass1.c

vtk: markers as points over time, and a line through those of every subsystem, for ParaView: open OUT/vtk/NAME.pvd. The table has the
markers of joints; with linchpin run --animate it has all of them. Nothing is run.

A scene and the name of a file make an FMU for co-simulation: the coupled system, whose built-in models run inside, while other workers are
started or reached as the scene says. Its outputs are the outputs of models and the multipliers among the result columns.")]
pub struct Arguments {
    /// Folder that linchpin run wrote to, or a scene
    #[arg(value_name = "OUT | SCENE.toml")]
    source: PathBuf,

    /// The FMU to be written, of a scene
    #[arg(value_name = "FILE.fmu")]
    fmu: Option<PathBuf>,

    /// What is written of results
    #[arg(long, value_enum, default_value_t = Format::Vtk, conflicts_with = "fmu")]
    format: Format,

    /// Take every so many rows; the last one is always there
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..), conflicts_with = "fmu")]
    every: u32,

    /// Folder for the files; made if it does not exist [default: OUT/FORMAT]
    #[arg(long, value_name = "DIR", conflicts_with = "fmu")]
    to: Option<PathBuf>,

    /// Version of FMI of the FMU
    #[arg(long, value_enum, default_value_t = Version::Two, requires = "fmu")]
    fmi: Version,

    /// A result column that is an output of the FMU; can be given several times [default: all outputs and multipliers]
    #[arg(long, value_name = "COLUMN", requires = "fmu")]
    output: Vec<String>,

    /// A parameter of a subsystem that can be set before the start of the FMU; can be given several times
    #[arg(long, value_name = "SUBSYSTEM.NAME", requires = "fmu")]
    parameter: Vec<String>,

    /// The case of a scene that has some
    #[arg(long, value_name = "NAME", requires = "fmu")]
    case: Option<String>,

    /// Change a setting of the scene, e.g. coupling.macro_step=5e-4
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "fmu")]
    set: Vec<Override>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Poly-data for ParaView and VTK
    Vtk,
}

/// Reads what there is and writes it.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    match &arguments.fmu {
        Some(path) => write_fmu(arguments, path),
        None => write_results(arguments),
    }
}

fn write_fmu(arguments: &Arguments, path: &Path) -> Result<(), CommandError> {
    let scene = SceneArguments {
        scene: arguments.source.clone(),
        set: arguments.set.clone(),
    };
    let text = scene.load()?.text().to_owned();
    let contents = Contents {
        token: String::new(),
        scene: text,
        settings: arguments.set.iter().map(ToString::to_string).collect(),
        case: arguments.case.clone(),
        outputs: arguments.output.clone(),
        parameters: arguments.parameter.clone(),
    };
    let exported = Exported::of(contents)?;
    archive::write(&exported, arguments.fmi, path)?;
    print(format_args!("{}\n", path.display()))
}

fn write_results(arguments: &Arguments) -> Result<(), CommandError> {
    let Format::Vtk = arguments.format;
    let runs = Recorded::open(&arguments.source)?.cases()?;
    for run in &runs {
        let bodies = bodies(run.columns());
        if bodies.is_empty() {
            return Err(CommandError::NothingToExport {
                folder: run.folder().to_owned(),
            });
        }
        let default = || run.folder().join("vtk");
        let mut folder = arguments.to.clone().unwrap_or_else(default);
        let case = run.case().and_then(|_| run.folder().file_name());
        if let (Some(case), true) = (case, arguments.to.is_some()) {
            folder.push(case);
        }
        fs::create_dir_all(&folder).map_err(CommandError::unwritable(&folder))?;
        let mut series = Series::new(&folder, run.scene());
        let (mut number, mut outcome, mut last) = (0_u64, Ok(()), None);
        run.rows(|row| {
            let is_taken = number.is_multiple_of(u64::from(arguments.every));
            last = (!is_taken).then(|| row.to_vec());
            if is_taken && outcome.is_ok() {
                outcome = series.add(&bodies, row);
            }
            number += 1;
        })?;
        outcome?;
        if let Some(row) = last {
            series.add(&bodies, &row)?;
        }
        print(format_args!("{}\n", series.finish()?.display()))?;
    }
    Ok(())
}
