//! Force/force coupling by penalty spring-dampers, for comparison.
//!
//! * `scene`, `spring`: its parameters;
//! * `coupling`: the method in a macro step.

mod coupling;
mod scene;
mod spring;

pub use scene::Penalty;
pub use spring::Spring;
