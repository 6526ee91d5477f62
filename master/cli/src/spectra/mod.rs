//! Spectra of integration schemes: what `linchpin spectrum` computes, as tables and pictures.
//!
//! * [`table`]: `spectrum.csv`, `region.csv` and the summary;
//! * [`picture`]: radius and period error over the step, the region of stable parameters.

pub mod picture;
pub mod table;

use linchpin_master::scene::{SpectrumCurve, SpectrumFile, SpectrumRegion, SpectrumScheme};
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::spectrum::{Growth, Probe, Spectrum, SpectrumError, growth};
use rayon::prelude::*;

/// A scheme with its spectra, one for each step over period.
pub struct CurveSpectra {
    /// Its label.
    pub label: String,
    /// In the order of the sweep.
    pub spectra: Vec<Spectrum>,
}

/// A point of the region of parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegionCell {
    /// Abscissa.
    pub alpha_m: f64,
    /// Ordinate.
    pub alpha_f: f64,
    /// Growth of vibrations there.
    pub growth: Growth,
}

/// A scheme whose spectra were not found.
#[derive(Debug, thiserror::Error)]
#[error("curve \"{label}\": {source}")]
pub struct FailedCurve {
    /// Its label.
    label: String,
    /// Why.
    source: SpectrumError,
}

/// Number of calls of `tick` that [`curves`] and [`region`] make together.
pub fn number_of_points(file: &SpectrumFile) -> usize {
    let region = file.region.as_ref();
    let cells = region.map_or(0, |region| region.alpha_m.len() * region.alpha_f.len());
    file.curves.len() * file.sweep.len() + cells
}

/// Spectra of all schemes of a file; `tick` is called for every one.
///
/// # Errors
/// The first scheme that fails.
pub fn curves(
    file: &SpectrumFile,
    tick: &(dyn Fn() + Sync),
) -> Result<Vec<CurveSpectra>, FailedCurve> {
    let curves = file.curves.par_iter();
    { curves }
        .map(|curve| curve_of(curve, &file.sweep, tick))
        .collect()
}

fn curve_of(
    curve: &SpectrumCurve,
    sweep: &[f64],
    tick: &(dyn Fn() + Sync),
) -> Result<CurveSpectra, FailedCurve> {
    let failed = |source| FailedCurve {
        label: curve.label.clone(),
        source,
    };
    let mut probe = Probe::new(kind(curve.scheme)).map_err(|source| failed(source.into()))?;
    let spectra = sweep.iter().map(|&ratio| {
        let spectrum = probe.spectrum(ratio);
        tick();
        spectrum
    });
    Ok(CurveSpectra {
        label: curve.label.clone(),
        spectra: spectra.collect::<Result<_, _>>().map_err(failed)?,
    })
}

/// Growth at all points of a region, row after row of constant `alpha_f`.
pub fn region(region: &SpectrumRegion, tick: &(dyn Fn() + Sync)) -> Vec<RegionCell> {
    let rows = region.alpha_f.par_iter();
    let cells = rows.flat_map_iter(|&alpha_f| {
        region.alpha_m.iter().map(move |&alpha_m| {
            let growth = growth(alpha_m, alpha_f);
            tick();
            RegionCell {
                alpha_m,
                alpha_f,
                growth,
            }
        })
    });
    cells.collect()
}

fn kind(scheme: SpectrumScheme) -> SchemeKind {
    match scheme {
        SpectrumScheme::GeneralizedAlpha { rho_inf } => SchemeKind::GeneralizedAlpha { rho_inf },
        SpectrumScheme::NewmarkAlpha { alpha_m, alpha_f } => {
            SchemeKind::NewmarkAlpha { alpha_m, alpha_f }
        }
        SpectrumScheme::Bathe => SchemeKind::Bathe,
        SpectrumScheme::EdAlpha { rho_inf, alpha_ar } => SchemeKind::EdAlpha { rho_inf, alpha_ar },
        SpectrumScheme::Moreau => SchemeKind::Moreau,
        SpectrumScheme::Hets => SchemeKind::Hets,
    }
}
