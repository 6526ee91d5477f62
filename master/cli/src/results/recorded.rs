//! Reads a folder of results back: `run.json`, and `results.csv` row by row.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use linchpin_master::scene::Panel;
use serde::Deserialize;
use serde_json::Value;

use super::{Plan, Recording, ReportedColumn};
use crate::output::status::FILE;

/// The table of results.
pub const TABLE: &str = "results.csv";

/// A folder of results.
#[derive(Debug, Clone)]
pub struct Recorded {
    folder: PathBuf,
    about: About,
    /// All of `run.json`.
    document: Value,
}

/// What is needed of `run.json`.
#[derive(Debug, Clone, Deserialize)]
struct About {
    status: String,
    reason: Option<String>,
    scene: String,
    case: Option<String>,
    t_start: f64,
    t_end: f64,
    #[serde(default)]
    panels: Vec<Panel>,
    #[serde(default)]
    multiplier_delay: f64,
    #[serde(default)]
    rejections: Vec<f64>,
    columns: Vec<ReportedColumn>,
    /// Of the folder of a scene with cases.
    #[serde(default)]
    cases: Vec<CaseFolder>,
}

#[derive(Debug, Clone, Deserialize)]
struct CaseFolder {
    folder: String,
}

/// Why results cannot be read back.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// No `run.json` there.
    #[error(
        "{} has no results ({}: {source}); give the folder that linchpin run wrote to",
        folder.display(), FILE
    )]
    Missing {
        /// The folder.
        folder: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// `run.json` is not that of a run.
    #[error("{} is not that of a run: {source}; give the folder that linchpin run wrote to", path.display())]
    NotOfARun {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: serde_json::Error,
    },
    /// The table cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// Why.
        source: csv::Error,
    },
    /// The table has other columns than `run.json` says.
    #[error(
        "{} has other columns than run.json beside it says, so they are not of the same run; run the scene again", path.display()
    )]
    OtherColumns {
        /// The table.
        path: PathBuf,
    },
    /// A value is no number.
    #[error("{}:{line}: column {column} has {value:?}, which is no number", path.display())]
    NoNumber {
        /// The table.
        path: PathBuf,
        /// Line in it.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there.
        value: String,
    },
    /// A run without rows.
    #[error("the run in {} has no rows: {}", folder.display(), reason.as_deref().unwrap_or(status))]
    NoRows {
        /// The folder.
        folder: PathBuf,
        /// How it stands.
        status: String,
        /// Why it did not come to its end.
        reason: Option<String>,
    },
}

impl Recorded {
    /// The results in a folder.
    ///
    /// # Errors
    /// [`ReadError::Missing`], [`ReadError::NotOfARun`]
    pub fn open(folder: &Path) -> Result<Self, ReadError> {
        let path = folder.join(FILE);
        let text = fs::read_to_string(&path).map_err(|source| ReadError::Missing {
            folder: folder.to_owned(),
            source,
        })?;
        let not_of_a_run = |source| ReadError::NotOfARun {
            path: path.clone(),
            source,
        };
        let document: Value = serde_json::from_str(&text).map_err(not_of_a_run)?;
        let about = About::deserialize(&document).map_err(not_of_a_run)?;
        Ok(Self {
            folder: folder.to_owned(),
            about,
            document,
        })
    }

    /// What `run.json` says of a run, if the process of this number has written it: without the scene and what is about columns, and
    /// with the folder.
    pub fn document_of(folder: &Path, process: u32) -> Option<Value> {
        let text = fs::read_to_string(folder.join(FILE)).ok()?;
        let mut document: Value = serde_json::from_str(&text).ok()?;
        let own = document.as_object_mut()?;
        if own.get("process") != Some(&process.into()) {
            return None;
        }
        for key in ["scene_text", "columns", "panels", "settings"] {
            own.remove(key);
        }
        own.insert("folder".into(), folder.display().to_string().into());
        Some(document)
    }

