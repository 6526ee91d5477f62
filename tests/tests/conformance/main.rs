//! The conformance kit: sound workers are not accused, planted faults are found.

#![allow(clippy::unwrap_used)]

mod faults;
mod planted;
mod shipped;
mod sound;
mod subjects;
