//! `linchpin spectrum`: stability, damping and period errors of integration schemes.

use std::path::PathBuf;

use linchpin_master::scene::load_spectrum;

use super::CommandError;
use super::common::{OutputArguments, print};
use crate::spectra::picture::{draw_curves, draw_region};
use crate::spectra::table::{summary, write_curves, write_region};
use crate::spectra::{curves, number_of_points, region};
use crate::study::progress;

/// Compare integration schemes of nonsmooth mechanics by their spectral radius and period error
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin spectrum scenes/s2/fig08.toml
  linchpin spectrum scenes/s2/fig06.toml --out out/fig06

Every scheme takes a step from each unit state of a vibrating mass; eigenvalues of the matrix that comes out give
spectral radius, period and damping over dt / T, the step as a share of the period. Writes DIR/spectrum.csv,
DIR/spectrum.svg and .png; for a [spectrum.region] DIR/region.csv, DIR/region.svg and .png: the parameters for which
generalised-alpha is stable.")]
pub struct Arguments {
    /// File with [spectrum] (TOML)
    #[arg(value_name = "FILE")]
    file: PathBuf,

    #[command(flatten)]
    output: OutputArguments,
}

/// Finds the spectra and writes tables and pictures.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let file = load_spectrum(&arguments.file)?;
    let folder = arguments.output.prepare_for(&file.name)?;
    let shows_progress = arguments.output.shows_progress();
    let bar = progress::bar(number_of_points(&file), "points", shows_progress);
    let tick = || bar.inc(1);
    let found = curves(&file, &tick)?;
    let settings = file.region.as_ref();
    let cells = settings.map_or(Vec::new(), |settings| region(settings, &tick));
    bar.finish_and_clear();
    let unwritten = |path: PathBuf| |source| CommandError::Table { path, source };
    if !found.is_empty() {
        let table = folder.join("spectrum.csv");
        write_curves(&found, &table).map_err(unwritten(table))?;
        draw_curves(&file, &found, &folder.join("spectrum"))?;
    }
    if let Some(settings) = settings {
        let table = folder.join("region.csv");
        write_region(&cells, &table).map_err(unwritten(table))?;
        draw_region(settings, &cells, &folder.join("region"))?;
    }
    if !arguments.output.quiet {
        let summary = summary(&found, &cells);
        print(format_args!("{summary}results in {}\n", folder.display()))?;
    }
    Ok(())
}
