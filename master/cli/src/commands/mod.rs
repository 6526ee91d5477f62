//! The sub-commands, one file each: its arguments and what it does.

pub mod check;
pub mod common;
pub mod conformance;
pub mod converge;
pub mod describe;
pub mod error;
pub mod instances;
pub mod plot;
pub mod report;
pub mod run;
pub mod spectrum;
pub mod stability;
pub mod worker;

pub use error::CommandError;
