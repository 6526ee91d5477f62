//! `linchpin spectrum`: stability, damping and period errors of integration schemes.

use std::path::PathBuf;

use linchpin_master::scene::load_spectrum;

use super::CommandError;
use super::common::OutputArguments;
use crate::files::write_table;
use crate::output::study::{StudyAbout, study};
use crate::spectra::picture::{draw_curves, draw_region};
use crate::spectra::table::{curve_rows, region_rows, summary};
use crate::spectra::{curves, number_of_points, region};

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
    let folder = arguments.output.claim(&file.name)?;
    let output = &arguments.output;
    let settings = file.region.as_ref();
    let files = [arguments.file.clone()];
    let about = StudyAbout::of_files("spectrum", &file.name, &files);
    study(&folder, about, |told| {
        let points = number_of_points(&file);
        let (found, cells) = output.with_progress(points, "points", |tick| {
            let cells = |settings| region(settings, tick);
            let found = curves(&file, tick)?;
            Ok::<_, CommandError>((found, settings.map_or(Vec::new(), cells)))
        })?;
        if !found.is_empty() {
            write_table(&told.file("spectrum.csv"), curve_rows(&found))?;
            draw_curves(&file, &found, &told.picture("spectrum"))?;
        }
        if let Some(settings) = settings {
            write_table(&told.file("region.csv"), region_rows(&cells))?;
            draw_region(settings, &cells, &told.picture("region"))?;
        }
        output.conclude(&summary(&found, &cells), folder.path())?;
        Ok(None)
    })
}
