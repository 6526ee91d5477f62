//! Takes the rows of a run: into the table, the error meter and the traces of the picture.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use linchpin_master::results::Mechanism;
use linchpin_master::results::{Row, Statistics};
use linchpin_master::scene::Scene;
use serde::Serialize;

use super::figure::traces;
use super::{Impacts, RunReport, Trace};
use crate::animation::Motion;
use crate::closed_form::ClosedForm;
use crate::commands::CommandError;
use crate::commands::common::remove_stale;
use crate::error_norm::ErrorMeter;
use crate::progress;
use crate::simulate::Recorder;

/// Writes `results.csv` and collects what report and picture need.
///
/// Nothing in the folder is touched before the run has started, so a mistake in the scene spoils no earlier results.
pub struct RunRecorder {
    folder: PathBuf,
    stale: Vec<PathBuf>,
    table: Option<csv::Writer<File>>,
    errors: Option<ErrorMeter>,
    scene: Scene,
    traces: Vec<Trace>,
    impacts: Option<Impacts>,
    motion: Option<Motion>,
    bar: ProgressBar,
    started: Instant,
}

/// The table of results.
const TABLE: &str = "results.csv";

/// The progress bar.
const BAR: &str = "{bar:30} {percent:>3} %  t = {msg}  {eta} left";

/// Parts of the simulated time that the progress bar counts.
const BAR_LENGTH: u64 = 10_000;

/// Pause between two drawings of the progress bar.
const REFRESH: Duration = Duration::from_millis(100);

impl RunRecorder {
    /// A recorder that will write to `folder`. The files `stale` of an earlier run are removed when this one has
    /// started.
    pub fn new(scene: &Scene, folder: &Path, stale: Vec<PathBuf>, shows_progress: bool) -> Self {
        Self {
            folder: folder.to_owned(),
            stale,
            table: None,
            errors: None,
            scene: scene.clone(),
            traces: Vec::new(),
            impacts: None,
            motion: None,
            bar: progress::bar(BAR_LENGTH, BAR, shows_progress),
            started: Instant::now(),
        }
    }

    /// Closes the table.
    pub fn finish(mut self, statistics: Statistics) -> Result<RunReport, CommandError> {
        self.bar.finish_and_clear();
        if let Some(table) = &mut self.table {
            let path = self.folder.join(TABLE);
            table.flush().map_err(CommandError::unwritable(&path))?;
        }
        Ok(RunReport {
            statistics,
            errors: self.errors,
            traces: self.traces,
            impacts: self.impacts,
            motion: self.motion,
            wall_time: self.started.elapsed().as_secs_f64(),
        })
    }

    /// Closes the table of a run that failed, and tells where it is; `None` if the run had not started.
    pub fn give_up(mut self) -> Option<PathBuf> {
        self.bar.finish_and_clear();
        // The run has failed for another reason, which is the one to be told.
        self.table.as_mut()?.flush().ok()?;
        Some(self.folder.join(TABLE))
    }

    fn open_table(&mut self) -> Result<(), CommandError> {
        for path in &self.stale {
            remove_stale(path)?;
        }
        let path = self.folder.join(TABLE);
        let file = File::create(&path).map_err(CommandError::unwritable(&path))?;
        self.table = Some(csv::Writer::from_writer(file));
        Ok(())
    }

    fn write(&mut self, row: impl Serialize) -> Result<(), CommandError> {
        let Some(table) = &mut self.table else {
            return Ok(());
        };
        table.serialize(row).map_err(|source| CommandError::Table {
            path: self.folder.join(TABLE),
            source,
        })
    }
}

impl Recorder for RunRecorder {
    type Error = CommandError;

    fn mechanism(&mut self, mechanism: &Mechanism) -> Result<(), CommandError> {
        self.motion = Some(Motion::new(mechanism).ok_or(CommandError::NothingToAnimate)?);
        Ok(())
    }

    fn begin(&mut self, row: &Row) -> Result<(), CommandError> {
        self.traces = traces(&self.scene, row);
        self.impacts = Some(Impacts::of(&self.scene, row));
        let closed_form = ClosedForm::of(&self.scene);
        self.errors = closed_form.map(|closed_form| ErrorMeter::new(closed_form, row));
        self.open_table()?;
        self.write(row.columns())
    }

    fn record(&mut self, row: &Row) -> Result<(), CommandError> {
        for trace in &mut self.traces {
            trace.record(row.values());
        }
        if let Some(impacts) = &mut self.impacts {
            impacts.record(row.values());
        }
        if let Some(errors) = &mut self.errors {
            errors.add(row);
        }
        if let Some(motion) = &mut self.motion {
            motion.record(row.values());
        }
        // Shortest text that reads back to the same bits.
        self.write(row.values())
    }

    fn progress(&mut self, t: f64) {
        let Scene { t_start, t_end, .. } = self.scene;
        if self.bar.is_hidden() || (t < t_end && self.bar.elapsed() < REFRESH) {
            return;
        }
        let speed = (t - t_start) / self.started.elapsed().as_secs_f64();
        let share = (t - t_start) / (t_end - t_start);
        self.bar.set_position((share * BAR_LENGTH as f64) as u64);
        self.bar
            .set_message(format!("{t:.4} s ({speed:.3} x real time)"));
    }
}
