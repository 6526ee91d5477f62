//! Spectral properties of the schemes: golden data, closed forms, and what S2 says in Sect. 2.4.1, 2.6.1, 2.7,
//! Figs. 6 to 12.

mod closed_forms;
mod documented;
mod energy_decaying;
mod generalized_alpha;
mod golden;
mod orders;
mod region;
mod second_order;

use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::spectrum::{Probe, Spectrum};

const NEWMARK: SchemeKind = alpha(0.0, 0.0);

const fn alpha(alpha_m: f64, alpha_f: f64) -> SchemeKind {
    SchemeKind::NewmarkAlpha { alpha_m, alpha_f }
}

const fn optimal(rho_inf: f64) -> SchemeKind {
    SchemeKind::GeneralizedAlpha { rho_inf }
}

const fn decaying(rho_inf: f64, alpha_ar: f64) -> SchemeKind {
    SchemeKind::EdAlpha { rho_inf, alpha_ar }
}

/// The usual ED-alpha.
const fn ed(rho_inf: f64) -> SchemeKind {
    decaying(rho_inf, 1.0 / 6.0)
}

/// `count` values of `dt / T` from 10^`from` to 10^`to`.
fn sweep(from: f64, to: f64, count: u32) -> Vec<f64> {
    let step = (to - from) / f64::from(count - 1);
    (0..count)
        .map(|i| 10f64.powf(from + step * f64::from(i)))
        .collect()
}

/// The range of the figures: `dt / T` from 1e-2 to 1e2, and two decades more.
fn wide() -> Vec<f64> {
    sweep(-2.0, 4.0, 241)
}

fn spectra(scheme: SchemeKind, ratios: &[f64]) -> Vec<Spectrum> {
    let mut probe = Probe::new(scheme).unwrap();
    let found = ratios.iter().map(|&ratio| probe.spectrum(ratio));
    found
        .collect::<Result<_, _>>()
        .unwrap_or_else(|error| panic!("{scheme:?}: {error}"))
}

fn radii(scheme: SchemeKind, ratios: &[f64]) -> Vec<f64> {
    let found = spectra(scheme, ratios);
    found.iter().map(|spectrum| spectrum.radius).collect()
}

fn radius(scheme: SchemeKind, ratio: f64) -> f64 {
    radii(scheme, &[ratio])[0]
}

fn period_error(scheme: SchemeKind, ratio: f64) -> f64 {
    spectra(scheme, &[ratio])[0].period_error().unwrap()
}

fn damping_ratio(scheme: SchemeKind, ratio: f64) -> f64 {
    spectra(scheme, &[ratio])[0].damping_ratio().unwrap()
}

/// By how much a curve rises again above what it has fallen to: 0 without a cusp.
fn rise(radii: &[f64]) -> f64 {
    let mut least = f64::INFINITY;
    let mut rise = 0.0_f64;
    for &radius in radii {
        least = least.min(radius);
        rise = rise.max(radius - least);
    }
    rise
}

/// Above this, a rise is more than rounding.
const NO_RISE: f64 = 1e-6;
