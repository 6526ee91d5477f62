//! `checkpoint`: what a run needs to go on when its process has ended, however that has ended.
//!
//! A new checkpoint is written beside the last one, and takes its place when it is on the disk as a whole. The last but one stays as
//! well, so that one is there whatever happens to the newest.
//!
//! The file: the line `linchpin checkpoint`, the format (4 bytes), the length of the content (8), its CRC-32 (4), all little-endian,
//! and the content, in the encoding of `postcard`.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use linchpin_master::run::checkpoint::Checkpoint;
use serde::{Deserialize, Serialize};

use crate::commands::common::warn;
use crate::results::{ReadError, Rejections};

const NEWEST: &str = "checkpoint";
const PREVIOUS: &str = "checkpoint.previous";
const UNFINISHED: &str = "checkpoint.unfinished";

/// The first bytes of every checkpoint.
const MAGIC: &[u8] = b"linchpin checkpoint\n";

/// Number of the format; another one with every change of what is written.
const FORMAT: u32 = 1;

/// A run at a macro point, with what belongs to it in its folder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CheckpointFile {
    /// The macro point in s.
    pub t: f64,
    /// Which run it is.
    pub run: RunIdentity,
    /// Bytes of the table of results up to there.
    pub table_bytes: u64,
    /// The macro steps that were repeated up to there.
    pub rejections: Rejections,
    /// The run itself.
    pub checkpoint: Checkpoint,
}

/// What decides about the results of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunIdentity {
    /// Version of the program.
    pub version: String,
    /// The scene file as it was read.
    pub scene_text: String,
    /// The settings that were changed on the command line.
    pub overrides: Vec<String>,
    /// The case, if the scene has some.
    pub case: Option<String>,
    /// Whether positions of markers are recorded for an animation.
    pub animate: bool,
}

/// Why a run does not go on from a checkpoint.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// There is none.
    #[error(
        "there is no checkpoint in {}: a run writes one every run.checkpoint_every s and removes it at its end; run the scene without \
         --resume to begin at its start",
        folder.display()
    )]
    NoCheckpoint {
        /// The folder.
        folder: PathBuf,
    },
    /// It cannot be read.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// It is damaged.
    #[error("{} is damaged: {what}; run the scene without --resume to begin at its start", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// In which way.
        what: String,
    },
    /// Another program has written it.
    #[error(
        "{} has format {found} of checkpoints, this program reads format {FORMAT}: go on with the program that wrote it, or run the scene \
         without --resume",
        path.display()
    )]
    Format {
        /// The file.
        path: PathBuf,
        /// Its format.
        found: u32,
    },
    /// It belongs to another run.
    #[error(
        "{} belongs to another run: {what}; go on as that run was started, or run the scene without --resume",
        path.display()
    )]
    OtherRun {
        /// The file.
        path: PathBuf,
        /// What differs.
        what: String,
    },
    /// The table of results has not the rows that the checkpoint counts on.
    #[error(
        "{} has {found} bytes, and the checkpoint was written when it had {expected}: rows are missing, so the run cannot go on without a \
         gap; run the scene without --resume",
        path.display()
    )]
    ShortTable {
        /// The table.
        path: PathBuf,
        /// Its length.
        found: u64,
        /// The least length.
        expected: u64,
    },
    /// The table of results cannot be read.
    #[error(transparent)]
    Table(ReadError),
}

