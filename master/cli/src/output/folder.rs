//! One command at a time writes to a folder.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

use rustix::fs::{FlockOperation, flock};
use rustix::io::Errno;

use super::Program;
use crate::commands::CommandError;
use crate::commands::common::warn;

/// The file whose lock says that somebody writes.
const LOCK: &str = ".linchpin-lock";

/// A folder that this process alone writes to, as long as this lives. The lock is the system's, so it ends with the process,
/// however that ends.
pub struct OutputFolder {
    path: PathBuf,
    /// `None` where the file system has no locks.
    lock: Option<File>,
}

impl OutputFolder {
    /// Makes the folder if it is not there, and takes it.
    ///
    /// # Errors
    /// [`CommandError::FolderTaken`] at once if another process writes there; [`CommandError::Unwritable`].
    pub fn claim(path: &Path) -> Result<Self, CommandError> {
        let unwritable = CommandError::unwritable(path);
        fs::create_dir_all(path).map_err(&unwritable)?;
        let lock_path = path.join(LOCK);
        let lock = loop {
            let mut lock = open(&lock_path).map_err(&unwritable)?;
            match flock(&lock, FlockOperation::NonBlockingLockExclusive) {
                Ok(()) if is_there(&lock, &lock_path) => {
                    sign(&mut lock).map_err(&unwritable)?;
                    break Some(lock);
                }
                // Its holder has just removed it.
                Ok(()) => {}
                Err(Errno::WOULDBLOCK) => {
                    return Err(CommandError::FolderTaken {
                        folder: path.to_owned(),
                        holder: holder(&mut lock),
                    });
                }
                Err(error) => {
                    warn(format_args!(
                        "{} cannot be locked ({error}): see that nothing else writes there",
                        path.display()
                    ));
                    // Whoever can lock finds no file in the way.
                    let _ = fs::remove_file(&lock_path);
                    break None;
                }
            }
        };
        Ok(Self {
            path: path.to_owned(),
            lock,
        })
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        if self.lock.is_some() {
            // A file that stays holds nobody up: its lock is gone.
            let _ = fs::remove_file(self.path.join(LOCK));
        }
    }
}

fn open(path: &Path) -> io::Result<File> {
    OpenOptions::new()
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .open(path)
}

/// Whether the file that was locked is the one at the path.
fn is_there(lock: &File, path: &Path) -> bool {
    let identity = |found: io::Result<fs::Metadata>| found.map(|own| (own.dev(), own.ino()));
    match (identity(lock.metadata()), identity(path.metadata())) {
        (Ok(locked), Ok(found)) => locked == found,
        _ => false,
    }
}

/// Writes who holds the lock.
fn sign(lock: &mut File) -> io::Result<()> {
    let Program {
        host,
        process,
        command,
        started,
        ..
    } = Program::this();
    lock.set_len(0)?;
    write!(
        lock,
        "process {process} on {host} since {started}: {}",
        command.join(" ")
    )
}

/// Who holds the lock, as far as the file says it.
fn holder(lock: &mut File) -> String {
    let mut text = String::new();
    match lock.read_to_string(&mut text) {
        Ok(1..) => text,
        _ => "another process".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_taken_by_one_and_free_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/out");
        let first = OutputFolder::claim(&path).unwrap();
        let Err(CommandError::FolderTaken { holder, .. }) = OutputFolder::claim(&path) else {
            panic!("taken twice")
        };
        assert!(
            holder.contains(&format!("process {}", std::process::id())),
            "{holder}"
        );
        let _other = OutputFolder::claim(&path.join("inside")).unwrap();
        drop(first);
        assert!(!path.join(LOCK).exists());
        OutputFolder::claim(&path).unwrap();
    }

    /// As a process leaves it that was killed.
    #[test]
    fn a_file_without_a_lock_holds_nobody_up() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(LOCK), "process 1 on another machine").unwrap();
        OutputFolder::claim(folder.path()).unwrap();
    }
}
