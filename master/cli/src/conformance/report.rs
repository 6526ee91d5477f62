//! All that was found.

mod json;
mod junit;
mod text;

use std::time::Duration;

use serde::Serialize;

use super::checks::About;
use super::compare::Difference;
use super::verdict::{Finding, Grade, Verdict};

/// What one check found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckReport {
    /// Name of the check.
    pub name: &'static str,
    /// What it checks.
    pub title: &'static str,
    /// How the worker stands.
    pub grade: Grade,
    /// Values that were compared.
    pub compared: usize,
    /// The comparison that came closest to what is allowed, or went furthest beyond it.
    pub worst: Option<Difference>,
    /// What it has to say against the worker, or why it does not apply.
    pub findings: Vec<Finding>,
    /// What it has to say beside that.
    pub notes: Vec<String>,
    /// What the author should look at if it fails.
    pub look_at: &'static str,
    /// How long it took (s).
    pub seconds: f64,
    /// Whether the worker is gone or hangs since.
    #[serde(skip)]
    pub(super) lost_the_worker: bool,
}

impl CheckReport {
    pub(super) fn new(
        about: About,
        verdict: Verdict,
        lost_the_worker: bool,
        time: Duration,
    ) -> Self {
        Self {
            name: about.name,
            title: about.title,
            grade: verdict.grade(),
            compared: verdict.compared,
            worst: verdict.worst,
            findings: verdict.findings,
            notes: verdict.notes,
            look_at: about.look_at,
            seconds: time.as_secs_f64(),
            lost_the_worker,
        }
    }
}

/// What all checks found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Name of the worker's program.
    pub worker: String,
    /// Its version.
    pub worker_version: String,
    /// The model.
    pub model: String,
    /// Macro steps (s) at which it was examined.
    pub steps: Vec<f64>,
    /// One for every check.
    pub checks: Vec<CheckReport>,
    /// How its process ended and what it said last, if it is gone.
    pub last_words: Option<String>,
}

impl Report {
    /// Whether no check failed.
    pub fn is_sound(&self) -> bool {
        self.count(Grade::Fail) == 0
    }

    /// How many checks ended with this grade.
    pub fn count(&self, grade: Grade) -> usize {
        self.checks.iter().filter(|own| own.grade == grade).count()
    }

    /// Names of the checks with this grade.
    pub fn names(&self, grade: Grade) -> Vec<&'static str> {
        let own = self.checks.iter().filter(|own| own.grade == grade);
        own.map(|own| own.name).collect()
    }
}
