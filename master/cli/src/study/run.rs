//! The runs of a study and how they end.

use linchpin_master::results::Statistics;
use serde::{Deserialize, Serialize};

use super::errors::{Errors, Quantity};
use super::orders::Point;
use crate::plot::Curve;

/// A run at one macro step.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct StudyRun {
    /// Macro step in s.
    pub macro_step: f64,
    /// How it ended.
    pub ending: Ending,
}

/// How a run of a study ended.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum Ending {
    /// At its end.
    Done {
        /// Errors against the reference.
        errors: Errors,
        /// What it cost.
        statistics: Box<Statistics>,
    },
    /// It diverged or failed; why, as a run says it.
    Stopped(String),
    /// The scene cannot have this method; why.
    Refused(String),
    /// It was not made, since the study ended early.
    Missing,
}

impl StudyRun {
    /// One that was not made.
    pub fn missing(macro_step: f64) -> Self {
        let ending = Ending::Missing;
        Self { macro_step, ending }
    }

    /// The error of a quantity, if the run came to its end and the reference knows the quantity.
    pub fn error(&self, quantity: Quantity) -> Option<f64> {
        self.ending.error(quantity)
    }

    /// Macro step and error.
    pub fn point(&self, quantity: Quantity) -> Point {
        Some((self.macro_step, self.error(quantity)?))
    }

    /// A count of the run, if it came to its end.
    pub fn count(&self, of: fn(&Statistics) -> u64) -> Option<f64> {
        self.ending.statistics().map(|own| of(own) as f64)
    }
}

impl Ending {
    /// That of a run which was told how it diverged, if it did.
    pub fn of(statistics: Result<Statistics, String>, errors: Errors) -> Self {
        match statistics {
            Ok(statistics) => Self::Done {
                errors,
                statistics: Box::new(statistics),
            },
            Err(reason) => Self::Stopped(reason),
        }
    }

    /// The error of a quantity, if the run came to its end and the reference knows the quantity.
    pub fn error(&self, quantity: Quantity) -> Option<f64> {
        match self {
            Self::Done { errors, .. } => errors.get(quantity),
            _ => None,
        }
    }

    /// What the run cost, if it came to its end.
    pub fn statistics(&self) -> Option<&Statistics> {
        match self {
            Self::Done { statistics, .. } => Some(statistics),
            _ => None,
        }
    }

    /// The time of all its macro steps in s, if it came to its end.
    pub fn wall_time(&self) -> Option<f64> {
        self.statistics().map(|own| own.time_total)
    }
}

/// A curve with a point for each run; one without is a gap in the line.
pub fn curve(
    name: &str,
    runs: &[StudyRun],
    point: impl Fn(&StudyRun) -> Option<(f64, f64)>,
) -> Curve {
    let points = runs
        .iter()
        .map(|run| point(run).unwrap_or((f64::NAN, f64::NAN)));
    Curve {
        name: name.to_owned(),
        points: points.collect(),
    }
}
