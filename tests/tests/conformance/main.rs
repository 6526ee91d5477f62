//! The conformance kit: sound workers are not accused, planted faults are found.

#![allow(clippy::unwrap_used)]

mod exported;
mod faults;
mod low_order;
mod planted;
mod program;
mod serve;
mod shipped;
mod sound;
mod subjects;
