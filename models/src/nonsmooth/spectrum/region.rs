//! Generalised-alpha over its parameters `alpha_m` and `alpha_f`: where it is stable (S2 Fig. 6).
//!
//! With `gamma` (98) and `beta` (102), the region of unconditional stability is `alpha_m <= alpha_f <= 1/2` (100),
//! and for infinite frequency
//!
//! ```text
//! lambda_{1,2} = (alpha_f - alpha_m - 1) / (alpha_f - alpha_m + 1)     (103)
//! lambda_3 = alpha_f / (alpha_f - 1)                                   (101)
//! ```
//!
//! Their moduli are equal on the line `alpha_f = (alpha_m + 1) / 3`, which is that of the optimal parameters (104).

use super::{Probe, SpectrumError};
use crate::nonsmooth::mechanics::Mechanics;
use crate::nonsmooth::schemes::{GeneralizedAlpha, Scheme};

/// Step over period that counts as infinite: there, `Omega` = 6e4, radii are within 1e-3 of their limit.
pub const INFINITE: f64 = 1e4;

/// Steps over period at which the radius is found, four in a decade.
const FIRST: f64 = 1e-2;
const SAMPLES: u32 = 25;

/// A radius up to `1 + ROUNDING` counts as 1: where eigenvalues coincide, rounding moves them by as much.
const ROUNDING: f64 = 1e-6;

/// How vibrations of all frequencies grow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// Largest spectral radius over all frequencies.
    pub largest: f64,
    /// Spectral radius for `dt / T` = [`INFINITE`].
    pub at_infinity: f64,
}

impl Growth {
    /// Where a step has no solution.
    pub const UNBOUNDED: Self = Self {
        largest: f64::INFINITY,
        at_infinity: f64::INFINITY,
    };

    /// Whether no frequency grows.
    pub fn is_stable(&self) -> bool {
        self.largest <= 1.0 + ROUNDING
    }
}

/// A probe of generalised-alpha with any parameters, also those that [`GeneralizedAlpha::new`] refuses.
pub fn unrestricted_probe(alpha_m: f64, alpha_f: f64) -> Probe {
    let build = |mechanics: &Mechanics| -> Result<Box<dyn Scheme>, std::convert::Infallible> {
        let scheme = GeneralizedAlpha::unrestricted(alpha_m, alpha_f, mechanics);
        Ok(Box::new(scheme))
    };
    match Probe::with(build) {
        Ok(probe) => probe,
        Err(never) => match never {},
    }
}

/// Growth of vibrations under generalised-alpha with any parameters.
pub fn growth(alpha_m: f64, alpha_f: f64) -> Growth {
    let mut probe = unrestricted_probe(alpha_m, alpha_f);
    let decades = (INFINITE / FIRST).log10();
    let sample = |i: u32| FIRST * 10f64.powf(decades * f64::from(i) / f64::from(SAMPLES - 1));
    let radii = (0..SAMPLES).map(|i| Ok(probe.spectrum(sample(i))?.radius));
    match radii.collect::<Result<Vec<f64>, SpectrumError>>() {
        Ok(radii) => Growth {
            largest: radii.iter().copied().fold(0.0, f64::max),
            at_infinity: radii.last().copied().unwrap_or(f64::INFINITY),
        },
        Err(_) => Growth::UNBOUNDED,
    }
}
