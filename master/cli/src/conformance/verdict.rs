//! What one check found.

use linchpin_master::connection::StartError;
use linchpin_proto::contract::CallError;
use serde::Serialize;

use super::compare::{Comparison, Difference};

/// How a worker stands with one check, from good to bad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Grade {
    /// It does what is asked.
    Pass,
    /// The check does not apply to this model; the reason is told.
    NotApplicable,
    /// It may be right, but whoever uses it should know.
    Warn,
    /// It does not do what is asked.
    Fail,
}

impl Grade {
    /// For people.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::NotApplicable => "not applicable",
            Self::Warn => "warn",
            Self::Fail => "fail",
        }
    }
}

/// One thing that a check has to say.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// How bad it is.
    pub grade: Grade,
    /// What it is.
    pub text: String,
    /// The values that differ.
    pub differences: Vec<Difference>,
}

/// Why a check ended before it was through.
#[derive(Debug)]
pub enum Stop {
    /// It does not apply.
    NotApplicable(String),
    /// A call that must succeed failed.
    Call(CallError),
    /// An answer has the wrong number of values, or one that is not finite.
    Answer(String),
    /// A further connection could not be made.
    Connection(Box<StartError>),
}

impl Stop {
    /// That a check does not apply.
    pub fn not_applicable(reason: impl Into<String>) -> Self {
        Self::NotApplicable(reason.into())
    }

    /// Whether the worker did not answer in time.
    pub fn is_hang(&self) -> bool {
        matches!(self, Self::Call(CallError::Deadline { .. }))
    }

    /// Whether the worker may be gone.
    pub fn is_loss(&self) -> bool {
        match self {
            Self::Call(error) => {
                matches!(
                    error,
                    CallError::Unreachable { .. }
                        | CallError::Lost { .. }
                        | CallError::Deadline { .. }
                )
            }
            Self::Connection(_) => true,
            Self::NotApplicable(_) | Self::Answer(_) => false,
        }
    }
}

impl From<CallError> for Stop {
    fn from(error: CallError) -> Self {
        Self::Call(error)
    }
}

impl From<StartError> for Stop {
    fn from(error: StartError) -> Self {
        Self::Connection(Box::new(error))
    }
}

/// What a check has found so far.
#[derive(Debug, Default)]
pub struct Verdict {
    /// What it has to say against the worker, or about it.
    pub findings: Vec<Finding>,
    /// What it has to say beside that.
    pub notes: Vec<String>,
    /// Values that were compared.
    pub compared: usize,
    /// The comparison that came closest to what is allowed, or went furthest beyond it.
    pub worst: Option<Difference>,
}

impl Verdict {
    /// The grade of the worst finding.
    pub fn grade(&self) -> Grade {
        let grades = self.findings.iter().map(|finding| finding.grade);
        grades.max().unwrap_or(Grade::Pass)
    }

    /// Takes note of a comparison; if it does not hold, that is a finding of this grade.
    pub fn judge(&mut self, comparison: Comparison, grade: Grade, text: impl Into<String>) {
        self.compared += comparison.compared;
        let is_worse = |own: &Difference| {
            self.worst
                .as_ref()
                .is_none_or(|worst| own.ratio() > worst.ratio())
        };
        if let Some(worst) = comparison.worst.filter(is_worse) {
            self.worst = Some(worst);
        }
        if !comparison.beyond.is_empty() {
            self.findings.push(Finding {
                grade,
                text: text.into(),
                differences: comparison.beyond,
            });
        }
    }

    /// A finding without values.
    pub fn find(&mut self, grade: Grade, text: impl Into<String>) {
        self.findings.push(Finding {
            grade,
            text: text.into(),
            differences: Vec::new(),
        });
    }

    /// Something that is no finding.
    pub fn note(&mut self, text: impl Into<String>) {
        self.notes.push(text.into());
    }

    /// That the check ended before it was through.
    pub fn stop(&mut self, stop: Stop) {
        let (grade, text) = match stop {
            Stop::NotApplicable(reason) => (Grade::NotApplicable, reason),
            Stop::Call(error) if error.is_recoverable() => (
                Grade::Warn,
                format!("the model asks for a smaller step: {error}"),
            ),
            Stop::Call(error) => (
                Grade::Fail,
                format!("a call that must succeed failed: {error}"),
            ),
            Stop::Answer(reason) => (Grade::Fail, reason),
            Stop::Connection(error) => (Grade::Fail, format!("no further connection: {error}")),
        };
        self.find(grade, text);
    }
}
