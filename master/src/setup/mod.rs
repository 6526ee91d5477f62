//! From a scene and the descriptions of its workers to a run at its first macro point.

mod consistency;
mod consistent;
mod degrees;
mod discover;
mod fitting;
mod forward_only;
mod geometry;
mod impacts;
mod initial;
mod inside;
mod instances;
mod options;
mod panels;
mod partial;
mod redundancy;
mod refusal;
mod responses;
mod settle;
mod signal_loop;
mod start;
mod steps;
mod velocities;

pub use discover::multiplier_columns;
pub use options::{Connect, Options};
pub use partial::check_some;
pub use start::describe;