impl CheckpointFile {
    /// Writes it to a folder.
    ///
    /// # Errors
    /// The system's; then the checkpoints that were there before still are.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        let unfinished = folder.join(UNFINISHED);
        let written = self.write_to(&unfinished);
        if written.is_err() {
            // What there is of it takes room on a disk that may be full.
            let _ = fs::remove_file(&unfinished);
        }
        written?;
        let newest = folder.join(NEWEST);
        if newest.exists() {
            fs::rename(&newest, folder.join(PREVIOUS))?;
        }
        fs::rename(unfinished, newest)?;
        // The names are on the disk as well.
        File::open(folder)?.sync_all()
    }

    fn write_to(&self, path: &Path) -> io::Result<()> {
        let content = postcard::to_stdvec(self).map_err(io::Error::other)?;
        let mut file = File::create(path)?;
        file.write_all(MAGIC)?;
        file.write_all(&FORMAT.to_le_bytes())?;
        file.write_all(&(content.len() as u64).to_le_bytes())?;
        file.write_all(&crc32fast::hash(&content).to_le_bytes())?;
        file.write_all(&content)?;
        file.sync_all()
    }

    /// The newest one of a folder; where that is damaged the one before, with a warning.
    ///
    /// # Errors
    /// [`ResumeError`] that tells what is wrong with the newest one.
    pub fn read(folder: &Path) -> Result<Self, ResumeError> {
        let newest = read(&folder.join(NEWEST));
        let previous = folder.join(PREVIOUS);
        match newest {
            Err(error) if previous.exists() => match read(&previous) {
                Ok(older) => {
                    warn(format_args!(
                        "the newest checkpoint cannot be used, and the run goes on from the one before, at t = {} s: {error}",
                        older.t
                    ));
                    Ok(older)
                }
                Err(_) => Err(error),
            },
            newest => newest,
        }
    }

    /// That it is one of `run`.
    ///
    /// # Errors
    /// [`ResumeError::OtherRun`]
    pub fn check(&self, run: &RunIdentity, folder: &Path) -> Result<(), ResumeError> {
        let own = &self.run;
        let other = |what: String| {
            Err(ResumeError::OtherRun {
                path: folder.join(NEWEST),
                what,
            })
        };
        if own.version != run.version {
            return other(format!(
                "linchpin {} has written it, this is {}",
                own.version, run.version
            ));
        }
        if own.scene_text != run.scene_text {
            return other("the scene file has changed since".to_owned());
        }
        if own.overrides != run.overrides {
            return other(format!(
                "it was started with {}, this one is with {}",
                settings(&own.overrides),
                settings(&run.overrides)
            ));
        }
        if own.animate != run.animate {
            return other("only one of the two has --animate".to_owned());
        }
        if own.case != run.case {
            let name =
                |case: &Option<String>| format!("\"{}\"", case.as_deref().unwrap_or_default());
            return other(format!(
                "it is case {}, this is {}",
                name(&own.case),
                name(&run.case)
            ));
        }
        Ok(())
    }
}

fn settings(overrides: &[String]) -> String {
    match overrides {
        [] => "no --set".to_owned(),
        overrides => format!("--set {}", overrides.join(" --set ")),
    }
}

/// Whether a folder has a checkpoint.
pub fn has_checkpoint(folder: &Path) -> bool {
    [NEWEST, PREVIOUS]
        .iter()
        .any(|name| folder.join(name).exists())
}

/// Removes the checkpoints of a run that needs them no more.
///
/// # Errors
/// The system's.
pub fn remove_checkpoints(folder: &Path) -> io::Result<()> {
    for name in [NEWEST, PREVIOUS, UNFINISHED] {
        match fs::remove_file(folder.join(name)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
    }
    Ok(())
}

fn read(path: &Path) -> Result<CheckpointFile, ResumeError> {
    let bytes = fs::read(path).map_err(|source| match source.kind() {
        io::ErrorKind::NotFound => ResumeError::NoCheckpoint {
            folder: path.parent().unwrap_or(path).to_owned(),
        },
        _ => ResumeError::Unreadable {
            path: path.to_owned(),
            source,
        },
    })?;
    decode(&bytes).map_err(|fault| match fault {
        Fault::Format(found) => ResumeError::Format {
            path: path.to_owned(),
            found,
        },
        Fault::Damaged(what) => ResumeError::Damaged {
            path: path.to_owned(),
            what,
        },
    })
}

/// What is wrong with the bytes of a checkpoint.
enum Fault {
    Format(u32),
    Damaged(String),
}

fn decode(bytes: &[u8]) -> Result<CheckpointFile, Fault> {
    let damaged = |what: &str| Fault::Damaged(what.to_owned());
    if !bytes.starts_with(&MAGIC[..MAGIC.len().min(bytes.len())]) {
        return Err(damaged("it does not begin as a checkpoint does"));
    }
    let header = || {
        let rest = bytes.get(MAGIC.len()..)?;
        let (format, rest) = rest.split_first_chunk()?;
        let (length, rest) = rest.split_first_chunk()?;
        let (checksum, content) = rest.split_first_chunk()?;
        Some((format, length, checksum, content))
    };
    let Some((&format, &length, &checksum, content)) = header() else {
        return Err(damaged("it ends within its header"));
    };
    let (format, length) = (u32::from_le_bytes(format), u64::from_le_bytes(length));
    if format != FORMAT {
        return Err(Fault::Format(format));
    }
    if content.len() as u64 != length {
        return Err(Fault::Damaged(format!(
            "it has {} bytes of content instead of {length}",
            content.len()
        )));
    }
    if crc32fast::hash(content) != u32::from_le_bytes(checksum) {
        return Err(damaged("its checksum is wrong"));
    }
    postcard::from_bytes(content).map_err(|error| Fault::Damaged(error.to_string()))
}
