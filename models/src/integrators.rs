//! Time integration of `y' = f(t, y)` for small dense systems.
//!
//! * [`rk4`]: explicit, fixed steps, order 4;
//! * [`radau`]: implicit, step-size control, order 5.
//!
//! Both give up between two steps if the call that they work for is [cancelled](linchpin_worker::Cancel).
//!
//! Times are relative to the start of the interval, so that nothing is lost late in a long run.

mod quadrature;
pub mod radau;
pub mod rk4;

use linchpin_proto::readable::number;
use linchpin_worker::Cancel;
use nalgebra::DMatrix;

pub use quadrature::{Quadrature, gauss};
pub use rk4::Rk4;

/// An ordinary differential equation `y' = f(tau, y)`; `tau` (s) runs from the start of the interval.
pub trait Ode {
    /// Writes `f(tau, y)` to `dy`.
    fn derivative(&self, tau: f64, y: &[f64], dy: &mut [f64]);

    /// Writes `df/dy` to `jacobian` and returns true. The default returns false: the integrator then takes
    /// differences of [`Ode::derivative`].
    fn jacobian(&self, _tau: f64, _y: &[f64], _jacobian: &mut DMatrix<f64>) -> bool {
        false
    }
}

/// Where and why an integration stopped.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{cause}")]
pub struct IntegrationError {
    /// Time since the start of the interval (s).
    pub tau: f64,
    /// Why.
    pub cause: Cause,
}

/// Why an integration stopped.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Cause {
    /// No step was short enough for the error tolerance.
    #[error(
        "the error of a step of {step} s is {error} times the tolerance, and it cannot be shorter",
        step = number(*step), error = number(*error)
    )]
    Inaccurate {
        /// The shortest step tried (s).
        step: f64,
        /// Its error over the tolerance.
        error: f64,
    },
    /// No step was short enough for Newton's method.
    #[error("Newton's method does not converge even in a step of {step} s", step = number(*step))]
    Diverged {
        /// The shortest step tried (s).
        step: f64,
    },
    /// The right-hand side or the state is infinite or not a number.
    #[error("the solution is not finite")]
    NotFinite,
    /// Nobody waits for the result any more.
    #[error("the integration was cancelled")]
    Cancelled,
    /// The interval takes more internal steps than allowed.
    #[error("{limit} internal steps did not reach the end of the interval")]
    TooManySteps {
        /// The limit.
        limit: usize,
    },
}

/// Gives up at `tau` (s) if the call under way is cancelled.
fn check(cancel: &Cancel, tau: f64) -> Result<(), IntegrationError> {
    match cancel.is_requested() {
        true => Err(IntegrationError {
            tau,
            cause: Cause::Cancelled,
        }),
        false => Ok(()),
    }
}
