//! Observed orders of convergence.

use std::ops::RangeInclusive;

use super::errors::Quantity;
use super::run::StudyRun;

/// Macro step and error of a run; `None` without an error.
pub type Point = Option<(f64, f64)>;

/// Order between each run and the one with the next larger macro step: `ln(e_1/e_2) / ln(H_1/H_2)`.
pub fn neighbouring(runs: &[StudyRun], quantity: Quantity) -> Vec<Option<f64>> {
    let points: Vec<Point> = logarithmic(runs, quantity).collect();
    let between = |pair: &[Point]| {
        let (coarse, fine) = (pair[0]?, pair[1]?);
        Some((coarse.1 - fine.1) / (coarse.0 - fine.0))
    };
    std::iter::once(None)
        .chain(points.windows(2).map(between))
        .take(points.len())
        .collect()
}

/// Slope of the straight line that fits `ln e` over `ln H` best; `None` with fewer than two errors.
pub fn least_squares(runs: &[StudyRun], quantity: Quantity) -> Option<f64> {
    let points: Vec<_> = logarithmic(runs, quantity).flatten().collect();
    if points.len() < 2 {
        return None;
    }
    let mean =
        |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let products: f64 = points
        .iter()
        .map(|point| (point.0 - x) * (point.1 - y))
        .sum();
    let squares: f64 = points.iter().map(|point| (point.0 - x).powi(2)).sum();
    Some(products / squares)
}

/// The slopes of reference lines: those within these limits, each once.
pub fn slopes(orders: impl Iterator<Item = f64>, limits: RangeInclusive<f64>) -> Vec<f64> {
    let mut slopes: Vec<f64> = orders.filter(|order| limits.contains(order)).collect();
    slopes.sort_by(f64::total_cmp);
    slopes.dedup();
    slopes
}

/// Logarithms of macro steps and errors; an error of 0 has no place.
fn logarithmic(runs: &[StudyRun], quantity: Quantity) -> impl Iterator<Item = Point> {
    runs.iter().map(move |run| {
        let (macro_step, error) = run.point(quantity).filter(|(_, error)| *error > 0.0)?;
        Some((macro_step.ln(), error.ln()))
    })
}
