//! The picture of a run: motion, residuals and multipliers over time.

use std::path::Path;

use linchpin_master::results::Drawn;
use linchpin_master::scene::Scene;

use super::RunReport;
use crate::commands::CommandError;
use crate::plot::{Scale, TimePanel, TimePanels, TimeSeries, time_panels};

/// Draws the runs of a scene's cases together, or its only run, to `STEM.svg` and `STEM.png`.
pub fn draw(scene: &Scene, reports: &[RunReport], stem: &Path) -> Result<(), CommandError> {
    let is_single = reports.len() == 1;
    let panels = [
        ("position in m", Drawn::Motion),
        ("residual in m", Drawn::Residual),
        ("multiplier in N", Drawn::Multiplier),
    ];
    let panels = panels.into_iter().filter_map(|(y_label, kind)| {
        let mut series = Vec::new();
        for (number, report) in reports.iter().enumerate() {
            let case = scene.cases.get(number);
            let method_of = case.and_then(|case| scene.with_case(case).ok());
            let delay = middle_of_step(method_of.as_ref().unwrap_or(scene), kind);
            let chosen = report.traces.iter().filter(|trace| trace.kind == kind);
            // Several cases: one curve each, so that the picture stays readable.
            let most = if is_single { usize::MAX } else { 1 };
            series.extend(chosen.take(most).map(|trace| {
                let points = trace.points.items().iter();
                let (t, y) = points
                    .map(|(t, y)| ((t - delay).max(scene.t_start), *y))
                    .unzip();
                let name = case.map_or_else(|| trace.name.clone(), |case| case.name.clone());
                TimeSeries { name, t, y }
            }));
        }
        let y_scale = Scale::Linear;
        (!series.is_empty()).then(|| TimePanel {
            y_label: y_label.into(),
            y_scale,
            series,
        })
    });
    let picture = TimePanels {
        title: Some(scene.name.clone()),
        time_label: "t in s".into(),
        panels: panels.collect(),
    };
    Ok(time_panels(&picture, stem)?)
}

/// With `k = 0` a corrected multiplier is the mean over its step, so it belongs to the middle of the step.
fn middle_of_step(scene: &Scene, kind: Drawn) -> f64 {
    if kind == Drawn::Multiplier && scene.coupling.multipliers_are_step_means() {
        scene.coupling.macro_step / 2.0
    } else {
        0.0
    }
}
