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
use serde::{Deserialize, Serialize};

use super::found::each;
use super::runs::{Variant, in_process};
use super::{Found, Pieces, Share, StudyError};
use crate::closed_form::ClosedForm;
use blow_up::BlowUp;
pub use cell::{Agreement, Cell, Simulated};
use deviation::Deviation;
pub use picture::draw_map;
pub(super) use picture::plot_of;
pub use table::{Count, rows, summary};

/// The map of one case.
#[derive(Debug, Clone, Serialize, Deserialize)]
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
#[derive(Debug, Clone, Serialize, Deserialize)]
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
    assemble(scene, grid, points(scene, grid, Share::WHOLE, tick)?)
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
    let names = variants.iter().map(|variant| variant.name.clone());
    let names: Vec<String> = names.collect();
    let points = points_of(variants, grid, Share::WHOLE, tick)?;
    Ok(maps_of(&names, grid, points))
}

/// What was found at one point of one case.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Point {
    cell: Cell,
    no_radius: Option<String>,
}

/// A share of the points of a map, case after case; `tick` is called after each point.
///
/// # Errors
/// As for [`map`].
pub fn points(
    scene: &Scene,
    grid: &Grid,
    share: Share,
    tick: &(dyn Fn() + Sync),
) -> Result<Pieces<Point>, StudyError> {
    points_of(Variant::all(scene)?, grid, share, tick)
}

/// The map that consists of these points.
///
/// # Errors
/// [`StudyError::Scene`]: a case does not fit the scene.
pub fn assemble(
    scene: &Scene,
    grid: &Grid,
    points: Pieces<Point>,
) -> Result<Found<Vec<CaseMap>>, StudyError> {
    let variants = Variant::all(scene)?.into_iter();
    let names: Vec<String> = variants.map(|variant| variant.name).collect();
    Ok(maps_of(&names, grid, points))
}

fn points_of(
    variants: Vec<Variant>,
    grid: &Grid,
    share: Share,
    tick: &(dyn Fn() + Sync),
) -> Result<Pieces<Point>, StudyError> {
    let places = |case: usize| case * grid.len()..(case + 1) * grid.len();
    let is_due = |case: usize| places(case).any(|place| share.has(place));
    let due = variants
        .into_iter()
        .enumerate()
        .map(|(case, variant)| is_due(case).then(|| Study::new(variant, grid)).transpose());
    let studies = due.collect::<Result<Vec<_>, _>>()?;
    let places = { studies.iter() }
        .flat_map(|study| grid.points().map(move |point| (study, point)))
        .enumerate();
    let tasks = places.map(|(place, (study, point))| match share.has(place) {
        true => Some((study.as_ref()?, point)),
        false => None,
    });
    let tasks: Vec<Option<(&Study, (f64, f64))>> = tasks.collect();
    Ok(each(&tasks, |(study, point)| {
        let found = study.point(grid, *point);
        tick();
        found
    }))
}

fn maps_of(names: &[String], grid: &Grid, points: Pieces<Point>) -> Found<Vec<CaseMap>> {
    let tasks = { names.iter() }.flat_map(|name| grid.points().map(move |point| (name, point)));
    let missing = tasks.zip(&points.results);
    let missing = missing.filter(|(_, found)| found.is_none());
    let missing =
        missing.map(|((name, (x, y)), _)| format!("{name}, point ({}, {})", number(x), number(y)));
    let missing = missing.collect();
    let mut results = points.results.into_iter();
    let of_case = |name: &String| {
        let own: Vec<Point> = results.by_ref().take(grid.len()).flatten().collect();
        CaseMap {
            case: name.clone(),
            missing: grid.len() - own.len(),
            no_radius: own.first().and_then(|point| point.no_radius.clone()),
            cells: own.into_iter().map(|point| point.cell).collect(),
        }
    };
    Found {
        results: names.iter().map(of_case).collect(),
        missing,
        stopped: points.stopped,
    }
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

    fn point(&self, grid: &Grid, point: (f64, f64)) -> Result<Point, StudyError> {
        Ok(Point {
            cell: self.cell(grid, point)?,
            no_radius: self.no_radius.clone(),
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
