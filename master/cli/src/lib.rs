//! The command line tool `linchpin`: runs scenes, studies them, serves the built-in models.
//!
//! * [`command_line`]: the arguments of the program;
//! * [`certificates`]: an authority, and what it certifies for one scene;
//! * [`conformance`]: whether a worker does what the contract and mechanics ask of it;
//! * [`connect`]: workers of a scene, in processes of their own or in this one;
//! * [`simulate`]: one run;
//! * [`results`]: what a run leaves behind, and what is read back of it;
//! * [`comparison`]: two runs compared;
//! * [`closed_form`]: the exact solution of scenes that have one;
//! * [`error_norm`]: errors of a run;
//! * [`export`]: results for other programs;
//! * [`files`]: tables and texts;
//! * [`graph`]: what a scene couples, as a picture;
//! * [`output`]: the folder that a command writes to, and how `run.json` says that it stands;
//! * [`study`]: many runs of one scene with other settings;
//! * [`spectra`]: stability, damping and period errors of integration schemes;
//! * [`interrupt`]: signals as requests to stop;
//! * [`log`]: what is logged to the error output;
//! * [`version`]: what this build is;
//! * [`plot`]: the pictures of runs and studies;
//! * [`animation`]: the moving mechanism as a page of its own.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod animation;
pub mod certificates;
pub mod closed_form;
pub mod command_line;
pub mod commands;
pub mod comparison;
pub mod conformance;
pub mod connect;
pub mod diagnostics;
pub mod error_norm;
pub mod export;
pub mod files;
pub mod graph;
mod html;
pub mod interrupt;
pub mod log;
pub mod output;
pub mod plot;
mod progress;
pub mod results;
pub mod simulate;
pub mod spectra;
mod story;
pub mod study;
pub mod version;
