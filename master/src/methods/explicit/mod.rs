//! The explicit index-1 method of Gu & Asada, for comparison.
//!
//! * `scene`: its parameters;
//! * `coupling`: the method in a macro step.

mod coupling;
mod scene;

pub use scene::Explicit;
