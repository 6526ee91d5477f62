//! Takes the rows of a run: into the table, the error meter and the traces of the picture.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use linchpin_master::RunError;
use linchpin_master::results::Mechanism;
use linchpin_master::results::{Row, Statistics};
use linchpin_master::run::checkpoint::Checkpoint;
use linchpin_master::scene::Scene;
use linchpin_master::workers::Subsystem;

use super::about::{About, ReportedColumn, SubsystemModel, multiplier_delay};
use super::checkpoints::Checkpoints;
use super::recorded::{TABLE, visit_rows};
use super::table::Table;
use super::{Plan, Recording, RunReport};
use crate::animation::Motion;
use crate::closed_form::ClosedForm;
use crate::commands::CommandError;
use crate::commands::common::remove_stale;
use crate::error_norm::ErrorMeter;
use crate::output::StatusFile;
use crate::output::checkpoint::{CheckpointFile, ResumeError, RunIdentity, remove_checkpoints};
use crate::progress;
use crate::simulate::Recorder;

/// Writes `results.csv` and collects what report and picture need.
///
/// Nothing in the folder is touched before the run has started, so a mistake in the scene spoils no earlier results.
pub struct RunRecorder {
    folder: PathBuf,
    stale: Vec<PathBuf>,
    status: StatusFile<About>,
    table: Option<Table>,
    statistics: Option<Statistics>,
    errors: Option<ErrorMeter>,
    scene: Scene,
    recording: Option<Recording>,
    motion: Option<Motion>,
    checkpoints: Checkpoints,
    /// Where the run goes on.
    resumed: Option<CheckpointFile>,
    bar: ProgressBar,
    started: Instant,
}

/// The progress bar.
const BAR: &str = "{bar:30} {percent:>3} %  t = {msg}  {eta} left";

/// Parts of the simulated time that the progress bar counts.
const BAR_LENGTH: u64 = 10_000;

/// Pause between two drawings of the progress bar.
const REFRESH: Duration = Duration::from_millis(100);

impl RunRecorder {
    /// A recorder that will write to `folder` and say in `status` how the run stands. The files `stale` of an earlier run are
    /// removed when this one has started; until then a `run.json` that is there belongs to the results that are there.
    ///
    /// # Errors
    /// [`CommandError::Unwritable`]
    pub fn new(
        scene: &Scene,
        folder: &Path,
        stale: Vec<PathBuf>,
        status: StatusFile<About>,
        (run, resumed): (RunIdentity, Option<CheckpointFile>),
        shows_progress: bool,
    ) -> Result<Self, CommandError> {
        if !status.is_there() {
            status.running()?;
        }
        Ok(Self {
            folder: folder.to_owned(),
            stale,
            status,
            table: None,
            statistics: None,
            errors: None,
            scene: scene.clone(),
            recording: None,
            motion: None,
            checkpoints: Checkpoints::new(folder.to_owned(), run, &scene.run),
            resumed,
            bar: progress::bar(BAR_LENGTH, BAR, shows_progress),
            started: Instant::now(),
        })
    }

    /// Whether rows were recorded, so that the results in the folder are those of this run.
    pub fn has_begun(&self) -> bool {
        self.table.is_some()
    }

    /// Writes the rows that are not written yet; the path of the table, if the run had started.
    ///
    /// # Errors
    /// [`CommandError::Table`]
    pub fn flush(&self) -> Result<Option<&Path>, CommandError> {
        let Some(table) = &self.table else {
            return Ok(None);
        };
        table.flush()?;
        Ok(Some(table.path()))
    }

    /// What there is to tell, and the file that says how the run stands. `statistics` are those of its end; without them those
    /// of the macro point at which it stopped.
    pub fn into_report(self, statistics: Option<Statistics>) -> (RunReport, StatusFile<About>) {
        self.bar.finish_and_clear();
        let report = RunReport {
            statistics: statistics.or(self.statistics),
            errors: self.errors,
            recording: self.recording,
            motion: self.motion,
            wall_time: self.started.elapsed().as_secs_f64(),
        };
        (report, self.status)
    }

