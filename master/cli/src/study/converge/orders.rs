//! Observed orders of convergence.

use super::{ConvergeRun, Quantity};

/// Order between each run and the one with the next larger macro step: `ln(e_1/e_2) / ln(H_1/H_2)`.
pub fn neighbouring(runs: &[ConvergeRun], quantity: Quantity) -> Vec<Option<f64>> {
    let points: Vec<_> = runs.iter().map(|run| point(run, quantity)).collect();
    let between = |pair: &[Option<(f64, f64)>]| {
        let (coarse, fine) = (pair[0]?, pair[1]?);
        Some((coarse.1 - fine.1) / (coarse.0 - fine.0))
    };
    std::iter::once(None)
        .chain(points.windows(2).map(between))
        .take(runs.len())
        .collect()
}

/// Slope of the straight line that fits `ln e` over `ln H` best; `None` with fewer than two points.
pub fn least_squares(runs: &[ConvergeRun], quantity: Quantity) -> Option<f64> {
    let points: Vec<_> = runs.iter().filter_map(|run| point(run, quantity)).collect();
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

/// `(ln H, ln e)`; an error of 0 has no place.
fn point(run: &ConvergeRun, quantity: Quantity) -> Option<(f64, f64)> {
    let error = run.error(quantity).filter(|error| *error > 0.0)?;
    Some((run.macro_step.ln(), error.ln()))
}
