//! Studies: many runs of one scene with other settings, in this process.
//!
//! * [`converge`]: errors, observed orders and cost over the macro step;
//! * [`stability`]: stable or not over two settings;
//! * [`report`]: scenes with many settings, and what their errors cost, on one page.
//!
//! What they share: the columns that are judged, what these are compared with, and the errors.

mod columns;
pub mod converge;
mod error;
mod errors;
mod found;
mod orders;
mod reference;
pub mod report;
mod run;
mod runs;
mod share;
pub mod stability;

pub use error::StudyError;
pub use found::{Found, Pieces};
pub use share::Share;
