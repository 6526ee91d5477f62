//! Pictures of a convergence study.

use std::path::Path;

use linchpin_master::results::Statistics;

use super::{CaseRuns, Quantity, StudyRun, neighbouring};
use crate::plot::{Chart, Curve, CurvePanel, CurvePlot, PlotError};
use crate::study::orders;
use crate::study::run::curve;

/// What is counted of a run.
type Count = fn(&Statistics) -> u64;

/// Slopes beyond these are due to rounding or divergence and get no line.
const SLOPES: std::ops::RangeInclusive<f64> = 1.0..=5.0;

/// Draws the errors over the macro step to `STEM.svg` and `STEM.png`.
///
/// # Errors
/// [`PlotError`]: nothing to draw, unwritable path.
pub fn draw_errors(cases: &[CaseRuns], stem: &Path) -> Result<(), PlotError> {
    let quantities = [
        (Quantity::State, "error of the state norm"),
        (Quantity::Position, "error of the position"),
        (Quantity::Multiplier, "error of the multiplier"),
        (
            Quantity::MultiplierAtMidStep,
            "error of the multiplier, mid-step",
        ),
    ];
    let panel = |(quantity, title): (Quantity, &str)| {
        let curves = curves(cases, |run| Some((run.macro_step, run.error(quantity)?)));
        CurvePanel {
            title: title.to_owned(),
            reference_slopes: slopes(cases, quantity),
            ..CurvePanel::of_errors("H in s", "NRMS", curves)
        }
    };
    draw(quantities.into_iter().map(panel), stem)
}

/// Draws the errors over the numbers of integrations and of exchanges to `STEM.svg` and `STEM.png`.
///
/// # Errors
/// [`PlotError`]: nothing to draw, unwritable path.
pub fn draw_work_precision(cases: &[CaseRuns], stem: &Path) -> Result<(), PlotError> {
    let quantities = [
        (Quantity::State, "error of the state norm over cost"),
        (Quantity::Multiplier, "error of the multiplier over cost"),
    ];
    let costs: [(Count, &str); 2] = [
        (|own| own.integrations, "integrations over a macro step"),
        (|own| own.exchanges, "exchanges with workers"),
    ];
    let panel = |(quantity, title): (Quantity, &str)| {
        costs.map(|(cost, x_label)| {
            let curves = curves(cases, |run| Some((run.count(cost)?, run.error(quantity)?)));
            CurvePanel {
                title: title.to_owned(),
                ..CurvePanel::of_errors(x_label, "NRMS", curves)
            }
        })
    };
    draw(quantities.into_iter().flat_map(panel), stem)
}

/// Draws the panels that have points.
fn draw(panels: impl Iterator<Item = CurvePanel>, stem: &Path) -> Result<(), PlotError> {
    let has_points = |panel: &CurvePanel| {
        let mut points = panel.curves.iter().flat_map(|curve| &curve.points);
        points.any(|point| point.1.is_finite())
    };
    let panels = panels.filter(has_points).collect();
    CurvePlot { panels }.write(stem)
}

fn curves(cases: &[CaseRuns], point: impl Fn(&StudyRun) -> Option<(f64, f64)>) -> Vec<Curve> {
    let cases = cases.iter();
    cases
        .map(|case| curve(&case.case, &case.runs, &point))
        .collect()
}

/// The multiples of a half next to the orders that the smallest macro steps show, each once.
fn slopes(cases: &[CaseRuns], quantity: Quantity) -> Vec<f64> {
    let last_order = |case: &CaseRuns| {
        neighbouring(&case.runs, quantity)
            .into_iter()
            .flatten()
            .last()
    };
    let last_orders = cases.iter().filter_map(last_order);
    orders::slopes(last_orders.map(|order| (2.0 * order).round() / 2.0), SLOPES)
}
