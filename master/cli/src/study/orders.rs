//! Observed orders of convergence.

/// Macro step and error of a run; `None` without an error.
pub type Point = Option<(f64, f64)>;

/// Order between each run and the one with the next larger macro step: `ln(e_1/e_2) / ln(H_1/H_2)`.
pub fn neighbouring(points: impl Iterator<Item = Point>) -> Vec<Option<f64>> {
    let points: Vec<Point> = points.map(logarithmic).collect();
    let between = |pair: &[Point]| {
        let (coarse, fine) = (pair[0]?, pair[1]?);
        Some((coarse.1 - fine.1) / (coarse.0 - fine.0))
    };
    std::iter::once(None)
        .chain(points.windows(2).map(between))
        .take(points.len())
        .collect()
}

/// Slope of the straight line that fits `ln e` over `ln H` best; `None` with fewer than two points.
pub fn least_squares(points: impl Iterator<Item = Point>) -> Option<f64> {
    let points: Vec<_> = points.filter_map(logarithmic).collect();
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

/// An error of 0 has no place.
fn logarithmic(point: Point) -> Point {
    let (macro_step, error) = point.filter(|(_, error)| *error > 0.0)?;
    Some((macro_step.ln(), error.ln()))
}
