//! Coupling variables over macro time.
//!
//! * [`history`]: their values at past macro points and the polynomials through them;
//! * [`attitude`]: the orientation of a body as a coupling variable.

pub mod attitude;
pub mod history;

pub use history::{Curve, History, MAX_DEGREE, Variables, combine, vector_at};
