//! The sub-commands, one file each: its arguments and what it does.

pub mod assignment;
pub mod certificates;
pub mod check;
pub mod common;
pub mod completions;
pub mod conformance;
pub mod converge;
pub mod describe;
pub mod description;
pub mod diff;
pub mod error;
pub mod export;
pub mod graph;
pub mod health;
pub mod init;
pub mod instances;
pub mod man;
pub mod models;
pub mod plot;
pub mod report;
pub mod run;
pub mod sharing;
mod slurm;
pub mod spectrum;
pub mod stability;
pub mod worker;

pub use error::CommandError;
