//! Models under joint loads, whose partners move as prescribed.

#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;

mod bodies;
mod closed_forms;
mod energy;
mod equivalent_loads;
mod joint;
mod run;
mod stiff;
