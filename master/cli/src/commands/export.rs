//! `linchpin export`: results for other programs.

use std::fs;
use std::path::PathBuf;

use clap::ValueEnum;

use super::CommandError;
use super::common::print;
use crate::export::bodies::bodies;
use crate::export::vtk::Series;
use crate::results::Recorded;

/// Write the results of a run for other programs
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin run scenes/four-bar.toml --animate
  linchpin export out/four-bar --format vtk
  linchpin export out/four-bar --every 10 --to /tmp/four-bar

vtk: markers as points over time, and a line through those of every subsystem, for ParaView: open OUT/vtk/NAME.pvd. The table has the
markers of joints; with linchpin run --animate it has all of them. Nothing is run.")]
pub struct Arguments {
    /// Folder that linchpin run wrote to
    #[arg(value_name = "OUT")]
    folder: PathBuf,

    /// What is written
    #[arg(long, value_enum, default_value_t = Format::Vtk)]
    format: Format,

    /// Take every so many rows; the last one is always there
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,

    /// Folder for the files; made if it does not exist [default: OUT/FORMAT]
    #[arg(long, value_name = "DIR")]
    to: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Poly-data for ParaView and VTK
    Vtk,
}

/// Reads the results and writes them.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let Format::Vtk = arguments.format;
    let runs = Recorded::open(&arguments.folder)?.cases()?;
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
