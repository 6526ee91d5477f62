//! Coupling variables over macro time.
//!
//! * [`history`]: their values at past macro points and the polynomials through them;
//! * [`curves`]: the curves of all variables over a step;
//! * [`attitude`]: the orientation of a body as a coupling variable.

pub mod attitude;
pub mod curves;
pub mod history;

pub use curves::{Curves, Lagrange};
pub use history::{Curve, History, MAX_DEGREE, Variables, combine, vector_at};
