//! From a scene and the descriptions of its workers to a run at its first macro point.

mod consistency;
mod degrees;
mod discover;
mod geometry;
mod initial;
mod inside;
mod options;
mod panels;
mod partial;
mod refusal;
mod signal_loop;
mod start;
mod steps;
mod velocities;

pub use discover::multiplier_columns;
pub use options::{Connect, Options};
pub use partial::check_some;
pub use start::describe;
