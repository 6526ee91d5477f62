//! All runs of one scene of a report.

use linchpin_master::RunError;
use linchpin_master::scene::{self, Scene};
use linchpin_proto::readable::number;

use super::plan::{PlannedScene, PlannedSetting};
use super::runs::{Compared, ToleranceRun};
use super::trace::{Trace, TraceRecorder};
use super::{Depth, Ending, SceneReport, SettingReport, quantity_of};
use crate::interrupt;
use crate::study::columns::{Column, record};
use crate::study::reference::{Monolithic, Reference};
use crate::study::runs::{Variant, simulated, with_macro_step};
use crate::study::stability::{CaseMap, Grid, map_variants};
use crate::study::{Found, StudyError};

/// Tolerances of the solver of a monolithic scene.
const TOLERANCES: [f64; 9] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11];

/// Most values along an axis of a stability map with [`Depth::Quick`].
const QUICK_VALUES: usize = 4;

/// The finest run that takes the place of a reference has steps so much shorter than the smallest ones of the study.
const REFINEMENT: f64 = 2.0;

/// Runs everything, or as much as there is time for before an interrupt.
pub fn run(
    planned: &PlannedScene,
    depth: Depth,
    tick: &(dyn Fn() + Sync),
) -> Result<Found<SceneReport>, StudyError> {
    let mut variant = Variant {
        name: planned.name.clone(),
        scene: planned.scene.clone(),
    };
    let columns = variant.judged_columns(&variant.models()?)?;
    record(&mut variant.scene, &columns);
    let (reference, words) = reference(planned, &variant, &columns)?;
    let compared = Compared {
        columns: &columns,
        reference: &reference,
        depth,
    };
    let settings = planned.settings.iter();
    let settings = settings.map(|setting| run_setting(planned, setting, &compared, tick));
    let settings = settings.collect::<Result<Vec<_>, _>>()?;
    let maps = maps(planned, &settings, depth, tick)?;
    let (maps, mut missing, mut stopped) = match maps {
        None => (None, Vec::new(), None),
        Some((grid, found)) => (Some((grid, found.results)), found.missing, found.stopped),
    };
    let report = SceneReport {
        name: planned.name.clone(),
        file: planned.file.display().to_string(),
        quantity: quantity_of(planned.measure),
        reference: words,
        trace_step: planned.trace_step,
        monolithic: run_monolithic(&variant, planned.macro_steps[0], &compared, tick)?,
        settings,
        maps,
    };
    missing.extend(report.missing_runs());
    if stopped.is_none() && interrupt::of_process().is_requested() && !missing.is_empty() {
        let t = variant.scene.t_start;
        stopped = Some(variant.failed(RunError::Interrupted { t }));
    }
    Ok(Found {
        results: report,
        missing,
        stopped,
    })
}

impl SceneReport {
    /// Runs that were not made.
    fn missing_runs(&self) -> Vec<String> {
        let is_missing = |ending: &Ending| matches!(ending, Ending::Missing);
        let of_setting = |setting: &SettingReport| {
            let runs = setting.runs.iter().filter(|run| is_missing(&run.ending));
            let names = runs.map(|run| {
                format!(
                    "{}, {}, H = {} s",
                    self.name,
                    setting.name,
                    number(run.macro_step)
                )
            });
            names.collect::<Vec<_>>()
        };
        let monolithic = self.monolithic.iter();
        let monolithic = monolithic.filter(|run| is_missing(&run.ending));
        let monolithic = monolithic.map(|run| {
            format!(
                "{}, monolithic, tolerance {}",
                self.name,
                number(run.tolerance)
            )
        });
        { self.settings.iter() }
            .flat_map(of_setting)
            .chain(monolithic)
            .collect()
    }
}

/// The reference, and what it is in words.
fn reference(
    planned: &PlannedScene,
    variant: &Variant,
    columns: &[Column],
) -> Result<(Reference, String), StudyError> {
    if let Some(known) = Reference::known(variant, columns, scene::Reference::Automatic)? {
        let words = match known {
            Reference::ClosedForm { .. } => "the closed form of the solution",
            Reference::Run { .. } => "a monolithic run",
        };
        return Ok((known, words.to_owned()));
    }
    let smallest = planned.macro_steps[planned.macro_steps.len() - 1] / REFINEMENT;
    let scene = with_macro_step(&variant.scene, smallest)?;
    let run = Reference::of_run(&scene, columns).map_err(|error| variant.failed(error))?;
    let (reference, _) = run.map_err(|reason| StudyError::ReferenceDiverged {
        case: variant.in_words(),
        macro_step: smallest,
        reason,
    })?;
    let words = format!("the scene as its file has it, with H = {smallest:.3e} s");
    Ok((reference, words))
}

