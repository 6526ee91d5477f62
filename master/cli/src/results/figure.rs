//! The picture of a run: what the scene's panels show, or motion, residuals and multipliers over time; and the impacts.

use std::path::Path;

use linchpin_master::results::{Drawn, Row};
use linchpin_master::scene::{Panel, Scene};

use super::{Impacts, RunReport, Trace};
use crate::commands::CommandError;
use crate::plot::{Chart, Curve, Portrait, Scale, TimeMarks, TimePanel, TimePanels};

/// The panels of a scene that names none; those without curves are left out.
const USUAL: [(&str, Drawn); 4] = [
    ("position", Drawn::Motion),
    ("residual", Drawn::Residual),
    ("multiplier", Drawn::Multiplier),
    ("output", Drawn::Output),
];

/// Name of marked impacts in the legend.
const IMPACT: &str = "impact";

/// Draws the runs of a scene's cases together, or its only run, to `STEM.svg` and `STEM.png`; a scene that couples and
/// records nothing has no picture.
pub fn draw(scene: &Scene, reports: &[RunReport], stem: &Path) -> Result<(), CommandError> {
    let impacts = reports.iter().filter_map(|report| report.impacts.as_ref());
    let mut picture = TimePanels {
        title: Some(scene.name.clone()),
        time_label: "t in s".into(),
        marks: TimeMarks {
            name: IMPACT.into(),
            t: impacts.flat_map(Impacts::times).collect(),
        },
        ..TimePanels::default()
    };
    let labels: Vec<(&str, Option<&Panel>)> = match &scene.output.panels[..] {
        [] => USUAL.iter().map(|(label, _)| (*label, None)).collect(),
        own => own
            .iter()
            .map(|panel| (panel.label.as_str(), Some(panel)))
            .collect(),
    };
    for (number, (label, panel)) in labels.into_iter().enumerate() {
        let curves = curves_of(scene, reports, number);
        if curves.is_empty() {
            continue;
        }
        let y_label = label.to_owned();
        match panel.and_then(|panel| panel.over.as_ref()) {
            None => picture.panels.push(TimePanel {
                y_label,
                y_scale: Scale::Linear,
                series: curves,
            }),
            Some(over) => picture.portraits.push(Portrait {
                x_label: over.label.clone(),
                y_label,
                paths: curves,
            }),
        }
    }
    if picture.panels.is_empty() && picture.portraits.is_empty() {
        return Ok(());
    }
    Ok(picture.write(stem)?)
}

/// The curves of one panel.
fn curves_of(scene: &Scene, reports: &[RunReport], panel: usize) -> Vec<Curve> {
    let is_single = scene.cases.len() <= 1;
    let is_usual = scene.output.panels.is_empty();
    let is_over_time = is_usual || scene.output.panels[panel].over.is_none();
    let mut curves = Vec::new();
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
        curves.extend(chosen.take(most).map(|trace| {
            let points = trace.points.items().iter();
            let points = if is_over_time {
                let delay = middle_of_step(resolved, trace);
                let delayed = |(t, y): &(f64, f64)| ((t - delay).max(scene.t_start), *y);
                points.map(delayed).collect()
            } else {
                points.copied().collect()
            };
            let name = match case {
                None => trace.name.clone(),
                Some(case) if is_only => case.name.clone(),
                Some(case) => format!("{}: {}", trace.name, case.name),
            };
            Curve { name, points }
        }));
    }
    curves
}

/// With `k = 0` a corrected multiplier is the mean over its step, so it belongs to the middle of the step.
fn middle_of_step(scene: &Scene, trace: &Trace) -> f64 {
    if trace.shows_multipliers && scene.coupling.multipliers_are_step_means() {
        scene.coupling.macro_step / 2.0
    } else {
        0.0
    }
}

/// Place of the time in a row.
const TIME: usize = 0;

/// The series of the picture, still empty.
pub(super) fn traces(scene: &Scene, row: &Row) -> Vec<Trace> {
    if scene.output.panels.is_empty() {
        return usual_traces(row);
    }
    let place_of = |column: &String| row.columns().iter().position(|name| name == column);
    let places_of = |sum: &[String]| -> Vec<usize> { sum.iter().filter_map(place_of).collect() };
    let is_multiplier = |place: &usize| row.drawn(*place) == Some(Drawn::Multiplier);
    let panels = scene.output.panels.iter().enumerate();
    let traced = panels.flat_map(|(panel, own)| {
        let over = own.over.as_ref();
        let over = over.map_or_else(|| vec![TIME], |over| places_of(&over.column));
        own.curves.iter().map(move |curve| {
            let places = places_of(curve);
            let shows_multipliers = places.iter().any(is_multiplier);
            let places = [over.clone(), places];
            Trace::new(curve.join(" + "), panel, shows_multipliers, places)
        })
    });
    traced.collect()
}

fn usual_traces(row: &Row) -> Vec<Trace> {
    let columns = row.columns().iter().enumerate();
    let traced = |(place, name): (usize, &String)| {
        let drawn = row.drawn(place)?;
        let panel = USUAL.iter().position(|(_, kind)| *kind == drawn)?;
        let shows_multipliers = drawn == Drawn::Multiplier;
        let places = [vec![TIME], vec![place]];
        Some(Trace::new(name.clone(), panel, shows_multipliers, places))
    };
    columns.filter_map(traced).collect()
}
