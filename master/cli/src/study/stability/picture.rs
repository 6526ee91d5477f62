//! The picture of a stability map.

use std::path::Path;

use linchpin_master::scene;

use super::{Agreement, CaseMap, Cell, Grid};
use crate::plot::{Chart, MapAxis, MapCell, MapPanel, PlotError, Scale, StabilityMap, Verdict};

/// Draws one panel for each case to `STEM.svg` and `STEM.png`: circles where the simulation is stable, the spectral
/// radius as colour behind.
///
/// # Errors
/// [`PlotError`]: too many cases, nothing to draw, unwritable path.
pub fn draw_map(maps: &[CaseMap], grid: &Grid, stem: &Path) -> Result<(), PlotError> {
    plot_of(maps, grid).write(stem)
}

/// The picture that [`draw_map`] draws; a map of which points are missing is left out.
pub fn plot_of(maps: &[CaseMap], grid: &Grid) -> StabilityMap {
    let panel = |case: &CaseMap| MapPanel {
        title: case.case.clone(),
        x: axis(&grid.x),
        y: axis(&grid.y),
        cells: case.cells.iter().map(drawn).collect(),
    };
    StabilityMap {
        panels: { maps.iter() }
            .filter(|map| map.missing == 0)
            .map(panel)
            .collect(),
        growth_label: "spectral radius".to_owned(),
        has_marks: true,
        lines: Vec::new(),
        points: Vec::new(),
    }
}

fn axis(axis: &scene::Axis) -> MapAxis {
    MapAxis {
        label: axis.label.clone(),
        scale: scale_of(&axis.values),
        values: axis.values.clone(),
    }
}

/// Logarithmic if the middle value lies nearer to the geometric than to the arithmetic mean of the ends.
fn scale_of(values: &[f64]) -> Scale {
    let (Some(&first), Some(&last)) = (values.first(), values.last()) else {
        return Scale::Linear;
    };
    let middle = values[values.len() / 2];
    let geometric = (first * last).sqrt();
    let is_logarithmic = first > 0.0
        && values.len() > 2
        && (middle - geometric).abs() < (middle - f64::midpoint(first, last)).abs();
    if is_logarithmic {
        Scale::Logarithmic
    } else {
        Scale::Linear
    }
}

fn drawn(cell: &Cell) -> MapCell {
    let verdict = match cell.agreement() {
        Some(Agreement::Undecided) => Verdict::Undecided,
        _ => Verdict::of(cell.simulated.is_stable()),
    };
    MapCell {
        verdict,
        growth: cell.radius,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_follows_the_spacing() {
        assert_eq!(scale_of(&[1.0, 10.0, 100.0, 1000.0]), Scale::Logarithmic);
        assert_eq!(scale_of(&[1.0, 2.0, 3.0, 4.0]), Scale::Linear);
        assert_eq!(scale_of(&[0.0, 10.0, 100.0]), Scale::Linear);
    }
}