    /// The results of the cases of a scene with cases that have run, in their order; those of one without cases alone.
    ///
    /// # Errors
    /// As for [`Recorded::open`].
    pub fn cases(self) -> Result<Vec<Self>, ReadError> {
        if self.about.cases.is_empty() {
            return Ok(vec![self]);
        }
        let folders = self.about.cases.iter();
        let folders = folders.map(|case| self.folder.join(&case.folder));
        let run = folders.filter(|folder| folder.join(FILE).exists());
        run.map(|folder| Self::open(&folder)).collect()
    }

    /// Its folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Name of the scene.
    pub fn scene(&self) -> &str {
        &self.about.scene
    }

    /// Name of the case of the scene, if it is one.
    pub fn case(&self) -> Option<&str> {
        self.about.case.as_deref()
    }

    /// All of `run.json`.
    pub fn document(&self) -> &Value {
        &self.document
    }

    /// The columns of the table.
    pub fn columns(&self) -> &[ReportedColumn] {
        &self.about.columns
    }

    /// What its picture needs of the rows from one time to another (s); `chosen` are the places of the columns that are drawn, or
    /// else those that the run would draw.
    ///
    /// # Errors
    /// As for [`Recorded::rows`].
    pub fn recording(
        &self,
        chosen: Option<&[usize]>,
        (from, to): (f64, f64),
    ) -> Result<Recording, ReadError> {
        let mut recording = Recording::new(&Plan {
            span: (self.about.t_start, self.about.t_end),
            multiplier_delay: self.about.multiplier_delay,
            rejections: &self.about.rejections,
            panels: &self.about.panels,
            columns: &self.about.columns,
            chosen,
        });
        recording.case.clone_from(&self.about.case);
        recording.reason.clone_from(&self.about.reason);
        self.rows(|row| {
            if (from..=to).contains(&row[0]) {
                recording.record(row);
            }
        })?;
        Ok(recording)
    }

    /// Goes through the rows of the table.
    ///
    /// # Errors
    /// What is wrong with the table; [`ReadError::NoRows`].
    pub fn rows(&self, mut visit: impl FnMut(&[f64])) -> Result<(), ReadError> {
        let path = self.folder.join(TABLE);
        if self.about.columns.is_empty() {
            return Err(self.no_rows());
        }
        let mut is_empty = true;
        visit_rows(&path, u64::MAX, &self.about.columns, |values| {
            is_empty = false;
            visit(values);
        })?;
        match is_empty {
            true => Err(self.no_rows()),
            false => Ok(()),
        }
    }

    fn no_rows(&self) -> ReadError {
        ReadError::NoRows {
            folder: self.folder.clone(),
            status: self.about.status.clone(),
            reason: self.about.reason.clone(),
        }
    }
}

/// Goes through the rows in the first bytes of a table that has these columns.
///
/// # Errors
/// What is wrong with the table.
pub(super) fn visit_rows(
    path: &Path,
    bytes: u64,
    columns: &[ReportedColumn],
    mut visit: impl FnMut(&[f64]),
) -> Result<(), ReadError> {
    let failed = |source| ReadError::Table {
        path: path.to_owned(),
        source,
    };
    let file = File::open(path).map_err(|error| failed(error.into()))?;
    let mut table = csv::Reader::from_reader(file.take(bytes));
    let names = columns.iter().map(ReportedColumn::name);
    if !table.headers().map_err(failed)?.iter().eq(names) {
        return Err(ReadError::OtherColumns {
            path: path.to_owned(),
        });
    }
    let mut record = csv::StringRecord::new();
    let mut values = Vec::new();
    while table.read_record(&mut record).map_err(failed)? {
        values.clear();
        for (column, value) in columns.iter().zip(&record) {
            values.push(value.parse().map_err(|_| ReadError::NoNumber {
                path: path.to_owned(),
                line: record.position().map_or(0, csv::Position::line),
                column: column.name().to_owned(),
                value: value.to_owned(),
            })?);
        }
        visit(&values);
    }
    Ok(())
}
