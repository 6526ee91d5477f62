//! When a run writes checkpoints, and which.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use linchpin_master::RunError;
use linchpin_master::run::checkpoint::Checkpoint;
use linchpin_master::scene::RunSettings;

use super::Rejections;
use crate::commands::common::warn;
use crate::output::checkpoint::{CheckpointFile, RunIdentity};

/// The checkpoints of one run.
pub struct Checkpoints {
    folder: PathBuf,
    run: RunIdentity,
    pause: Pause,
    written: Instant,
    steps: usize,
    /// Whether there can be none: it has been told.
    is_over: bool,
}

/// What lies between two checkpoints.
#[derive(Debug, Clone, Copy)]
enum Pause {
    Time(Duration),
    Steps(usize),
}

impl Checkpoints {
    /// Those of `run` in a folder, as the scene wants them.
    pub fn new(folder: PathBuf, run: RunIdentity, settings: &RunSettings) -> Self {
        let time = Duration::from_secs_f64(settings.checkpoint_every);
        Self {
            folder,
            run,
            pause: settings
                .checkpoint_steps
                .map_or(Pause::Time(time), Pause::Steps),
            written: Instant::now(),
            steps: 0,
            is_over: false,
        }
    }

    /// Whether one is due after a macro step.
    pub fn is_due(&mut self) -> bool {
        self.steps += 1;
        !self.is_over
            && match self.pause {
                Pause::Time(pause) => self.written.elapsed() >= pause,
                Pause::Steps(pause) => self.steps >= pause,
            }
    }

    /// Writes one at `t`, when the table has `table_bytes` and so many steps were repeated. Without it the run goes on, and the one before still serves.
    pub fn write(
        &mut self,
        t: f64,
        (table_bytes, rejections): (u64, &Rejections),
        checkpoint: Result<Checkpoint, RunError>,
    ) {
        let checkpoint = match checkpoint {
            Ok(checkpoint) => checkpoint,
            // A worker that is lost is replaced in the next macro step, behind which another one is due.
            Err(RunError::NotExported { source, .. }) if source.is_loss() => return,
            Err(error) => {
                warn(format_args!(
                    "{error}; a run that is cut off begins at its start again"
                ));
                self.is_over = true;
                return;
            }
        };
        self.steps = 0;
        let file = CheckpointFile {
            t,
            run: self.run.clone(),
            table_bytes,
            rejections: rejections.clone(),
            checkpoint,
        };
        if let Err(error) = file.write(&self.folder) {
            let folder = self.folder.display();
            warn(format_args!(
                "no checkpoint at t = {t} s: cannot write to {folder}: {error}; the one before it still serves"
            ));
        }
        self.written = Instant::now();
    }
}
