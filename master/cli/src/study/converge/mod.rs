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
use super::{Found, StudyError};
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
    let (runs, stopped) = each(&points, |(study, step)| study.run(*step, tick));
    let name =
        |(study, step): &(&Study, f64)| format!("{}, H = {} s", study.variant.name, number(*step));
    let missing = points.iter().zip(&runs).filter(|(_, run)| run.is_none());
    let missing = missing.map(|(point, _)| name(point)).collect();
    let runs: Vec<StudyRun> = { points.iter().zip(runs) }
        .map(|((_, macro_step), run)| run.unwrap_or_else(|| StudyRun::missing(*macro_step)))
        .collect();
    let of_case = |(number, study): (usize, &Study)| CaseRuns {
        case: study.variant.name.clone(),
        runs: runs[number..]
            .iter()
            .step_by(studies.len())
            .rev()
            .cloned()
            .collect(),
    };
    Ok(Found {
        results: studies.iter().enumerate().map(of_case).collect(),
        missing,
        stopped,
    })
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
