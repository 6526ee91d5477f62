//! The methods that solve for the multipliers, and what decides about their macro steps.
//!
//! * [`columns`]: increments, finite differences, and responses that stay in use;
//! * [`position_error`]: errors of positions by those of the multipliers;
//! * [`error_estimate`]: the error of a macro step against the tolerance;
//! * [`attempts`]: what several attempts at a step tell of variables without a past;
//! * [`degree_choice`], [`automatic_degrees`]: degrees of polynomials that follow the estimates;
//! * [`corrector`]: what a predictor/corrector method does in a macro step;
//! * [`uncorrected`]: what a method without a corrector does in a macro step;
//! * [`shortfall`]: what corrections with kept columns miss, foreseen;
//! * [`promise`]: what a correction promises, and what the workers make of it;
//! * [`semi_implicit`], [`hermite`], [`explicit`], [`penalty`]: one macro step of each family of methods.

pub mod attempts;
pub mod automatic_degrees;
pub mod columns;
pub mod condition;
pub mod corrector;
pub mod degree_choice;
pub mod error_estimate;
pub mod explicit;
pub mod hermite;
pub mod measure;
pub mod penalty;
pub mod position_error;
pub mod promise;
pub mod semi_implicit;
pub mod shortfall;
pub mod uncorrected;
