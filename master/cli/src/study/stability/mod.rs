//! Stability over two settings: by simulation, and by the spectral radius of the macro-step map where there is one.

mod blow_up;
mod cell;
mod deviation;
mod picture;
mod table;

use linchpin_master::probe::{ProbeError, macro_step_map};
use linchpin_master::scene::{Axis, Scene, StabilitySettings};
use linchpin_proto::readable::number;
use linchpin_proto::v1::Model;

use super::found::each;
use super::runs::{Variant, in_process};
use super::{Found, StudyError};
use crate::closed_form::ClosedForm;
use blow_up::BlowUp;
pub use cell::{Agreement, Cell, Simulated};
use deviation::Deviation;
pub use picture::draw_map;
pub(super) use picture::plot_of;
pub use table::{Count, rows, summary};

/// The map of one case.
#[derive(Debug, Clone)]
pub struct CaseMap {
    /// Name of the case, or of the scene.
    pub case: String,
    /// Cells row after row: x runs faster. Those that are missing are left out.
    pub cells: Vec<Cell>,
    /// Number of cells that are missing, since the study ended early.
    pub missing: usize,
    /// Why there are no spectral radii, if there are none.
    pub no_radius: Option<String>,
}

/// Values of both axes in increasing order.
#[derive(Debug, Clone)]
pub struct Grid {
    x: Axis,
    y: Axis,
}

impl Grid {
    /// The grid that the settings describe.
    pub fn new(settings: &StabilitySettings) -> Self {
        let sorted = |axis: &Axis| {
            let mut axis = axis.clone();
            axis.values.sort_by(f64::total_cmp);
            axis.values.dedup();
            axis
        };
        Self {
            x: sorted(&settings.x),
            y: sorted(&settings.y),
        }
    }

