//! Spectral properties of the schemes: what one step makes of a free vibration (S2 Sect. 2.4.1, 2.6.1, 2.7,
//! Appendices A, B).
//!
//! ```text
//! q'' + omega^2 q = 0,   X_{i+1} = A(Omega) X_i,   Omega = omega dt = 2 pi dt / T          (93 to 95)
//! rho = max |lambda_k|                                                                      (99)
//! ```
//!
//! The amplification matrix `A` is not written down but found by [`Probe`]: a scheme takes a step from every unit
//! state, as it does in a simulation. The eigenvalues that continue `exp(+-j Omega)` of the exact solution are the
//! principal roots; they give period and damping of the numerical vibration.
//!
//! * [`amplification`]: the matrix and how it is found; [`roots`]: its eigenvalues;
//! * [`oscillator`]: the vibrating mass;
//! * [`region`]: generalised-alpha over its two parameters, also where it is unstable.

pub mod amplification;
pub mod oscillator;
pub mod region;
pub mod roots;

use nalgebra::Complex;

use super::mechanics::StepError;
use super::schemes::{SchemeError, SchemeKind};

pub use amplification::{Amplification, Probe, Variable};
pub use oscillator::Oscillator;
pub use region::{Growth, growth};

/// What one step of a scheme does to a free vibration of period `T`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spectrum {
    /// Step over period, `dt / T`.
    pub dt_over_period: f64,
    /// Spectral radius `rho` (S2 eq. 99); the exact solution has 1.
    pub radius: f64,
    /// Principal root with positive imaginary part; `None` where the scheme does not vibrate, as explicit ones
    /// beyond their limit of stability.
    pub principal: Option<Complex<f64>>,
}

/// Why a scheme has no spectrum.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SpectrumError {
    /// Parameters out of range.
    #[error(transparent)]
    Scheme(#[from] SchemeError),
    /// The probing step failed.
    #[error("the step with dt / T = {dt_over_period:e} that probes the scheme failed: {source}")]
    Step {
        /// Step over period.
        dt_over_period: f64,
        /// Why.
        source: StepError,
    },
    /// Step over period out of range.
    #[error("dt / T = {0:e} is out of range: it must be greater than 0 and at most 1e9")]
    StepOverPeriod(f64),
    /// The eigenvalues were not found.
    #[error(
        "the eigenvalues of the amplification matrix for dt / T = {0:e} were not found; another dt / T helps"
    )]
    NoEigenvalues(f64),
}

impl Spectrum {
    /// Modulus of the principal roots.
    pub fn principal_modulus(&self) -> Option<f64> {
        self.principal.map(|root| root.re.hypot(root.im))
    }

    /// Relative period error `(T_num - T) / T = Omega / arg(lambda) - 1`; positive where the period is elongated.
    pub fn period_error(&self) -> Option<f64> {
        let omega_dt = std::f64::consts::TAU * self.dt_over_period;
        self.angle().map(|angle| (omega_dt - angle) / angle)
    }

    /// Numerical damping ratio `xi = -ln |lambda| / arg(lambda)`, for `lambda = exp((-xi + j) arg(lambda))`.
    pub fn damping_ratio(&self) -> Option<f64> {
        Some(-self.principal_modulus()?.ln() / self.angle()?)
    }

    /// Angle of the principal root (rad), between 0 and pi.
    fn angle(&self) -> Option<f64> {
        self.principal.map(|root| root.im.atan2(root.re))
    }
}

/// Spectrum of a scheme for one step over period.
///
/// # Errors
/// [`SpectrumError`].
pub fn spectrum(scheme: SchemeKind, dt_over_period: f64) -> Result<Spectrum, SpectrumError> {
    Probe::new(scheme)?.spectrum(dt_over_period)
}

/// Spectra of a scheme over a list of steps over period.
///
/// # Errors
/// [`SpectrumError`] of the first that fails.
pub fn spectra(scheme: SchemeKind, sweep: &[f64]) -> Result<Vec<Spectrum>, SpectrumError> {
    let mut probe = Probe::new(scheme)?;
    sweep.iter().map(|&ratio| probe.spectrum(ratio)).collect()
}
