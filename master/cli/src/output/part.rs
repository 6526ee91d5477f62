//! The file of one part of a study, from which the parts are put together.

use std::fs;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::Program;
use crate::commands::CommandError;
use crate::study::{Pieces, Share, StudyError};

/// Name of the file in the folder of the part.
pub const FILE: &str = "part.bin";

/// Why parts cannot be put together.
#[derive(Debug, thiserror::Error)]
pub enum PartError {
    /// It belongs to something else.
    #[error(
        "{} is of another study: the scene, its settings or the program have changed since; make it again with --part {share}",
        path.display()
    )]
    OtherStudy {
        /// The file.
        path: PathBuf,
        /// Which part it should be.
        share: Share,
    },
    /// Its bytes cannot be read.
    #[error("{} is damaged; make it again with --part {share}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Which part it should be.
        share: Share,
    },
    /// The system does not give it.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Its reason.
        source: std::io::Error,
    },
}

/// Which part of what.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Header {
    program: String,
    commit: String,
    /// Everything that decides about the results.
    study: String,
    share: Share,
}

impl Header {
    fn new(study: &str, share: Share) -> Self {
        let program = Program::this();
        Self {
            program: program.linchpin.to_owned(),
            commit: program.commit.to_owned(),
            study: study.to_owned(),
            share,
        }
    }
}

/// Writes a part; `study` is everything that decides about its results. A file that is there is whole.
///
/// # Errors
/// [`CommandError::Unwritable`].
pub fn write<R: Serialize>(
    path: &Path,
    study: &str,
    share: Share,
    pieces: &Pieces<R>,
) -> Result<(), CommandError> {
    let write = || {
        let header = postcard::to_allocvec(&Header::new(study, share));
        let results = postcard::to_allocvec(&pieces.results);
        let text = header.and_then(|header| Ok([header, results?].concat()));
        let new = path.with_extension("new");
        fs::write(&new, text.map_err(std::io::Error::other)?)?;
        fs::rename(&new, path)
    };
    write().map_err(CommandError::unwritable(path))
}

/// Reads all parts of a study under its folder. What is in none of them is missing, and named by the parts that lack it.
///
/// # Errors
/// [`PartError`].
pub fn gather<R: DeserializeOwned>(
    folder: &Path,
    study: &str,
    parts: usize,
    tasks: usize,
) -> Result<Pieces<R>, PartError> {
    let mut results: Vec<Option<R>> = (0..tasks).map(|_| None).collect();
    let mut lacking = Vec::new();
    for share in Share::all(parts) {
        let path = folder.join(share.folder()).join(FILE);
        let found = match fs::read(&path) {
            Ok(bytes) => read::<R>(&path, &bytes, study, share, tasks)?,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Vec::new(),
            Err(source) => return Err(PartError::Unreadable { path, source }),
        };
        if found.iter().flatten().count() < share.count(tasks) {
            lacking.push(share);
        }
        for (place, own) in results.iter_mut().zip(found) {
            if own.is_some() {
                *place = own;
            }
        }
    }
    let is_whole = lacking.is_empty();
    let stopped = (!is_whole).then_some(StudyError::PartsMissing { parts: lacking });
    Ok(Pieces { results, stopped })
}

fn read<R: DeserializeOwned>(
    path: &Path,
    bytes: &[u8],
    study: &str,
    share: Share,
    tasks: usize,
) -> Result<Vec<Option<R>>, PartError> {
    let damaged = |_| PartError::Damaged {
        path: path.to_owned(),
        share,
    };
    let (header, rest) = postcard::take_from_bytes::<Header>(bytes).map_err(damaged)?;
    if header != Header::new(study, share) {
        return Err(PartError::OtherStudy {
            path: path.to_owned(),
            share,
        });
    }
    let results: Vec<Option<R>> = postcard::from_bytes(rest).map_err(damaged)?;
    let is_own = |(place, own): (usize, &Option<R>)| own.is_none() || share.has(place);
    match results.len() == tasks && results.iter().enumerate().all(is_own) {
        true => Ok(results),
        false => Err(PartError::Damaged {
            path: path.to_owned(),
            share,
        }),
    }
}
