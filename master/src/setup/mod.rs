//! From a scene and the descriptions of its workers to a run at its first macro point.

mod closed;
mod degrees;
mod geometry;
mod initial;
mod options;
mod panels;
mod refusal;
mod signal_loop;
mod start;
mod steps;
mod tie;
mod velocities;

pub use options::{Connect, Options};
pub use start::describe;
pub use tie::multiplier_columns;
