//! `linchpin plot`: draws the results of a run again.

use std::path::{Path, PathBuf};

use glob::Pattern;

use super::CommandError;
use super::common::print;
use crate::plot::Format;
use crate::results::{Recorded, ReportedColumn, Target, draw};

/// Draw results again: other columns, other times, another file; nothing is run
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin plot out/oscillator
  linchpin plot out/oscillator --columns 'mass*.x,link.lambda' --from 0.2 --to 0.4
  linchpin plot out/oscillator --columns 'mass?.v' --file velocities.svg
  linchpin plot out/oscillator --list

Reads results.csv and run.json of a run that is done, failed or still under way. Every quantity and unit has panels of its own, with
at most eight curves in each; unit quaternions are shown by the angle by which their marker has turned since the start. Marked are
impacts and macro steps that were repeated.")]
pub struct Arguments {
    /// Folder that linchpin run wrote to; that of a scene with cases is drawn with all of them
    #[arg(value_name = "OUT")]
    folder: PathBuf,

    /// Columns to draw: names, or patterns with * and ?, with commas between [default: those that the run draws]
    #[arg(long, short, value_name = "PATTERN,..", value_delimiter = ',', value_parser = pattern)]
    columns: Vec<Pattern>,

    /// Draw from this time on, in s
    #[arg(long, value_name = "S", value_parser = time, allow_negative_numbers = true)]
    from: Option<f64>,

    /// Draw up to this time, in s
    #[arg(long, value_name = "S", value_parser = time, allow_negative_numbers = true)]
    to: Option<f64>,

    /// Where the picture goes: a path that ends in .svg or .png; may be given more than once [default: OUT/plot.svg and
    /// OUT/plot.png]
    #[arg(long, short, value_name = "FILE", value_parser = file)]
    file: Vec<File>,

    /// Print the columns with their units and what they show, and draw nothing
    #[arg(long, conflicts_with_all = ["columns", "from", "to", "file"])]
    list: bool,
}

/// A file of a picture.
#[derive(Debug, Clone)]
struct File {
    stem: PathBuf,
    format: Format,
}

fn pattern(text: &str) -> Result<Pattern, String> {
    Pattern::new(text.trim()).map_err(|error| {
        format!(
            "{} at character {}: it must be a name, or a pattern with * and ?",
            error.msg,
            error.pos + 1
        )
    })
}

fn time(text: &str) -> Result<f64, String> {
    let parsed = text.parse().ok().filter(|t: &f64| t.is_finite());
    parsed.ok_or_else(|| "it must be a time in s".into())
}

fn file(text: &str) -> Result<File, String> {
    let path = Path::new(text);
    let format = Format::ALL.into_iter().find(|format| {
        path.extension().is_some_and(|own| own == format.ending()) && path.file_stem().is_some()
    });
    let format = format.ok_or("it must be a path that ends in .svg or .png")?;
    Ok(File {
        stem: path.with_extension(""),
        format,
    })
}

/// Reads the results and draws them.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let recorded = Recorded::open(&arguments.folder)?;
    let scene = recorded.scene().to_owned();
    let runs = recorded.cases()?;
    if arguments.list {
        return print(list(&runs));
    }
    let (from, to) = arguments.range()?;
    let mut recordings = Vec::new();
    for run in &runs {
        let chosen = arguments.chosen(run)?;
        recordings.push(run.recording(chosen.as_deref(), (from, to))?);
    }
    let points = recordings.iter().flat_map(|own| &own.traces);
    let mut points = points.flat_map(|trace| trace.points.items());
    if !points.any(|(_, y)| y.is_finite()) {
        return Err(CommandError::NothingToDraw {
            folder: arguments.folder.clone(),
            from: from.max(f64::MIN),
            to: to.min(f64::MAX),
        });
    }
    for target in arguments.targets() {
        for path in draw(&scene, &recordings, &target.as_target())? {
            print(format_args!("{}\n", path.display()))?;
        }
    }
    Ok(())
}

/// Files beside each other.
struct Files {
    stem: PathBuf,
    formats: Vec<Format>,
}

impl Files {
    fn as_target(&self) -> Target<'_> {
        Target {
            stem: &self.stem,
            formats: &self.formats,
        }
    }
}

impl Arguments {
    fn range(&self) -> Result<(f64, f64), CommandError> {
        let from = self.from.unwrap_or(f64::NEG_INFINITY);
        let to = self.to.unwrap_or(f64::INFINITY);
        match from < to {
            true => Ok((from, to)),
            false => Err(CommandError::EmptyRange { from, to }),
        }
    }

    fn targets(&self) -> Vec<Files> {
        if self.file.is_empty() {
            return vec![Files {
                stem: self.folder.join("plot"),
                formats: Format::ALL.to_vec(),
            }];
        }
        let files = self.file.iter().map(|file| Files {
            stem: file.stem.clone(),
            formats: vec![file.format],
        });
        files.collect()
    }

    /// Places of the columns that are chosen, in the order of the patterns.
    fn chosen(&self, run: &Recorded) -> Result<Option<Vec<usize>>, CommandError> {
        let mut chosen: Vec<usize> = Vec::new();
        let columns = run.columns();
        for pattern in &self.columns {
            let matches = |place: &usize| pattern.matches(columns[*place].name());
            // The time is what all is drawn over.
            let mut matching = (1..columns.len()).filter(matches).peekable();
            if matching.peek().is_none() {
                return Err(no_column(run, pattern));
            }
            let new: Vec<usize> = matching.filter(|place| !chosen.contains(place)).collect();
            chosen.extend(new);
        }
        Ok((!self.columns.is_empty()).then_some(chosen))
    }
}

/// Most columns that an error names.
const MOST_NAMES: usize = 20;

fn no_column(run: &Recorded, pattern: &Pattern) -> CommandError {
    let columns = run.columns().get(1..).unwrap_or_default();
    let names: Vec<&str> = columns
        .iter()
        .map(ReportedColumn::name)
        .take(MOST_NAMES)
        .collect();
    let more = columns.len() - names.len();
    let more = if more > 0 {
        format!(" and {more} more")
    } else {
        String::new()
    };
    CommandError::NoColumn {
        folder: run.folder().to_owned(),
        pattern: pattern.as_str().to_owned(),
        columns: names.join(", ") + &more,
    }
}

/// The columns of the runs, each once.
fn list(runs: &[Recorded]) -> String {
    let mut columns: Vec<&ReportedColumn> = Vec::new();
    for own in runs.iter().flat_map(Recorded::columns) {
        if !columns.iter().any(|known| known.name() == own.name()) {
            columns.push(own);
        }
    }
    let width = |of: fn(&ReportedColumn) -> &str| {
        let widths = columns.iter().map(|own| of(own).chars().count());
        widths.max().unwrap_or_default()
    };
    let name = width(ReportedColumn::name);
    let unit = width(|own| &own.column.unit);
    let line = |own: &&ReportedColumn| {
        let column = &own.column;
        let line = format!(
            "{:name$}  {:unit$}  {}",
            column.name, column.unit, column.description
        );
        line.trim_end().to_owned() + "\n"
    };
    columns.iter().map(line).collect()
}
