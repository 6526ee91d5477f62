//! Studies: many runs of one scene with other settings, in parallel and in this process.
//!
//! * [`converge`]: errors, observed orders and cost over the macro step;
//! * [`stability`]: stable or not over two settings;
//! * [`progress`]: the bar that shows how far a study is.

pub mod converge;
mod error;
pub mod progress;
mod runs;
pub mod stability;

pub use error::StudyError;
