//! Coupling variables over macro time.
//!
//! * [`history`]: their values at past macro points and the polynomials through them;
//! * [`curves`]: the curves of all variables over a step;
//! * [`share`]: polynomials of the share of a step;
//! * [`interpolation_error`]: what a corrected value tells about the error of a polynomial;
//! * [`attitude`]: the orientation of a body as a coupling variable.

pub mod attitude;
pub mod curves;
pub mod history;
pub mod interpolation_error;
pub mod share;

pub use curves::{Curves, Lagrange};
pub use history::{Curve, History, MAX_DEGREE, Variables, combine, vector_at};
pub use interpolation_error::ErrorShares;
pub use share::SharePolynomial;
