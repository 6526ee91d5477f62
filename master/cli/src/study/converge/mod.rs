//! Convergence: the same scene over a list of macro steps.

mod picture;
mod table;

use linchpin_master::results::Statistics;
use linchpin_master::scene::{self, ConvergeSettings, Scene};
use linchpin_proto::readable::number;
use rayon::prelude::*;

use super::columns::{Column, names, record};
use super::errors::RunErrors;
pub use super::errors::{Errors, Quantity};
use super::found::each;
pub use super::orders::{least_squares, neighbouring};
use super::reference::Reference;
pub use super::run::{Ending, StudyRun};
use super::runs::{Variant, watched, with_macro_step};
use super::{Found, Pieces, Share, StudyError};
pub use picture::{draw_errors, draw_work_precision};
pub use table::{rows, summary};

/// The runs of one case, from the largest macro step to the smallest.
#[derive(Debug, Clone)]
pub struct CaseRuns {
    /// Name of the case, or of the scene.
    pub case: String,
    /// One run for each macro step.
    pub runs: Vec<StudyRun>,
}

/// Number of runs of a study, for its progress.
pub fn number_of_runs(scene: &Scene, settings: &ConvergeSettings) -> usize {
    scene.cases.len().max(1) * settings.macro_steps.len()
}

/// Runs the scene, or each of its cases, with every macro step; `tick` is called after each run.
///
/// # Errors
/// [`StudyError`]: a macro step does not fit the scene, the reference that is asked for does not exist, a worker failed. A
/// run that diverges is no error. What happens once there is something to compare with ends the study early, with the runs up to then.
pub fn converge(
    scene: &Scene,
    settings: &ConvergeSettings,
    tick: &(dyn Fn() + Sync),
) -> Result<Found<Vec<CaseRuns>>, StudyError> {
    assemble(scene, settings, runs(scene, settings, Share::WHOLE, tick)?)
}

/// A share of the runs, those with the smallest macro steps first; `tick` is called after each run. Where a case is compared with
/// its finest run, every part makes that run.
///
/// # Errors
/// As for [`converge`].
pub fn runs(
    scene: &Scene,
    settings: &ConvergeSettings,
    share: Share,
    tick: &(dyn Fn() + Sync),
) -> Result<Pieces<StudyRun>, StudyError> {
    let macro_steps = sorted(settings);
    let variants = Variant::all(scene)?;
    let cases = variants.len();
    let is_due = |case: usize| (0..macro_steps.len()).any(|step| share.has(step * cases + case));
    let studies = { variants.into_par_iter().enumerate() }
        .map(|(case, variant)| {
            let study = || Study::new(variant, settings.reference, &macro_steps, tick);
            is_due(case).then(study).transpose()
        })
        .collect::<Result<Vec<_>, _>>()?;
    // The smallest steps take the longest: they are begun first.
    let places = { macro_steps.iter() }
        .flat_map(|&step| studies.iter().map(move |study| (study, step)))
        .enumerate();
    let tasks = places.map(|(place, (study, step))| match share.has(place) {
        true => Some((study.as_ref()?, step)),
        false => None,
    });
    let tasks: Vec<Option<(&Study, f64)>> = tasks.collect();
    Ok(each(&tasks, |(study, step)| study.run(*step, tick)))
}

/// The study that consists of these runs.
///
/// # Errors
/// [`StudyError::Scene`]: a case does not fit the scene.
pub fn assemble(
    scene: &Scene,
    settings: &ConvergeSettings,
    runs: Pieces<StudyRun>,
) -> Result<Found<Vec<CaseRuns>>, StudyError> {
    let variants = Variant::all(scene)?;
    let macro_steps = sorted(settings);
    let points = { macro_steps.iter() }
        .flat_map(|&step| variants.iter().map(move |variant| (&variant.name, step)));
    let mut missing = Vec::new();
    let made = points.zip(runs.results).map(|((name, step), run)| {
        run.unwrap_or_else(|| {
            missing.push(format!("{name}, H = {} s", number(step)));
            StudyRun::missing(step)
        })
    });
    let made: Vec<StudyRun> = made.collect();
    let of_case = |(number, variant): (usize, &Variant)| CaseRuns {
        case: variant.name.clone(),
        runs: made[number..]
            .iter()
            .step_by(variants.len())
            .rev()
            .cloned()
            .collect(),
    };
    Ok(Found {
        results: variants.iter().enumerate().map(of_case).collect(),
        missing,
        stopped: runs.stopped,
    })
}

fn sorted(settings: &ConvergeSettings) -> Vec<f64> {
    let mut macro_steps = settings.macro_steps.clone();
    macro_steps.sort_by(f64::total_cmp);
    macro_steps
}

/// One case and what its runs are compared with.
struct Study {
    variant: Variant,
    columns: Vec<Column>,
    /// `None` if it would be the finest run, but that has diverged.
    reference: Option<Reference>,
    /// The finest run, if the reference should be it.
    finest: Option<StudyRun>,
}

impl Study {
    fn new(
        mut variant: Variant,
        reference: scene::Reference,
        macro_steps: &[f64],
        tick: &(dyn Fn() + Sync),
    ) -> Result<Self, StudyError> {
        let columns = variant.judged_columns(&variant.models()?)?;
        record(&mut variant.scene, &columns);
        let mut study = Self {
            reference: Reference::known(&variant, &columns, reference)?,
            finest: None,
            columns,
            variant,
        };
        if study.reference.is_none() {
            study.run_finest(macro_steps[0])?;
            tick();
        }
        Ok(study)
    }

    /// Makes the run with the smallest macro step the reference; if it diverges there is none.
    fn run_finest(&mut self, macro_step: f64) -> Result<(), StudyError> {
        let scene = with_macro_step(&self.variant.scene, macro_step)?;
        let run = Reference::of_run(&scene, &self.columns);
        let run = run.map_err(|error| self.variant.failed(error))?;
        let statistics = run.map(|(reference, statistics)| {
            self.reference = Some(reference);
            statistics
        });
        let ending = Ending::of(statistics, Errors::default());
        self.finest = Some(StudyRun { macro_step, ending });
        Ok(())
    }

    fn run(&self, macro_step: f64, tick: &(dyn Fn() + Sync)) -> Result<StudyRun, StudyError> {
        if let Some(finest) = &self.finest
            && finest.macro_step == macro_step
        {
            return Ok(finest.clone());
        }
        let ending = match &self.reference {
            Some(reference) => self.compared(reference, macro_step)?,
            None => self.alone(macro_step)?,
        };
        tick();
        Ok(StudyRun { macro_step, ending })
    }

    fn compared(&self, reference: &Reference, macro_step: f64) -> Result<Ending, StudyError> {
        let are_means = self.variant.scene.coupling.multipliers_are_step_means();
        let mut errors = RunErrors::new(reference, &self.columns, are_means);
        let statistics = self.simulate(macro_step, |t, values| errors.add(t, values))?;
        Ok(Ending::of(statistics, errors.errors()))
    }

    /// A run that nothing can be compared with: the finest one has diverged.
    fn alone(&self, macro_step: f64) -> Result<Ending, StudyError> {
        let statistics = self.simulate(macro_step, |_, _| ())?;
        Ok(Ending::of(statistics, Errors::default()))
    }

    fn simulate(
        &self,
        macro_step: f64,
        take: impl FnMut(f64, &[Option<f64>]),
    ) -> Result<Result<Statistics, String>, StudyError> {
        let scene = with_macro_step(&self.variant.scene, macro_step)?;
        watched(&scene, &names(&self.columns), take).map_err(|error| self.variant.failed(error))
    }
}
