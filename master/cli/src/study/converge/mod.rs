//! Convergence: the same scene over a list of macro steps.

mod errors;
mod orders;
mod picture;
mod reference;
mod table;

use linchpin_master::cosimulation::Options;
use linchpin_master::results::Statistics;
use linchpin_master::scene::{self, ConvergeSettings, Override, Scene};
use rayon::prelude::*;

use super::StudyError;
use super::runs::{Kind, Variant, divergence, record};
use crate::closed_form::ClosedForm;
use crate::connect::{Connector, Place};
use crate::simulate::{Recorder, SimulateError, simulate};
use errors::ErrorRecorder;
pub use errors::{Errors, Quantity};
pub use orders::{least_squares, neighbouring};
pub use picture::{draw_errors, draw_work_precision};
use reference::{Reference, TrajectoryRecorder};
pub use table::{summary, write_csv};

/// The runs of one case, from the largest macro step to the smallest.
#[derive(Debug, Clone)]
pub struct CaseRuns {
    /// Name of the case, or of the scene.
    pub case: String,
    /// One run for each macro step.
    pub runs: Vec<ConvergeRun>,
}

/// One run of a convergence study.
#[derive(Debug, Clone)]
pub struct ConvergeRun {
    /// Macro step in s.
    pub macro_step: f64,
    /// What came out.
    pub outcome: Outcome,
}

/// How a run of a study ended.
#[derive(Debug, Clone)]
pub enum Outcome {
    /// At its end.
    Done {
        /// Errors against the reference.
        errors: Errors,
        /// What it cost.
        statistics: Box<Statistics>,
    },
    /// It diverged; why, as a run says it.
    Diverged(String),
}

impl ConvergeRun {
    /// The error of a quantity, if the run came to its end and the reference knows the quantity.
    pub fn error(&self, quantity: Quantity) -> Option<f64> {
        match &self.outcome {
            Outcome::Done { errors, .. } => errors.get(quantity),
            Outcome::Diverged(_) => None,
        }
    }
}

/// Number of runs of a study, for its progress.
pub fn number_of_runs(scene: &Scene, settings: &ConvergeSettings) -> usize {
    scene.cases.len().max(1) * settings.macro_steps.len()
}

/// Runs the scene, or each of its cases, with every macro step; `tick` is called after each run.
///
/// # Errors
/// [`StudyError`]: a macro step does not fit the scene, there is no reference, a worker failed. A run that diverges is
/// no error.
pub fn converge(
    scene: &Scene,
    settings: &ConvergeSettings,
    tick: &(dyn Fn() + Sync),
) -> Result<Vec<CaseRuns>, StudyError> {
    let mut macro_steps = settings.macro_steps.clone();
    macro_steps.sort_by(f64::total_cmp);
    let studies = Variant::all(scene)?
        .into_par_iter()
        .map(|variant| Study::new(variant, settings.reference, &macro_steps, tick))
        .collect::<Result<Vec<_>, _>>()?;
    // The smallest steps take the longest: they are begun first.
    let points: Vec<(&Study, f64)> = macro_steps
        .iter()
        .flat_map(|&step| studies.iter().map(move |study| (study, step)))
        .collect();
    let run_one = |(study, macro_step): &(&Study, f64)| study.run(*macro_step, tick);
    let runs = points
        .par_iter()
        .with_max_len(1)
        .map(run_one)
        .collect::<Result<Vec<_>, _>>()?;
    let of_case = |(number, study): (usize, &Study)| CaseRuns {
        case: study.variant.name.clone(),
        runs: runs[number..]
            .iter()
            .step_by(studies.len())
            .rev()
            .cloned()
            .collect(),
    };
    Ok(studies.iter().enumerate().map(of_case).collect())
}

/// One case and what its runs are compared with.
struct Study {
    variant: Variant,
    columns: Vec<(String, Kind)>,
    reference: Reference,
    /// The run that is the reference.
    finest: Option<ConvergeRun>,
}

impl Study {
    fn new(
        mut variant: Variant,
        reference: scene::Reference,
        macro_steps: &[f64],
        tick: &(dyn Fn() + Sync),
    ) -> Result<Self, StudyError> {
        let columns = variant.judged_columns(&variant.models()?)?;
        variant.scene.output.every = 1;
        record(&mut variant.scene, &columns);
        let (reference, finest) = match reference {
            scene::Reference::ClosedForm => {
                let closed_form = ClosedForm::of(&variant.scene);
                let closed_form = closed_form.ok_or_else(|| StudyError::NoClosedForm {
                    case: variant.in_words(),
                })?;
                (Reference::closed_form(closed_form, &columns), None)
            }
            scene::Reference::Finest => {
                let finest = macro_steps[0];
                let mut recorder = TrajectoryRecorder::new(&columns);
                let statistics = run(&variant, finest, &mut recorder)?;
                tick();
                let statistics = statistics.map_err(|reason| StudyError::ReferenceDiverged {
                    case: variant.in_words(),
                    macro_step: finest,
                    reason,
                })?;
                let outcome = Outcome::Done {
                    errors: Errors::default(),
                    statistics: Box::new(statistics),
                };
                let finest = ConvergeRun {
                    macro_step: finest,
                    outcome,
                };
                (recorder.into_reference(), Some(finest))
            }
        };
        Ok(Self {
            variant,
            columns,
            reference,
            finest,
        })
    }

    fn run(&self, macro_step: f64, tick: &(dyn Fn() + Sync)) -> Result<ConvergeRun, StudyError> {
        if let Some(finest) = &self.finest
            && finest.macro_step == macro_step
        {
            return Ok(finest.clone());
        }
        let are_means = self.variant.scene.coupling.multipliers_are_step_means();
        let mut recorder = ErrorRecorder::new(&self.reference, &self.columns, are_means);
        let outcome = match run(&self.variant, macro_step, &mut recorder)? {
            Ok(statistics) => Outcome::Done {
                errors: recorder.errors(),
                statistics: Box::new(statistics),
            },
            Err(reason) => Outcome::Diverged(reason),
        };
        tick();
        Ok(ConvergeRun {
            macro_step,
            outcome,
        })
    }
}

/// One run; the inner result says whether it came to its end.
fn run(
    variant: &Variant,
    macro_step: f64,
    recorder: &mut impl Recorder<Error = std::convert::Infallible>,
) -> Result<Result<Statistics, String>, StudyError> {
    let scene = variant.scene.with(&[Override {
        key: "coupling.macro_step".to_owned(),
        value: format!("{macro_step:?}"),
    }])?;
    let mut scene = scene.with_fixed_steps();
    scene.output = variant.scene.output.clone();
    let connector = Connector::new(Place::InProcess);
    match simulate(&scene, &connector, &Options::default(), recorder) {
        Ok(statistics) => Ok(Ok(statistics)),
        Err(SimulateError::Run(error)) => divergence(error)
            .map(Err)
            .map_err(|error| variant.failed(error)),
        Err(SimulateError::Record(never)) => match never {},
    }
}
