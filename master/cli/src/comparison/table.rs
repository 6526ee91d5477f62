//! A table of results in memory, column by column.

use super::ComparisonError;
use crate::results::{Recorded, ReportedColumn};

/// A table of results.
#[derive(Debug, Clone)]
pub struct Table {
    /// Its folder.
    pub folder: String,
    /// What its columns are; the first one is the time.
    pub columns: Vec<ReportedColumn>,
    /// Their values.
    pub values: Vec<Vec<f64>>,
}

impl Table {
    /// Reads the table of a run.
    ///
    /// # Errors
    /// [`ComparisonError::Read`]; [`ComparisonError::NotIncreasing`]
    pub fn read(run: &Recorded) -> Result<Self, ComparisonError> {
        let columns = run.columns().to_vec();
        let mut values = vec![Vec::new(); columns.len()];
        run.rows(|row| {
            for (column, value) in values.iter_mut().zip(row) {
                column.push(*value);
            }
        })?;
        let folder = run.folder().display().to_string();
        let backwards = values[0].windows(2).find(|pair| pair[1] <= pair[0]);
        match backwards {
            Some(pair) => Err(ComparisonError::NotIncreasing {
                folder,
                before: pair[0],
                t: pair[1],
            }),
            None => Ok(Self {
                folder,
                columns,
                values,
            }),
        }
    }

    /// Times of its rows in s.
    pub fn times(&self) -> &[f64] {
        &self.values[0]
    }

    /// First and last time.
    pub fn span(&self) -> (f64, f64) {
        let times = self.times();
        (times[0], times[times.len() - 1])
    }

    /// Place of a column.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|own| own.name() == name)
    }
}
