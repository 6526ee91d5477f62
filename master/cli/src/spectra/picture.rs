//! Spectra as pictures.

use std::path::Path;

use linchpin_master::scene::{SpectrumFile, SpectrumRegion};
use linchpin_models::nonsmooth::spectrum::Spectrum;

use super::{CurveSpectra, RegionCell};
use crate::plot::{
    Chart, Curve, CurvePanel, CurvePlot, MapAxis, MapCell, MapPanel, Markers, NamedPoint,
    PlotError, RegionLine, Scale, StabilityMap, Verdict,
};

/// What the picture shows of radii: explicit schemes go far beyond.
const RADII: (f64, f64) = (0.0, 1.1);

/// Radii above are shown as this one.
const MOST_GROWTH: f64 = 2.0;

/// Draws spectral radius and relative period error over `dt / T` to `STEM.svg` and `STEM.png`.
///
/// # Errors
/// [`PlotError`]: unwritable path.
pub fn draw_curves(
    file: &SpectrumFile,
    found: &[CurveSpectra],
    stem: &Path,
) -> Result<(), PlotError> {
    let first = file.sweep.first().copied().unwrap_or_default();
    let last = file.sweep.last().copied().unwrap_or_default();
    let radii = CurvePanel {
        title: String::new(),
        x_label: "dt / T".to_owned(),
        y_label: "spectral radius".to_owned(),
        scales: [Scale::Logarithmic, Scale::Linear],
        x_range: Some((first, last)),
        y_range: Some(RADII),
        curves: curves_of(found, |spectrum| Some(spectrum.radius)),
        markers: Markers::Spread,
        reference_slopes: Vec::new(),
    };
    let period_errors = CurvePanel {
        y_label: "relative period error".to_owned(),
        scales: [Scale::Linear; 2],
        x_range: Some((0.0, file.period_to)),
        y_range: None,
        curves: curves_of(found, Spectrum::period_error),
        ..radii.clone()
    };
    let panels = vec![radii, period_errors];
    CurvePlot { panels }.write(stem)
}

fn curves_of(found: &[CurveSpectra], value: impl Fn(&Spectrum) -> Option<f64>) -> Vec<Curve> {
    let point = |spectrum: &Spectrum| {
        let value = value(spectrum).unwrap_or(f64::NAN);
        (spectrum.dt_over_period, value)
    };
    let curve = |curve: &CurveSpectra| Curve {
        name: curve.label.clone(),
        points: curve.spectra.iter().map(point).collect(),
    };
    found.iter().map(curve).collect()
}

/// Draws the region of parameters of generalised-alpha to `STEM.svg` and `STEM.png`: the radius for infinite
/// frequency where all frequencies are stable, otherwise the largest of all frequencies; the limits of S2 eq. (100)
/// and the line of equal roots.
///
/// # Errors
/// [`PlotError`]: unwritable path.
pub fn draw_region(
    settings: &SpectrumRegion,
    cells: &[RegionCell],
    stem: &Path,
) -> Result<(), PlotError> {
    let axis = |label: &str, values: &[f64]| MapAxis {
        label: label.to_owned(),
        scale: Scale::Linear,
        values: values.to_vec(),
    };
    let point = |point: &linchpin_master::scene::RegionPoint| NamedPoint {
        name: point.label.clone(),
        place: (point.alpha_m, point.alpha_f),
    };
    let panel = MapPanel {
        title: String::new(),
        x: axis("alpha_m", &settings.alpha_m),
        y: axis("alpha_f", &settings.alpha_f),
        cells: cells.iter().map(cell_of).collect(),
    };
    let plot = StabilityMap {
        panels: vec![panel],
        has_marks: false,
        growth_label: format!("spectral radius for infinite frequency, up to {MOST_GROWTH}"),
        lines: lines(settings),
        points: settings.points.iter().map(point).collect(),
    };
    plot.write(stem)
}

fn cell_of(cell: &RegionCell) -> MapCell {
    let is_stable = cell.growth.is_stable();
    let growth = match is_stable {
        true => cell.growth.at_infinity.min(1.0),
        false => cell.growth.largest.min(MOST_GROWTH),
    };
    MapCell {
        verdict: Verdict::of(is_stable),
        growth: Some(growth),
    }
}

/// The limits of stability (100), and the line of equal roots at infinity (104) between its points B and D.
fn lines(settings: &SpectrumRegion) -> Vec<RegionLine> {
    let of = |values: &[f64], which: fn(f64, f64) -> f64| values.iter().copied().reduce(which);
    let least = of(&settings.alpha_m, f64::min).unwrap_or_default();
    let least = least.min(of(&settings.alpha_f, f64::min).unwrap_or_default()) - 1.0;
    vec![
        RegionLine {
            name: "limits of stability, alpha_m <= alpha_f <= 1/2".to_owned(),
            is_dotted: false,
            points: vec![(least, least), (0.5, 0.5), (least, 0.5)],
        },
        RegionLine {
            name: "equal roots, alpha_f = (alpha_m + 1)/3".to_owned(),
            is_dotted: true,
            points: vec![(-1.0, 0.0), (0.5, 0.5)],
        },
    ]
}
