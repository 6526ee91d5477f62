//! Spectra as tables.

use std::fmt::Write;

use linchpin_models::nonsmooth::spectrum::Spectrum;
use serde::Serialize;

use super::{CurveSpectra, RegionCell};
use crate::plot::Verdict;

/// A radius up to `1 + ROUNDING` counts as stable.
const ROUNDING: f64 = 1e-6;

/// A row of `spectrum.csv`; where a scheme does not vibrate, the fields of its vibration are empty.
#[derive(Serialize)]
struct Record<'a> {
    curve: &'a str,
    dt_over_period: f64,
    spectral_radius: f64,
    principal_modulus: Option<f64>,
    relative_period_error: Option<f64>,
    damping_ratio: Option<f64>,
}

/// A row of `region.csv`.
#[derive(Serialize)]
struct RegionRecord {
    alpha_m: f64,
    alpha_f: f64,
    largest_radius: f64,
    radius_at_infinity: f64,
    verdict: &'static str,
}

/// A row of `spectrum.csv` for each scheme and step.
pub fn curve_rows(curves: &[CurveSpectra]) -> impl Iterator<Item = impl Serialize> {
    curves.iter().flat_map(|curve| {
        curve.spectra.iter().map(|spectrum| Record {
            curve: &curve.label,
            dt_over_period: spectrum.dt_over_period,
            spectral_radius: spectrum.radius,
            principal_modulus: spectrum.principal_modulus(),
            relative_period_error: spectrum.period_error(),
            damping_ratio: spectrum.damping_ratio(),
        })
    })
}

/// A row of `region.csv` for each point.
pub fn region_rows(cells: &[RegionCell]) -> impl Iterator<Item = impl Serialize> {
    cells.iter().map(|cell| RegionRecord {
        alpha_m: cell.alpha_m,
        alpha_f: cell.alpha_f,
        largest_radius: cell.growth.largest,
        radius_at_infinity: cell.growth.at_infinity,
        verdict: Verdict::of(cell.growth.is_stable()).name(),
    })
}

/// A line for each scheme, and one for the region.
pub fn summary(curves: &[CurveSpectra], cells: &[RegionCell]) -> String {
    let mut text = String::new();
    for curve in curves {
        let is_unstable = |spectrum: &&Spectrum| spectrum.radius > 1.0 + ROUNDING;
        let (unstable, last) = (curve.spectra.iter().find(is_unstable), curve.spectra.last());
        // Writing to a text does not fail.
        let _ = match (unstable, last) {
            (Some(first), _) => writeln!(
                text,
                "{}: unstable from dt / T = {:.3} on",
                curve.label, first.dt_over_period
            ),
            (None, Some(last)) => writeln!(
                text,
                "{}: spectral radius {:.4} at dt / T = {}",
                curve.label, last.radius, last.dt_over_period
            ),
            (None, None) => Ok(()),
        };
    }
    if !cells.is_empty() {
        let stable = cells.iter().filter(|cell| cell.growth.is_stable()).count();
        let _ = writeln!(text, "region: {stable} of {} points stable", cells.len());
    }
    text
}
