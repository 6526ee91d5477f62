//! Whether a worker does what the contract and mechanics ask of it.
//!
//! The kit drives instances of one model as a master would, and compares the answers with each other: a step with its two
//! halves, a velocity with the mean of the accelerations, a restored state with the one that was kept. It knows nothing of the
//! model but its description, so every tolerance is a share of something that was measured, and where a quantity must agree
//! only in the limit the step is shortened until it does.
//!
//! * [`peer`]: how the worker is reached;
//! * [`subject`]: the model as it describes itself;
//! * [`instance`]: one instance with its sequence of calls;
//! * [`inputs`]: input polynomials in the share of a step;
//! * [`bench`]: what every check starts from: instances that are in motion;
//! * [`measured`]: what several checks measure;
//! * [`compare`]: comparisons with what is allowed;
//! * [`verdict`]: what a check found;
//! * [`checks`]: the checks, one file each;
//! * [`report`]: all that was found, as text, JSON and JUnit.

pub mod bench;
pub mod checks;
pub mod compare;
pub mod error;
pub mod inputs;
pub mod instance;
pub mod measured;
pub mod peer;
pub mod report;
pub mod subject;
pub mod verdict;

use std::collections::BTreeMap;
use std::time::Instant;

use linchpin_proto::v1::{self, Value};

use bench::Bench;
use checks::{Check, all};
pub use error::ConformanceError;
use peer::Peer;
use report::{CheckReport, Report};
use verdict::{Stop, Verdict};

/// What is examined, and at which steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Name of the model; `None`: the only one of the worker.
    pub model: Option<String>,
    /// Parameters of the model.
    pub parameters: BTreeMap<String, Value>,
    /// Solver of the model; `None`: its first.
    pub solver: Option<v1::Solver>,
    /// Macro steps (s) at which the model will be used; not empty, all positive.
    pub steps: Vec<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            model: None,
            parameters: BTreeMap::new(),
            solver: None,
            steps: vec![DEFAULT_STEP],
        }
    }
}

/// The macro step (s) where none is given.
pub const DEFAULT_STEP: f64 = 1e-3;

/// Examines a worker with every check. `progress` is told the name of each before it begins.
///
/// # Errors
/// [`ConformanceError`] if the worker cannot be examined at all: it is not there, or makes no instance of the model.
pub fn run(
    peer: &dyn Peer,
    settings: &Settings,
    progress: &dyn Fn(&str),
) -> Result<Report, ConformanceError> {
    let bench = Bench::new(peer, settings)?;
    let mut checks = Vec::new();
    let mut is_gone = false;
    for check in all() {
        progress(check.about().name);
        let report = match is_gone {
            true => skipped(&*check),
            false => examine(&*check, &bench),
        };
        is_gone |= report.lost_the_worker;
        checks.push(report);
    }
    Ok(Report {
        worker: bench.worker.clone(),
        worker_version: bench.worker_version.clone(),
        model: bench.subject.name.clone(),
        steps: settings.steps.clone(),
        checks,
        last_words: is_gone.then(|| peer.last_words().to_string()),
    })
}

fn examine(check: &dyn Check, bench: &Bench<'_>) -> CheckReport {
    let started = Instant::now();
    let mut verdict = Verdict::default();
    let stop = check.run(bench, &mut verdict).err();
    let is_lost = |stop: &Stop| stop.is_hang() || (stop.is_loss() && !bench.is_alive());
    let lost_the_worker = stop.as_ref().is_some_and(is_lost);
    if let Some(stop) = stop {
        verdict.stop(stop);
    }
    CheckReport::new(check.about(), verdict, lost_the_worker, started.elapsed())
}

fn skipped(check: &dyn Check) -> CheckReport {
    let mut verdict = Verdict::default();
    verdict.stop(Stop::not_applicable(
        "the worker is gone or hangs since the check above",
    ));
    CheckReport::new(check.about(), verdict, false, std::time::Duration::ZERO)
}
