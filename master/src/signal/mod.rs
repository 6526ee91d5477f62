//! Coupling variables over macro time.
//!
//! * `degree`: degrees of polynomials;
//! * `held`: values at one instant;
//! * [`history`]: their values at past macro points and the polynomials through them;
//! * [`curves`]: the curves of all variables over a step;
//! * [`share`]: polynomials of the share of a step;
//! * [`interpolation_error`]: what a corrected value tells about the error of a polynomial;
//! * `nodes`: on what past a curve depends;
//! * [`attitude`]: the orientation of a body as a coupling variable.

pub mod attitude;
pub mod curves;
mod degree;
mod held;
pub mod history;
pub mod interpolation_error;
mod nodes;
pub mod share;

pub use curves::{Curves, Lagrange};
pub(crate) use degree::AUTOMATIC_DEGREE;
pub use degree::Degree;
pub use held::Held;
pub use history::{Curve, History, MAX_DEGREE, Variables, combine, vector_at};
pub use interpolation_error::ErrorShares;
pub use nodes::Nodes;
pub use share::SharePolynomial;
