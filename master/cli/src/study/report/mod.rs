//! The report of a study: every scene with every setting, what the errors cost, and one page that shows it all.
//!
//! Runs whose time is measured run one after the other, in this process and without sockets; stability maps, which count
//! nothing, run in parallel.

mod envelope;
mod page;
mod pictures;
mod plan;
mod runs;
mod scene;
mod summary;
mod table;
mod trace;

use linchpin_master::scene::Measure;
use serde::{Deserialize, Serialize};

use super::errors::Quantity;
pub use super::run::{Ending, StudyRun};
use super::stability::{CaseMap, Grid};
use super::{Found, Pieces, Share};
pub use envelope::{Bound, Cheapest, Cost, Ratio, cheapest, cost_of, ratio};
pub use page::text as page;
pub use pictures::Picture;
use plan::PlannedScene;
pub use plan::{Depth, Plan};
pub use runs::ToleranceRun;
pub use summary::{EnvelopeRow, envelope};
pub use table::json;
use trace::Trace;

/// Everything that a report shows.
pub struct Report {
    /// Name of the study.
    pub name: String,
    /// Its heading.
    pub title: String,
    /// Relative errors whose cost is asked for.
    pub targets: Vec<f64>,
    /// How much of the study was run.
    pub depth: Depth,
    /// Its scenes.
    pub scenes: Vec<SceneReport>,
}

/// One scene with all its settings.
#[derive(Serialize, Deserialize)]
pub struct SceneReport {
    /// Name in the study.
    pub name: String,
    /// Its file.
    pub file: String,
    /// What the errors are of.
    pub quantity: Quantity,
    /// What the runs are compared with, for a reader.
    pub reference: String,
    /// Macro step of the curves over time in s.
    pub trace_step: f64,
    /// The settings in the order of the study.
    pub settings: Vec<SettingReport>,
    /// Runs of the monolithic scene over the tolerances of its solver; empty if there is none.
    pub monolithic: Vec<ToleranceRun>,
    /// Stability maps, one for each setting that the scene can have.
    maps: Option<(Grid, Vec<CaseMap>)>,
}

/// One setting of one scene.
#[derive(Serialize, Deserialize)]
pub struct SettingReport {
    /// Its name.
    pub name: String,
    /// Its coupling method.
    pub method: String,
    /// Whether the paper itself uses it.
    pub is_paper: bool,
    /// What it sets, as `KEY=VALUE`.
    pub set: Vec<String>,
    /// One run for each macro step, from the largest to the smallest.
    pub runs: Vec<StudyRun>,
    trace: Trace,
}

/// Makes all runs of a plan; `tick` is called after each run and each point of a map.
///
/// A mistake in a scene or setting, a missing reference or an interrupt end the report early, with the scenes up to then. A run that
/// diverges does not, nor does a method that a scene cannot have.
pub fn report(plan: &Plan, tick: &(dyn Fn() + Sync)) -> Found<Report> {
    assemble(plan, scenes(plan, Share::WHOLE, tick))
}

/// What was found of one scene.
#[derive(Serialize, Deserialize)]
pub struct Piece {
    report: SceneReport,
    missing: Vec<String>,
}

/// Makes the runs of a share of the scenes, as [`report`] does.
pub fn scenes(plan: &Plan, share: Share, tick: &(dyn Fn() + Sync)) -> Pieces<Piece> {
    let mut stopped = None;
    let mut one = |(place, planned): (usize, &PlannedScene)| {
        if !share.has(place) || stopped.is_some() {
            return None;
        }
        match scene::run(planned, plan.depth, tick) {
            Ok(found) => {
                stopped = found.stopped;
                Some(Piece {
                    report: found.results,
                    missing: found.missing,
                })
            }
            Err(error) => {
                stopped = Some(error);
                None
            }
        }
    };
    let results = plan.scenes.iter().enumerate().map(&mut one).collect();
    Pieces { results, stopped }
}

/// The report that consists of these scenes.
pub fn assemble(plan: &Plan, pieces: Pieces<Piece>) -> Found<Report> {
    let mut scenes = Vec::new();
    let mut missing = Vec::new();
    for (planned, piece) in plan.scenes.iter().zip(pieces.results) {
        match piece {
            Some(piece) => {
                scenes.push(piece.report);
                missing.extend(piece.missing);
            }
            None => missing.push(planned.name.clone()),
        }
    }
    let results = Report {
        name: plan.name.clone(),
        title: plan.title.clone(),
        targets: plan.targets.clone(),
        depth: plan.depth,
        scenes,
    };
    Found {
        results,
        missing,
        stopped: pieces.stopped,
    }
}

fn quantity_of(measure: Measure) -> Quantity {
    match measure {
        Measure::Position => Quantity::Position,
        Measure::Velocity => Quantity::Velocity,
        Measure::State => Quantity::State,
        Measure::Multiplier => Quantity::Multiplier,
    }
}
