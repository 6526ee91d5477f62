//! Helpers of the integration tests: scenes, runs inside this process, errors, orders of convergence.
//!
//! A helper that cannot do its work panics: that is how a test fails.

#![allow(clippy::unwrap_used)]

pub mod chain;
pub mod convergence;
pub mod errors;
pub mod evidence;
pub mod fmus;
pub mod golden;
pub mod hinges;
pub mod in_space;
pub mod masses;
pub mod position_pair;
pub mod process;
pub mod python;
pub mod random_pairs;
pub mod reference;
pub mod runs;
pub mod scenes;
pub mod scripted;
pub mod spring_pair;
pub mod tampering;
pub mod tasks;
pub mod traces;
pub mod tuning;
