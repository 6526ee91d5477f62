//! The picture of a run: what the scene's panels show, or motion, residuals and multipliers, over time.

use std::path::Path;

use linchpin_master::results::{Drawn, Row};
use linchpin_master::scene::Scene;

use super::{RunReport, Trace};
use crate::commands::CommandError;
use crate::plot::{Scale, TimePanel, TimePanels, TimeSeries, time_panels};

/// The panels of a scene that names none; those without curves are left out.
const USUAL: [(&str, Drawn); 4] = [
    ("position", Drawn::Motion),
    ("residual", Drawn::Residual),
    ("multiplier", Drawn::Multiplier),
    ("output", Drawn::Output),
];

/// The empty series of the picture, each with the places of its columns in a row.
pub(super) fn traces(scene: &Scene, row: &Row) -> Vec<(Vec<usize>, Trace)> {
    let panels = &scene.output.panels;
    if panels.is_empty() {
        let columns = row.columns().iter().enumerate();
        let trace = |(place, name): (usize, &String)| {
            let drawn = row.drawn(place)?;
            let panel = USUAL.iter().position(|(_, kind)| *kind == drawn)?;
            let trace = Trace::new(name.clone(), panel, drawn == Drawn::Multiplier);
            Some((vec![place], trace))
        };
        return columns.filter_map(trace).collect();
    }
    let place_of = |column: &String| row.columns().iter().position(|name| name == column);
    let curves = panels
        .iter()
        .enumerate()
        .flat_map(|(panel, own)| own.curves.iter().map(move |curve| (panel, curve)));
    let trace = |(panel, curve): (usize, &Vec<String>)| {
        let places: Vec<usize> = curve.iter().filter_map(place_of).collect();
        let is_multiplier = |place: &usize| row.drawn(*place) == Some(Drawn::Multiplier);
        let shows_multipliers = places.iter().any(is_multiplier);
        (
            places,
            Trace::new(curve.join(" + "), panel, shows_multipliers),
        )
    };
    curves.map(trace).collect()
}

/// Draws the runs of a scene's cases together, or its only run, to `STEM.svg` and `STEM.png`; a scene that couples and
/// records nothing has no picture.
pub fn draw(scene: &Scene, reports: &[RunReport], stem: &Path) -> Result<(), CommandError> {
    let own = scene.output.panels.iter().map(|panel| panel.label.as_str());
    let labels: Vec<&str> = match scene.output.panels[..] {
        [] => USUAL.iter().map(|(label, _)| *label).collect(),
        _ => own.collect(),
    };
    let panels: Vec<TimePanel> = { labels.iter().enumerate() }
        .filter_map(|(panel, label)| {
            let series = series_of(scene, reports, panel);
            let y_scale = Scale::Linear;
            (!series.is_empty()).then(|| TimePanel {
                y_label: (*label).into(),
                y_scale,
                series,
            })
        })
        .collect();
    if panels.is_empty() {
        return Ok(());
    }
    let picture = TimePanels {
        title: Some(scene.name.clone()),
        time_label: "t in s".into(),
        panels,
    };
    Ok(time_panels(&picture, stem)?)
}

/// The curves of one panel.
fn series_of(scene: &Scene, reports: &[RunReport], panel: usize) -> Vec<TimeSeries> {
    let is_single = reports.len() == 1;
    let is_usual = scene.output.panels.is_empty();
    let mut series = Vec::new();
    for (number, report) in reports.iter().enumerate() {
        let case = scene.cases.get(number);
        let resolved = case.and_then(|case| scene.with_case(case).ok());
        let resolved = resolved.as_ref().unwrap_or(scene);
        let chosen = report.traces.iter().filter(|trace| trace.panel == panel);
        // Several cases: one curve each, so that the picture stays readable, unless the scene chose the curves.
        let most = if is_single || !is_usual {
            usize::MAX
        } else {
            1
        };
        let is_only = is_usual || scene.output.panels[panel].curves.len() == 1;
        series.extend(chosen.take(most).map(|trace| {
            let delay = middle_of_step(resolved, trace);
            let points = trace.points.items().iter();
            let (t, y) = points
                .map(|(t, y)| ((t - delay).max(scene.t_start), *y))
                .unzip();
            let name = match case {
                None => trace.name.clone(),
                Some(case) if is_only => case.name.clone(),
                Some(case) => format!("{}: {}", trace.name, case.name),
            };
            TimeSeries { name, t, y }
        }));
    }
    series
}

/// With `k = 0` a corrected multiplier is the mean over its step, so it belongs to the middle of the step.
fn middle_of_step(scene: &Scene, trace: &Trace) -> f64 {
    if trace.shows_multipliers && scene.coupling.multipliers_are_step_means() {
        scene.coupling.macro_step / 2.0
    } else {
        0.0
    }
}
