//! Files of results.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;

use crate::commands::CommandError;

/// Writes a table (CSV) with a row for each record.
///
/// # Errors
/// [`CommandError::Table`] if the path cannot be written to.
pub fn write_table<R: Serialize>(
    path: &Path,
    records: impl IntoIterator<Item = R>,
) -> Result<(), CommandError> {
    let write = || {
        let mut table = csv::Writer::from_path(path)?;
        let mut records = records.into_iter();
        records.try_for_each(|record| table.serialize(record))?;
        Ok(table.flush()?)
    };
    write().map_err(|source| CommandError::Table {
        path: path.to_owned(),
        source,
    })
}

/// Writes a text.
///
/// # Errors
/// [`CommandError::Unwritable`] if the path cannot be written to.
pub fn write_text(path: &Path, text: &str) -> Result<(), CommandError> {
    fs::write(path, text).map_err(CommandError::unwritable(path))
}

/// Writes a text in place of an earlier one: whoever reads the path finds either of them whole. On a full disk it is written over
/// an earlier one that is as long, with blanks behind it.
///
/// # Errors
/// [`CommandError::Unwritable`] if the path cannot be written to.
pub fn replace_text(path: &Path, text: &str) -> Result<(), CommandError> {
    let new = path.with_extension("new");
    fs::write(&new, text)
        .and_then(|()| fs::rename(&new, path))
        .or_else(|error| {
            // It is not whole.
            let _ = fs::remove_file(&new);
            write_over(path, text).map_err(|_| error)
        })
        .map_err(CommandError::unwritable(path))
}

fn write_over(path: &Path, text: &str) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).open(path)?;
    let room = usize::try_from(file.metadata()?.len()).unwrap_or_default();
    if room < text.len() {
        return Err(io::ErrorKind::StorageFull.into());
    }
    file.write_all(text.as_bytes())?;
    file.write_all(" ".repeat(room - text.len()).as_bytes())
}
