//! What the workers of a run print, in its folder.

use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

use linchpin_master::connection::WorkerLogs;

/// The folder of the files, in that of the run.
const FOLDER: &str = "workers";

/// Where the workers of a run into `folder` print to; with `is_shown` also to the error output, each line behind the worker's name.
pub fn worker_logs(folder: &Path, is_shown: bool) -> WorkerLogs {
    let show = |name: &str, line: &str| {
        // Whoever closed it is not told.
        let _ = writeln!(io::stderr(), "{name}| {line}");
    };
    WorkerLogs {
        folder: Some(folder.join(FOLDER)),
        show: is_shown.then(|| Arc::new(show) as _),
    }
}

/// Removes what the workers of an earlier run into `folder` have printed.
///
/// # Errors
/// The system's.
pub fn remove_worker_logs(folder: &Path) -> io::Result<()> {
    let folder = folder.join(FOLDER);
    let entries = match fs::read_dir(&folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(error),
    };
    for entry in entries {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "log") {
            fs::remove_file(path)?;
        }
    }
    // Other files in it are not the run's, and keep it.
    let _ = fs::remove_dir(folder);
    Ok(())
}
