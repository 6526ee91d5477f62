//! The sub-commands, one file each: its arguments and what it does.

pub mod check;
pub mod common;
pub mod describe;
pub mod error;
pub mod run;
pub mod worker;

pub use error::CommandError;
