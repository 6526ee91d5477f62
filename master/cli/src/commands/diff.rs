//! `linchpin diff`: compares the results of two runs.

use std::path::PathBuf;

use super::CommandError;
use super::common::{print, print_json};
use crate::comparison::of_folders;

/// Compare two runs: settings that differ, and the largest difference of every column
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin diff out/oscillator /tmp/fine
  linchpin diff out/oscillator /tmp/fine --tolerance 1e-6
  linchpin diff out/oscillator /tmp/fine --json

A difference is told as it is, as a share of the largest magnitude of its column, and with its time. Where the runs have rows at other
times, those of the coarser table are compared with straight lines between those of the finer one, and what these may miss is told.

Exit code 0: no column differs by more than the tolerance; 1: one does, or one of the runs lacks columns, cases or times of the other;
2: they cannot be compared.")]
pub struct Arguments {
    /// Folder that linchpin run wrote to
    #[arg(value_name = "A")]
    a: PathBuf,

    /// Another one
    #[arg(value_name = "B")]
    b: PathBuf,

    /// What a difference may be as a share of the size of its column; 0: numbers must be equal
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, value_parser = share)]
    tolerance: f64,

    /// Print the comparison as JSON, with all columns
    #[arg(long)]
    json: bool,
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(share) if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err("it must be a number from 0 to 1, such as 1e-6".into()),
    }
}

/// Compares the runs and prints what was found.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let comparison = of_folders(&arguments.a, &arguments.b, arguments.tolerance)?;
    match arguments.json {
        true => print_json(&comparison)?,
        false => print(&comparison)?,
    }
    match comparison.equal {
        true => Ok(()),
        false => Err(CommandError::Different {
            differences: comparison.differences(),
        }),
    }
}