    fn open_table(&mut self, row: &Row) -> Result<(), CommandError> {
        for path in &self.stale {
            remove_stale(path)?;
        }
        // The file of an earlier run says how that ended, which is not so for the table that is begun.
        self.status.about.resumed_at = self.resumed.as_ref().map(|resumed| resumed.t);
        self.status.running()?;
        let path = self.folder.join(TABLE);
        if let Some(resumed) = self.resumed.take() {
            let columns = self.status.about.columns.clone();
            check_length(&path, resumed.table_bytes)?;
            let read = visit_rows(&path, resumed.table_bytes, &columns, |values| {
                self.remember(values);
            });
            read.map_err(ResumeError::Table)?;
            if let Some(recording) = &mut self.recording {
                recording.rejections = resumed.rejections;
            }
            self.table = Some(Table::go_on(&path, resumed.table_bytes)?);
            return Ok(());
        }
        remove_checkpoints(&self.folder).map_err(CommandError::unwritable(&self.folder))?;
        let table = Table::create(&path)?;
        table.add(row.columns())?;
        self.table = Some(table);
        Ok(())
    }

    /// Takes the values of a row for all but the table.
    fn remember(&mut self, values: &[f64]) {
        if let Some(recording) = &mut self.recording {
            recording.record(values);
        }
        if let Some(errors) = &mut self.errors {
            errors.add(values);
        }
        if let Some(motion) = &mut self.motion {
            motion.record(values);
        }
    }
}

impl Recorder for RunRecorder {
    type Error = CommandError;

    fn mechanism(&mut self, mechanism: &Mechanism) -> Result<(), CommandError> {
        self.motion = Some(Motion::new(mechanism).ok_or(CommandError::NothingToAnimate)?);
        Ok(())
    }

    fn begin(&mut self, row: &Row) -> Result<(), CommandError> {
        let columns = ReportedColumn::of_row(row, &self.scene);
        self.recording = Some(Recording::new(&Plan {
            span: (self.scene.t_start, self.scene.t_end),
            multiplier_delay: multiplier_delay(&self.scene),
            rejections: &[],
            panels: &self.scene.output.panels,
            columns: &columns,
            chosen: None,
        }));
        self.status.about.columns = columns;
        let closed_form = ClosedForm::of(&self.scene);
        self.errors = closed_form.map(|closed_form| ErrorMeter::new(closed_form, row));
        self.open_table(row)
    }

    fn workers(&mut self, subsystems: &[Subsystem]) {
        let models = subsystems.iter().map(|subsystem| SubsystemModel {
            subsystem: subsystem.name().to_owned(),
            model: subsystem.model().to_owned(),
        });
        self.status.about.models = models.collect();
    }

    fn resume(&mut self) -> Option<Checkpoint> {
        let resumed = self.resumed.as_ref()?;
        Some(resumed.checkpoint.clone())
    }

    fn wants_checkpoint(&mut self) -> bool {
        self.table.is_some() && self.checkpoints.is_due()
    }

    fn checkpoint(
        &mut self,
        t: f64,
        checkpoint: Result<Checkpoint, RunError>,
    ) -> Result<(), CommandError> {
        if let (Some(table), Some(recording)) = (&self.table, &self.recording) {
            let results = (table.sync()?, &recording.rejections);
            self.checkpoints.write(t, results, checkpoint);
        }
        Ok(())
    }

    fn stop(&mut self, statistics: Statistics) {
        self.statistics = Some(statistics);
    }

    fn record(&mut self, row: &Row) -> Result<(), CommandError> {
        self.remember(row.values());
        match &self.table {
            // Shortest text that reads back to the same bits.
            Some(table) => table.add(row.values()),
            None => Ok(()),
        }
    }

    fn progress(&mut self, t: f64, rejected: u64) {
        if let Some(recording) = &mut self.recording {
            recording.rejections.count(t, rejected);
        }
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

/// That a table is as long as it was when a checkpoint was written, at least.
fn check_length(path: &Path, expected: u64) -> Result<(), CommandError> {
    let found = path.metadata().map_or(0, |metadata| metadata.len());
    if found >= expected {
        return Ok(());
    }
    let path = path.to_owned();
    Err(ResumeError::ShortTable {
        path,
        found,
        expected,
    }
    .into())
}
