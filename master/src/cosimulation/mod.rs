//! A run from start to end.

mod closed;
mod contacts;
mod corrected;
mod degrees;
mod geometry;
mod initial;
mod mechanism;
mod obstacle;
mod options;
mod panels;
mod penalty;
mod refusal;
mod renewal;
mod run;
mod scheme;
mod signal_loop;
mod start;
mod step_size;
mod tie;
mod uncorrected;
mod velocities;

pub use contacts::RecordedContact;
pub use mechanism::{Mechanism, RecordedJoint, RecordedMarker};
pub use options::{Connect, Options};
pub use run::CoSimulation;
pub use start::describe;
pub use tie::multiplier_columns;
