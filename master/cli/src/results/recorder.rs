//! Takes the rows of a run: into the table, the error meter and the traces of the picture.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use linchpin_master::results::{Row, Statistics};
use linchpin_master::scene::Scene;

use super::{RunReport, Trace};
use crate::closed_form::ClosedForm;
use crate::commands::CommandError;
use crate::error_norm::ErrorMeter;
use crate::simulate::Recorder;

/// Writes `results.csv` and collects what report and picture need.
pub struct RunRecorder {
    path: PathBuf,
    table: csv::Writer<File>,
    closed_form: Option<ClosedForm>,
    errors: Option<ErrorMeter>,
    traces: Vec<(usize, Trace)>,
    bar: ProgressBar,
    t_start: f64,
    started: Instant,
}

/// Pause between two drawings of the progress bar.
const REFRESH: Duration = Duration::from_millis(100);

impl RunRecorder {
    /// Opens the table at `path`.
    pub fn new(scene: &Scene, path: &Path, shows_progress: bool) -> Result<Self, CommandError> {
        let unwritable = |source| CommandError::Unwritable {
            path: path.to_owned(),
            source,
        };
        let file = File::create(path).map_err(unwritable)?;
        Ok(Self {
            path: path.to_owned(),
            table: csv::Writer::from_writer(file),
            closed_form: ClosedForm::of(scene),
            errors: None,
            traces: Vec::new(),
            bar: if shows_progress {
                bar()
            } else {
                ProgressBar::hidden()
            },
            t_start: scene.t_start,
            started: Instant::now(),
        })
    }

    /// Closes the table.
    pub fn finish(mut self, statistics: Statistics) -> Result<RunReport, CommandError> {
        self.bar.finish_and_clear();
        let path = self.path.clone();
        self.table
            .flush()
            .map_err(|source| CommandError::Unwritable { path, source })?;
        Ok(RunReport {
            statistics,
            errors: self.errors,
            traces: self.traces.into_iter().map(|(_, trace)| trace).collect(),
            wall_time: self.started.elapsed().as_secs_f64(),
        })
    }

    fn table_error(&self, source: csv::Error) -> CommandError {
        CommandError::Table {
            path: self.path.clone(),
            source,
        }
    }
}

fn bar() -> ProgressBar {
    let template = "{bar:30} {percent:>3} %  t = {msg}  {eta} left";
    let bar = ProgressBar::new(0);
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        // The template is fixed; the plain style still shows how far the run is.
        Err(_) => bar,
    }
}

impl Recorder for RunRecorder {
    type Error = CommandError;

    fn begin(&mut self, row: &Row) -> Result<(), CommandError> {
        let columns = row.columns().iter().enumerate();
        let drawn = columns.filter(|(place, _)| row.is_drawn(*place));
        self.traces = drawn
            .map(|(place, name)| (place, Trace::new(name)))
            .collect();
        self.errors = self
            .closed_form
            .take()
            .map(|closed_form| ErrorMeter::new(closed_form, row));
        self.table
            .write_record(row.columns())
            .map_err(|error| self.table_error(error))
    }

    fn record(&mut self, row: &Row) -> Result<(), CommandError> {
        for (place, trace) in &mut self.traces {
            trace.push(row.values()[0], row.values()[*place]);
        }
        if let Some(errors) = &mut self.errors {
            errors.add(row);
        }
        // Shortest text that reads back to the same bits.
        self.table
            .serialize(row.values())
            .map_err(|error| self.table_error(error))
    }

    fn progress(&mut self, done: usize, all: usize, t: f64) {
        if self.bar.is_hidden() || (done < all && self.bar.elapsed() < REFRESH) {
            return;
        }
        let speed = (t - self.t_start) / self.started.elapsed().as_secs_f64();
        self.bar.set_length(all as u64);
        self.bar.set_position(done as u64);
        self.bar
            .set_message(format!("{t:.4} s ({speed:.3} x real time)"));
    }
}
