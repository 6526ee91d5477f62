//! Two runs compared: which settings differ, and by how much which columns.
//!
//! * [`table`]: a table of results in memory;
//! * [`columns`]: the largest difference of every column;
//! * [`settings`]: the settings that differ;
//! * [`text`]: the comparison for a reader.

pub mod columns;
pub mod settings;
pub mod table;
mod text;

use std::path::Path;

use serde::Serialize;

use crate::results::{ReadError, Recorded};
use columns::{Compared, Grid, compare};
use settings::Setting;
use table::Table;

/// Two folders of results that are compared.
#[derive(Debug, Clone, Serialize)]
pub struct Comparison {
    /// The first folder.
    pub a: String,
    /// The second one.
    pub b: String,
    /// What a difference may be as a share of the size of its column.
    pub tolerance: f64,
    /// Whether nothing differs by more.
    pub equal: bool,
    /// Runs without cases, or those cases that both have.
    pub runs: Vec<RunComparison>,
    /// Cases that only one of them has.
    pub cases_of_a: Vec<String>,
    /// The same of the second one.
    pub cases_of_b: Vec<String>,
}

/// Two runs that are compared.
#[derive(Debug, Clone, Serialize)]
pub struct RunComparison {
    /// Name of the case, if it is one.
    pub case: Option<String>,
    /// Settings that differ; absent if a scene cannot be read any more.
    pub settings: Option<Vec<Setting>>,
    /// How rows were brought together.
    pub grid: Grid,
    /// Columns that both have, the largest difference first.
    pub columns: Vec<Compared>,
    /// Columns of the first one alone.
    pub columns_of_a: Vec<String>,
    /// Columns of the second one alone.
    pub columns_of_b: Vec<String>,
}

/// Why two runs cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum ComparisonError {
    /// Results cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// No time that both runs have.
    #[error(
        "{a} has rows from t = {} s to {} s, {b} from {} s to {} s: there is no time to compare; run one of them over the time of the other",
        of_a.0, of_a.1, of_b.0, of_b.1
    )]
    Apart {
        /// The first folder.
        a: String,
        /// The second one.
        b: String,
        /// First and last time of the first one (s).
        of_a: (f64, f64),
        /// The same of the second one.
        of_b: (f64, f64),
    },
    /// The table has a time that is not after the one before.
    #[error("{folder}: t = {t} s follows t = {before} s; times must increase to be compared")]
    NotIncreasing {
        /// The folder.
        folder: String,
        /// The time before.
        before: f64,
        /// The time.
        t: f64,
    },
}

/// Compares two folders of results; differences up to `tolerance` times the size of a column count as none.
///
/// # Errors
/// [`ComparisonError`]
pub fn of_folders(a: &Path, b: &Path, tolerance: f64) -> Result<Comparison, ComparisonError> {
    let [of_a, of_b] = [Recorded::open(a)?.cases()?, Recorded::open(b)?.cases()?];
    // Runs without cases belong together, whatever their scenes are called.
    let partner = |own: &Recorded, others: &[Recorded]| {
        others.iter().position(|other| other.case() == own.case())
    };
    let mut runs = Vec::new();
    for own in &of_a {
        if let Some(place) = partner(own, &of_b) {
            runs.push(of_runs(own, &of_b[place])?);
        }
    }
    let lonely = |own: &[Recorded], others: &[Recorded]| -> Vec<String> {
        let lonely = own.iter().filter(|own| partner(own, others).is_none());
        lonely
            .map(|own| own.case().unwrap_or("without a case").to_owned())
            .collect()
    };
    let mut comparison = Comparison {
        a: a.display().to_string(),
        b: b.display().to_string(),
        tolerance,
        equal: false,
        runs,
        cases_of_a: lonely(&of_a, &of_b),
        cases_of_b: lonely(&of_b, &of_a),
    };
    comparison.equal = comparison.differences() == 0;
    Ok(comparison)
}

impl Comparison {
    /// Number of columns and cases that differ.
    pub fn differences(&self) -> usize {
        let of_run = |run: &RunComparison| {
            let columns = run.columns.iter();
            let differing = columns.filter(|own| own.differs(self.tolerance)).count();
            let shorter = usize::from(!run.grid.is_whole);
            differing + shorter + run.columns_of_a.len() + run.columns_of_b.len()
        };
        let of_runs: usize = self.runs.iter().map(of_run).sum();
        of_runs + self.cases_of_a.len() + self.cases_of_b.len()
    }
}

fn of_runs(a: &Recorded, b: &Recorded) -> Result<RunComparison, ComparisonError> {
    let [of_a, of_b] = [Table::read(a)?, Table::read(b)?];
    let (grid, columns) = compare(&of_a, &of_b)?;
    let only = |own: &Table, other: &Table| -> Vec<String> {
        let only = own
            .columns
            .iter()
            .filter(|own| other.place(own.name()).is_none());
        only.map(|own| own.name().to_owned()).collect()
    };
    Ok(RunComparison {
        case: a.case().map(str::to_owned),
        settings: settings::that_differ(a, b),
        grid,
        columns,
        columns_of_a: only(&of_a, &of_b),
        columns_of_b: only(&of_b, &of_a),
    })
}