    /// The grid with at most `most` values of either axis, the first and the last one among them.
    pub(super) fn thinned(&self, most: usize) -> Self {
        let thinned = |axis: &Axis| {
            let last = axis.values.len() - 1;
            let kept = most.min(axis.values.len());
            let place = |number: usize| number * last / kept.saturating_sub(1).max(1);
            Axis {
                values: (0..kept).map(|number| axis.values[place(number)]).collect(),
                ..axis.clone()
            }
        };
        Self {
            x: thinned(&self.x),
            y: thinned(&self.y),
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.x.values.len() * self.y.values.len()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The points row after row.
    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        let rows = self.y.values.iter();
        rows.flat_map(|&y| self.x.values.iter().map(move |&x| (x, y)))
    }

    /// The smallest macro step of all points, if these differ in their coupling only.
    fn smallest_step(&self, scene: &Scene) -> Result<Option<f64>, StudyError> {
        let mut keys = self.x.keys.iter().chain(&self.y.keys);
        if !keys.all(|key| key.starts_with("coupling.")) {
            return Ok(None);
        }
        let step = |point| Ok(self.scene(scene, point)?.coupling.macro_step);
        let steps = self
            .points()
            .map(step)
            .collect::<Result<Vec<f64>, StudyError>>()?;
        Ok(steps.into_iter().reduce(f64::min))
    }

    /// The scene at one point.
    fn scene(&self, scene: &Scene, (x, y): (f64, f64)) -> Result<Scene, StudyError> {
        let overrides = [self.x.overrides(x), self.y.overrides(y)].concat();
        Ok(scene.with(&overrides)?.with_fixed_steps())
    }
}

/// Number of points of a study, for its progress.
pub fn number_of_points(scene: &Scene, grid: &Grid) -> usize {
    scene.cases.len().max(1) * grid.len()
}

/// Maps the scene, or each of its cases; `tick` is called after each point.
///
/// # Errors
/// [`StudyError`]: a point of the grid does not fit the scene, a worker failed in another way than by diverging. Once there are
/// points, that ends the study early, with the points up to then.
pub fn map(
    scene: &Scene,
    grid: &Grid,
    tick: &(dyn Fn() + Sync),
) -> Result<Found<Vec<CaseMap>>, StudyError> {
    map_variants(Variant::all(scene)?, grid, tick)
}

/// The same for variants of a scene.
///
/// # Errors
/// [`StudyError`], as for [`map`].
pub(super) fn map_variants(
    variants: Vec<Variant>,
    grid: &Grid,
    tick: &(dyn Fn() + Sync),
) -> Result<Found<Vec<CaseMap>>, StudyError> {
    let studies = variants
        .into_iter()
        .map(|variant| Study::new(variant, grid))
        .collect::<Result<Vec<_>, _>>()?;
    let tasks: Vec<(&Study, (f64, f64))> = studies
        .iter()
        .flat_map(|study| grid.points().map(move |point| (study, point)))
        .collect();
    let judge = |(study, point): &(&Study, (f64, f64))| {
        let cell = study.cell(grid, *point);
        tick();
        cell
    };
    let (cells, stopped) = each(&tasks, judge);
    let name = |(study, (x, y)): &(&Study, (f64, f64))| {
        format!(
            "{}, point ({}, {})",
            study.variant.name,
            number(*x),
            number(*y)
        )
    };
    let missing = tasks.iter().zip(&cells).filter(|(_, cell)| cell.is_none());
    let missing = missing.map(|(task, _)| name(task)).collect();
    let mut cells = cells.into_iter();
    let of_case = |study: &Study| {
        let own = cells.by_ref().take(grid.len());
        let own: Vec<Cell> = own.flatten().collect();
        CaseMap {
            case: study.variant.name.clone(),
            missing: grid.len() - own.len(),
            cells: own,
            no_radius: study.no_radius.clone(),
        }
    };
    Ok(Found {
        results: studies.iter().map(of_case).collect(),
        missing,
        stopped,
    })
}

/// One case.
struct Study {
    variant: Variant,
    models: Vec<Model>,
    judge: Judge,
    no_radius: Option<String>,
}

/// How a simulation is judged.
enum Judge {
    /// A linear scene: by its own growth.
    Growth(BlowUp),
    /// Any other: by its deviation from a reference run.
    Deviation(Deviation),
}

impl Study {
    fn new(variant: Variant, grid: &Grid) -> Result<Self, StudyError> {
        let models = variant.models()?;
        let columns = variant.judged_columns(&models)?;
        let no_radius = match grid.points().next() {
            None => None,
            Some(point) => reason_against_map(&variant, &grid.scene(&variant.scene, point)?)?,
        };
        let is_linear = no_radius.is_none() || ClosedForm::of(&variant.scene).is_some();
        let judge = if is_linear {
            Judge::Growth(BlowUp::new(columns))
        } else {
            let smallest_step = grid.smallest_step(&variant.scene)?;
            Judge::Deviation(Deviation::new(&variant, columns, smallest_step)?)
        };
        Ok(Self {
            variant,
            models,
            judge,
            no_radius,
        })
    }

    fn cell(&self, grid: &Grid, point: (f64, f64)) -> Result<Cell, StudyError> {
        let scene = grid.scene(&self.variant.scene, point)?;
        let simulated = match &self.judge {
            Judge::Growth(judge) => {
                in_process(|connect| judge.simulate(&scene, &self.models, connect))
            }
            Judge::Deviation(judge) => judge.simulate(&scene),
        };
        let simulated = simulated.map_err(|error| self.variant.failed(error))?;
        let radius = match &self.no_radius {
            Some(_) => None,
            None => self.radius(&scene)?,
        };
        Ok(Cell {
            x: point.0,
            y: point.1,
            simulated,
            radius,
        })
    }

    /// The spectral radius; `None` where the co-simulation fails within its first steps, or where rounding hides it.
    fn radius(&self, scene: &Scene) -> Result<Option<f64>, StudyError> {
        let map = in_process(|connect| macro_step_map(scene, connect));
        match map.and_then(|map| map.spectral_radius()) {
            Ok(radius) => Ok(Some(radius)),
            Err(ProbeError::Run(error)) => self.variant.nothing_if_diverged(error),
            Err(_) => Ok(None),
        }
    }
}

/// Why scenes of this kind have no macro-step map; `None` if they have one.
fn reason_against_map(variant: &Variant, scene: &Scene) -> Result<Option<String>, StudyError> {
    match in_process(|connect| macro_step_map(scene, connect)) {
        Ok(_) => Ok(None),
        Err(ProbeError::Run(error)) => variant.nothing_if_diverged(error),
        Err(reason) => Ok(Some(reason.to_string())),
    }
}
