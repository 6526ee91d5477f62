//! Studies: many runs of one scene with other settings, in this process.
//!
//! * [`converge`]: errors, observed orders and cost over the macro step;
//! * [`stability`]: stable or not over two settings;
//! * [`report`]: scenes with many settings, and what their errors cost, on one page;
//! * [`progress`]: the bar that shows how far a study is.
//!
//! What they share: the columns that are judged, what these are compared with, and the errors.

mod columns;
pub mod converge;
mod error;
mod errors;
mod orders;
pub mod progress;
mod reference;
pub mod report;
mod runs;
pub mod stability;

pub use error::StudyError;
