//! The pictures of one scene of a report.

use super::runs::USELESS;
use super::trace::Trace;
use super::{Ending, SceneReport, SettingReport, StudyRun};
use crate::plot::{
    Chart, Curve, CurvePanel, CurvePlot, Scale, StabilityMap, TimePanel, TimePanels,
};
use crate::study::orders;
use crate::study::run::curve;
use crate::study::stability::plot_of;

/// Name of the monolithic scene in legends.
pub const MONOLITHIC: &str = "monolithic";

/// Most panels of one picture of maps.
const MOST_MAPS: usize = 12;

/// A picture of a scene.
pub struct Picture {
    /// Ending of its file's name.
    pub ending: String,
    /// What it shows.
    pub caption: String,
    /// The picture.
    pub chart: Box<dyn Chart>,
}

impl Picture {
    /// All pictures of a scene that have something to show.
    pub fn all(scene: &SceneReport) -> Vec<Self> {
        let cost = work_precision(scene).map(|plot| Self {
            ending: "cost".to_owned(),
            caption: "Error against cost and macro step; runs that diverged or are off by the whole solution \
                      stand in the table only."
                .to_owned(),
            chart: Box::new(plot),
        });
        let step = scene.trace_step;
        let time = over_time(scene).map(|plot| Self {
            ending: "time".to_owned(),
            caption: format!(
                "Largest residual of all joints, and energy, over time; H = {step:e} s."
            ),
            chart: Box::new(plot),
        });
        let maps = maps(scene).into_iter().enumerate();
        let maps = maps.map(|(number, plot)| Self {
            ending: format!("stability-{}", number + 1),
            caption: "Stability: circles are stable, crosses are not.".to_owned(),
            chart: Box::new(plot),
        });
        cost.into_iter().chain(time).chain(maps).collect()
    }
}

/// Errors over time, integrations, exchanges and macro step; `None` if no run has an error.
fn work_precision(scene: &SceneReport) -> Option<CurvePlot> {
    let mut over_time = panel(scene, "wall time in s", &|run| run.ending.wall_time());
    over_time.curves.extend(monolithic(scene));
    let integrations = "subsystem integrations";
    let mut over_step = panel(scene, "H in s", &|run| Some(run.macro_step));
    over_step.reference_slopes = slopes(scene);
    let panels = vec![
        over_time,
        panel(scene, integrations, &|run| {
            run.count(|own| own.integrations)
        }),
        panel(scene, "exchanges with workers", &|run| {
            run.count(|own| own.exchanges)
        }),
        over_step,
    ];
    let has_points = |panel: &CurvePanel| {
        let mut points = panel.curves.iter().flat_map(|curve| &curve.points);
        points.any(|(x, y)| x.is_finite() && *y > 0.0)
    };
    let can_be_drawn = panels.iter().all(has_points);
    can_be_drawn.then_some(CurvePlot { panels })
}

fn panel(scene: &SceneReport, x_label: &str, x: &dyn Fn(&StudyRun) -> Option<f64>) -> CurvePanel {
    let point = |run: &StudyRun| {
        let error = run.error(scene.quantity)?;
        (error < USELESS).then_some((x(run)?, error))
    };
    let y_label = format!("error of the {} (NRMS)", scene.quantity.name());
    let settings = scene.settings.iter();
    let curves = settings
        .map(|own| curve(&own.name, &own.runs, point))
        .collect();
    CurvePanel::of_errors(x_label, &y_label, curves)
}

fn monolithic(scene: &SceneReport) -> Option<Curve> {
    let point = |ending: &Ending| Some((ending.wall_time()?, ending.error(scene.quantity)?));
    let points = scene.monolithic.iter().filter_map(|run| point(&run.ending));
    let points: Vec<_> = points.collect();
    (!points.is_empty()).then(|| Curve {
        name: MONOLITHIC.to_owned(),
        points,
    })
}

/// Whole orders that the settings show over all macro steps.
fn slopes(scene: &SceneReport) -> Vec<f64> {
    let order = |setting: &SettingReport| orders::least_squares(&setting.runs, scene.quantity);
    let orders = scene.settings.iter().filter_map(order).map(f64::round);
    orders::slopes(orders, 1.0..=6.0)
}

/// Residuals, and energy if the scene tells it, over time; `None` if there is neither.
fn over_time(scene: &SceneReport) -> Option<TimePanels> {
    let panels = [
        time_panel(scene, "residual (position level) in m, rad", |trace| {
            trace.residual.items()
        }),
        time_panel(scene, "relative error of the energy", |trace| {
            trace.energy.items()
        }),
    ];
    let panels: Vec<TimePanel> = panels.into_iter().flatten().collect();
    (!panels.is_empty()).then(|| TimePanels {
        title: None,
        time_label: "t in s".to_owned(),
        panels,
        ..TimePanels::default()
    })
}

fn time_panel(
    scene: &SceneReport,
    label: &str,
    points: impl Fn(&Trace) -> &[(f64, f64)],
) -> Option<TimePanel> {
    let series = |setting: &SettingReport| Curve {
        name: setting.name.clone(),
        points: points(&setting.trace).to_vec(),
    };
    let series: Vec<Curve> = scene.settings.iter().map(series).collect();
    let mut all = series.iter().flat_map(|series| &series.points);
    let can_be_drawn = all.any(|(_, value)| value.is_finite() && *value > 0.0);
    can_be_drawn.then(|| TimePanel {
        y_label: label.to_owned(),
        y_scale: Scale::Logarithmic,
        series,
    })
}

/// The stability maps, as many pictures as they need.
fn maps(scene: &SceneReport) -> Vec<StabilityMap> {
    let Some((grid, maps)) = &scene.maps else {
        return Vec::new();
    };
    let pictures = maps.chunks(MOST_MAPS);
    pictures.map(|maps| plot_of(maps, grid)).collect()
}
