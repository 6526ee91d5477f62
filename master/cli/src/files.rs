//! Files of results.

use std::fs;
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
