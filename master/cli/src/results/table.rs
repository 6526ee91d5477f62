//! `results.csv`: whole rows, there within a second whatever happens to the process.

use std::fs::{File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use serde::Serialize;

use crate::commands::CommandError;

/// Longest time that a row stays in memory.
const FLUSH: Duration = Duration::from_secs(1);

/// Rows are written when they are so many bytes.
const BATCH: usize = 1 << 16;

/// A table of results. It is written by whole rows: when there are enough of them, every second by a thread of its own, and at
/// the end. A row that is written in part, because the disk is full, is cut off.
pub struct Table {
    path: PathBuf,
    rows: Arc<Mutex<Rows>>,
    /// Dropped, it ends the thread.
    stop: Option<Sender<()>>,
    flusher: Option<JoinHandle<()>>,
}

struct Rows {
    file: File,
    /// Bytes of the file that are whole rows.
    whole: u64,
    /// Rows that are not in the file yet.
    waiting: csv::Writer<Vec<u8>>,
    /// Why nothing can be written any more, until it is told.
    failed: Option<csv::Error>,
    /// Whether rows are lost: none is written behind them.
    is_broken: bool,
}

impl Table {
    /// An empty table at a path; what was there is gone.
    ///
    /// # Errors
    /// [`CommandError::Unwritable`]
    pub fn create(path: &Path) -> Result<Self, CommandError> {
        let file = File::create(path).map_err(CommandError::unwritable(path))?;
        Ok(Self::behind(file, 0, path))
    }

    /// The table at a path, of which the first `whole` bytes stay; what is behind them is cut off.
    ///
    /// # Errors
    /// [`CommandError::Unwritable`]
    pub fn go_on(path: &Path, whole: u64) -> Result<Self, CommandError> {
        let open = || {
            let mut file = OpenOptions::new().write(true).open(path)?;
            file.set_len(whole)?;
            file.seek(SeekFrom::End(0))?;
            Ok(file)
        };
        let file = open().map_err(CommandError::unwritable(path))?;
        Ok(Self::behind(file, whole, path))
    }

    fn behind(file: File, whole: u64, path: &Path) -> Self {
        let rows = Arc::new(Mutex::new(Rows {
            file,
            whole,
            waiting: csv::Writer::from_writer(Vec::new()),
            failed: None,
            is_broken: false,
        }));
        let (stop, stopped) = channel();
        let flushed = Arc::clone(&rows);
        let flusher = std::thread::spawn(move || {
            while stopped.recv_timeout(FLUSH) == Err(RecvTimeoutError::Timeout) {
                lock(&flushed).flush();
            }
        });
        Self {
            path: path.to_owned(),
            rows,
            stop: Some(stop),
            flusher: Some(flusher),
        }
    }

    /// Writes all rows down to the disk; the bytes that they have there.
    ///
    /// # Errors
    /// [`CommandError::Table`] that some cannot be written, [`CommandError::Unwritable`].
    pub fn sync(&self) -> Result<u64, CommandError> {
        let mut rows = lock(&self.rows);
        rows.flush();
        self.told(&mut rows)?;
        let synced = rows.file.sync_data();
        synced.map_err(CommandError::unwritable(&self.path))?;
        Ok(rows.whole)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`CommandError::Table`] that this row or one before it cannot be written.
    pub fn add(&self, row: impl Serialize) -> Result<(), CommandError> {
        let mut rows = lock(&self.rows);
        let added = rows.waiting.serialize(row);
        if let Err(error) = added {
            rows.failed.get_or_insert(error);
        }
        if rows.waiting.get_ref().len() >= BATCH {
            rows.flush();
        }
        self.told(&mut rows)
    }

    /// Writes all rows.
    ///
    /// # Errors
    /// [`CommandError::Table`] that some cannot be written.
    pub fn flush(&self) -> Result<(), CommandError> {
        let mut rows = lock(&self.rows);
        rows.flush();
        self.told(&mut rows)
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    fn told(&self, rows: &mut Rows) -> Result<(), CommandError> {
        match rows.failed.take() {
            None => Ok(()),
            Some(source) => Err(CommandError::Table {
                path: self.path.clone(),
                source,
            }),
        }
    }
}

impl Drop for Table {
    fn drop(&mut self) {
        self.stop = None;
        if let Some(flusher) = self.flusher.take() {
            // It has nothing to tell.
            let _ = flusher.join();
        }
    }
}

fn lock(rows: &Mutex<Rows>) -> MutexGuard<'_, Rows> {
    rows.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Rows {
    fn flush(&mut self) {
        let empty = csv::Writer::from_writer(Vec::new());
        let waiting = std::mem::replace(&mut self.waiting, empty).into_inner();
        let waiting = match waiting {
            Ok(waiting) => waiting,
            // A Vec takes everything.
            Err(error) => return self.fail(error.into_error()),
        };
        if self.is_broken {
            return;
        }
        let (written, result) = write_as_much_as_fits(&mut self.file, &waiting);
        let end = waiting[..written].iter().rposition(|byte| *byte == b'\n');
        self.whole += end.map_or(0, |end| end as u64 + 1);
        if let Err(error) = result {
            // Of a device there is nothing to cut.
            let _ = self.file.set_len(self.whole);
            self.fail(error);
        }
    }

    fn fail(&mut self, error: io::Error) {
        self.is_broken = true;
        self.failed.get_or_insert(error.into());
    }
}

/// Number of bytes that were written, and why not all of them.
fn write_as_much_as_fits(file: &mut impl Write, bytes: &[u8]) -> (usize, io::Result<()>) {
    let mut written = 0;
    while written < bytes.len() {
        match file.write(&bytes[written..]) {
            Ok(0) => return (written, Err(io::ErrorKind::WriteZero.into())),
            Ok(more) => written += more,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return (written, Err(error)),
        }
    }
    (written, Ok(()))
}
