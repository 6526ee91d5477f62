//! The library of a scene that is exported as an FMU: the C functions of FMI 2.0 for co-simulation around a run of the scene.
//!
//! * [`component`]: the run, and what an importer may do with it;
//! * [`fmi2`]: the functions.

pub mod component;
pub mod fmi2;
