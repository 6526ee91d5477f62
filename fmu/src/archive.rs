//! Unpacks an FMU, which is a zip archive from anywhere, into a folder of its own.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use zip::ZipArchive;
use zip::result::ZipError;

use crate::FmuError;

/// Most bytes of an unpacked FMU.
const MOST_BYTES: u64 = 2 << 30;

/// Most entries of an archive.
const MOST_ENTRIES: usize = 100_000;

/// Unpacks `path`; the folder is removed with the value.
///
/// # Errors
/// [`FmuError`]: no archive, damaged, entries that lead out of the folder, too large.
pub fn unpack(path: &Path) -> Result<TempDir, FmuError> {
    unpack_within(path, MOST_BYTES)
}

fn unpack_within(path: &Path, limit: u64) -> Result<TempDir, FmuError> {
    let mut archive = open(path)?;
    if archive.len() > MOST_ENTRIES {
        let reason = format!(
            "{} entries, at most {MOST_ENTRIES} are allowed",
            archive.len()
        );
        return Err(damaged(path, reason));
    }
    let fail = |source| FmuError::Unpack {
        path: path.to_owned(),
        source,
    };
    let folder = tempfile::Builder::new()
        .prefix("linchpin-fmu-")
        .tempdir()
        .map_err(fail)?;
    let mut left = limit;
    for number in 0..archive.len() {
        let mut entry = { archive.by_index(number) }.map_err(|error| unsound(path, &error))?;
        let name = String::from_utf8_lossy(entry.name_raw()).into_owned();
        let inside = entry.enclosed_name().filter(|_| !entry.is_symlink());
        let Some(inside) = inside else {
            let path = path.to_owned();
            return Err(FmuError::Outside { path, entry: name });
        };
        let target = folder.path().join(inside);
        if entry.is_dir() {
            fs::create_dir_all(&target).map_err(fail)?;
            continue;
        }
        // The size that the archive tells is not trusted: what is written counts.
        let too_large = || FmuError::TooLarge {
            path: path.to_owned(),
            limit,
        };
        if entry.size() > left {
            return Err(too_large());
        }
        let written = write(&mut (&mut entry).take(left + 1), &target)
            .map_err(|error| copy_error(path, &name, error))?;
        left = left.checked_sub(written).ok_or_else(too_large)?;
    }
    Ok(folder)
}

/// The text of one entry, without unpacking the others.
///
/// # Errors
/// As [`unpack`], and if there is no such entry.
pub fn read(path: &Path, name: &str, limit: u64) -> Result<Vec<u8>, FmuError> {
    let mut archive = open(path)?;
    let entry = archive.by_name(name).map_err(|error| match error {
        ZipError::FileNotFound => damaged(path, format!("it has no {name}")),
        error => unsound(path, &error),
    })?;
    let mut bytes = Vec::new();
    { entry.take(limit + 1).read_to_end(&mut bytes) }
        .map_err(|error| damaged(path, format!("{name}: {error}")))?;
    if bytes.len() as u64 > limit {
        let path = path.to_owned();
        return Err(FmuError::TooLarge { path, limit });
    }
    Ok(bytes)
}

/// The names of all entries.
///
/// # Errors
/// As [`unpack`].
pub fn names(path: &Path) -> Result<Vec<String>, FmuError> {
    let mut archive = open(path)?;
    let mut names = Vec::new();
    for number in 0..archive.len() {
        let entry = { archive.by_index_raw(number) }.map_err(|error| unsound(path, &error))?;
        names.push(String::from_utf8_lossy(entry.name_raw()).into_owned());
    }
    Ok(names)
}

fn open(path: &Path) -> Result<ZipArchive<File>, FmuError> {
    let open = |source| FmuError::Open {
        path: path.to_owned(),
        source,
    };
    let file = File::open(path).map_err(open)?;
    if file.metadata().map_err(open)?.is_dir() {
        return Err(damaged(
            path,
            "it is a folder; an FMU is the archive of it".to_owned(),
        ));
    }
    ZipArchive::new(file).map_err(|error| unsound(path, &error))
}

fn write(from: &mut impl Read, to: &Path) -> io::Result<u64> {
    if let Some(folder) = to.parent() {
        fs::create_dir_all(folder)?;
    }
    io::copy(from, &mut File::create(to)?)
}

/// A damaged entry shows while it is copied, as does a full disk.
fn copy_error(path: &Path, name: &str, source: io::Error) -> FmuError {
    match source.kind() {
        io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput | io::ErrorKind::UnexpectedEof => {
            damaged(path, format!("{name}: {source}"))
        }
        io::ErrorKind::Other => damaged(path, format!("{name}: {source}")),
        _ => FmuError::Unpack {
            path: PathBuf::from(path),
            source,
        },
    }
}

fn unsound(path: &Path, error: &ZipError) -> FmuError {
    damaged(path, format!("its zip archive: {error}"))
}

fn damaged(path: &Path, reason: String) -> FmuError {
    FmuError::Damaged {
        path: path.to_owned(),
        reason,
    }
}

#[cfg(test)]
mod tests;
