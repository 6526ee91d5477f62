//! A study in parts: what the studies' commands share.

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::CommandError;
use super::common::{OutputArguments, print};
use super::slurm;
use crate::output::part::{self, gather};
use crate::output::study::{StudyAbout, Told, study};
use crate::output::{OutputFolder, Program};
use crate::study::{Pieces, Share, StudyError};

/// Which part of a study is done here.
#[derive(Debug, Clone, clap::Args)]
#[group(multiple = false)]
pub struct SharingArguments {
    /// Do part I of N only, into DIR/parts/I-of-N
    #[arg(long, value_name = "I/N")]
    part: Option<Share>,

    /// Put N parts together that were done with --part
    #[arg(long, value_name = "N", value_parser = parts)]
    merge: Option<usize>,

    /// Print a batch script for Slurm that does the study in N parts; nothing is computed
    #[arg(long, value_name = "N", value_parser = parts)]
    slurm: Option<usize>,
}

/// Most parts of a study.
const MOST_PARTS: usize = 100_000;

fn parts(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(parts) if (1..=MOST_PARTS).contains(&parts) => Ok(parts),
        _ => Err(format!("it must be a whole number from 1 to {MOST_PARTS}")),
    }
}

/// A study as its command describes it.
pub struct Sweep<'a> {
    /// The command.
    pub command: &'static str,
    /// Its name, of which that of the folder is made.
    pub name: &'a str,
    /// For `run.json`.
    pub about: StudyAbout,
    /// Everything that decides about the results.
    pub identity: String,
    /// How many tasks can be given to different parts.
    pub tasks: usize,
    /// What these are, in the plural.
    pub unit: &'static str,
    /// How many steps the progress of the whole study has, and what they are.
    pub progress: (usize, &'static str),
}

impl SharingArguments {
    /// Does what is asked for: all, a part, the end, or a script. `compute` does a share of the tasks, `write` makes the results of
    /// what was found, and says what is missing and why.
    ///
    /// # Errors
    /// Those of the study; [`CommandError::TooManyParts`], [`CommandError::Part`].
    pub fn carry_out<R: Serialize + DeserializeOwned>(
        &self,
        sweep: Sweep<'_>,
        output: &OutputArguments,
        compute: impl FnOnce(Share, &(dyn Fn() + Sync)) -> Result<Pieces<R>, StudyError>,
        write: impl FnOnce(
            Pieces<R>,
            &mut Told<'_>,
            &OutputFolder,
        ) -> Result<Option<StudyError>, CommandError>,
    ) -> Result<(), CommandError> {
        let of_share = self.part.map(Share::of);
        if let Some(parts) = of_share.or(self.merge).or(self.slurm)
            && parts > sweep.tasks
        {
            return Err(CommandError::TooManyParts {
                parts,
                tasks: sweep.tasks,
                unit: sweep.unit,
            });
        }
        if let Some(parts) = self.slurm {
            return print_script(&sweep, parts);
        }
        let (steps, unit) = sweep.progress;
        if let Some(share) = self.part {
            let folder = output.claim_within(sweep.name, &share.folder())?;
            return study(&folder, sweep.about, |told| {
                let steps = steps * share.count(sweep.tasks) / sweep.tasks;
                let pieces = output.with_progress(steps, unit, |tick| compute(share, tick))?;
                part::write(&told.file(part::FILE), &sweep.identity, share, &pieces)?;
                let summary = format!("{}: part {share}\n", sweep.name);
                output.conclude(&summary, folder.path())?;
                Ok(pieces.stopped)
            });
        }
        let folder = output.claim(sweep.name)?;
        study(&folder, sweep.about, |told| {
            let pieces = match self.merge {
                Some(parts) => gather(folder.path(), &sweep.identity, parts, sweep.tasks)?,
                None => output.with_progress(steps, unit, |tick| compute(Share::WHOLE, tick))?,
            };
            write(pieces, told, &folder)
        })
    }
}

fn print_script(sweep: &Sweep<'_>, parts: usize) -> Result<(), CommandError> {
    let program = std::env::current_exe()?.to_string_lossy().into_owned();
    let name = format!("linchpin-{}", sweep.command);
    let words = Program::this().command;
    print(slurm::script(&program, &words, &name, parts))
}