fn run_setting(
    planned: &PlannedScene,
    setting: &PlannedSetting,
    compared: &Compared<'_>,
    tick: &(dyn Fn() + Sync),
) -> Result<SettingReport, StudyError> {
    let mut scene = setting.scene.clone();
    record(&mut scene, compared.columns);
    let run_one = |macro_step: &f64| {
        let run = compared.run(&scene, *macro_step);
        tick();
        run
    };
    let runs = planned.macro_steps.iter().map(run_one);
    let runs = runs.collect::<Result<Vec<_>, _>>()?;
    let trace = trace(&scene, planned.trace_step, compared)?;
    tick();
    Ok(SettingReport {
        name: setting.name.clone(),
        method: method_name(&setting.scene)?,
        is_paper: setting.is_paper,
        set: setting.set.clone(),
        runs,
        trace,
    })
}

/// The name of the coupling method in scenes.
fn method_name(scene: &Scene) -> Result<String, StudyError> {
    let method = serde_json::to_value(scene.coupling.method)?;
    let name = method.get("name").and_then(serde_json::Value::as_str);
    Ok(name.unwrap_or_default().to_owned())
}

/// Residual and energy over time, as far as the run comes.
fn trace(scene: &Scene, macro_step: f64, compared: &Compared<'_>) -> Result<Trace, StudyError> {
    let scene = with_macro_step(scene, macro_step)?;
    let mut recorder = TraceRecorder::new(compared.reference, compared.columns);
    // A run that fails is told among the runs whose time is measured.
    let _ = simulated(&scene, &mut recorder);
    Ok(recorder.into_trace())
}

fn run_monolithic(
    variant: &Variant,
    macro_step: f64,
    compared: &Compared<'_>,
    tick: &(dyn Fn() + Sync),
) -> Result<Vec<ToleranceRun>, StudyError> {
    let Some(monolithic) = Monolithic::of(&variant.scene, compared.columns)? else {
        return Ok(Vec::new());
    };
    let run_one = |tolerance: f64| {
        let run = compared.run_monolithic(&monolithic, tolerance, macro_step);
        tick();
        run
    };
    TOLERANCES.into_iter().map(run_one).collect()
}

/// A grid, and the maps on it as far as they were found.
type GridMaps = (Grid, Found<Vec<CaseMap>>);

/// The map of the scene, a panel for each setting that it can have.
fn maps(
    planned: &PlannedScene,
    settings: &[SettingReport],
    depth: Depth,
    tick: &(dyn Fn() + Sync),
) -> Result<Option<GridMaps>, StudyError> {
    let Some(grid) = planned.grid(depth) else {
        return Ok(None);
    };
    let is_possible = |(_, report): &(&PlannedSetting, &SettingReport)| {
        let mut runs = report.runs.iter();
        runs.all(|run| !matches!(run.ending, Ending::Refused(_)))
    };
    let variant = |(setting, _): (&PlannedSetting, &SettingReport)| Variant {
        name: setting.name.clone(),
        scene: setting.scene.clone(),
    };
    let pairs = planned.settings.iter().zip(settings);
    let variants = pairs.filter(is_possible).map(variant).collect();
    if interrupt::of_process().is_requested() {
        return Ok(None);
    }
    let maps = map_variants(variants, &grid, tick)?;
    Ok(Some((grid, maps)))
}

impl PlannedScene {
    pub(super) fn number_of_tasks(&self, depth: Depth) -> usize {
        let points = self.grid(depth).map_or(0, |grid| grid.len());
        let runs = self.macro_steps.len() + 1;
        let monolithic = self
            .scene
            .monolithic
            .as_ref()
            .map_or(0, |_| TOLERANCES.len());
        self.settings.len() * (runs + points) + monolithic
    }

    fn grid(&self, depth: Depth) -> Option<Grid> {
        let grid = Grid::new(self.scene.stability.as_ref()?);
        match depth {
            Depth::Full => Some(grid),
            Depth::Quick => Some(grid.thinned(QUICK_VALUES)),
        }
    }
}
