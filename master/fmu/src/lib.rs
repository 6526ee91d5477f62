//! The library of a scene that is exported as an FMU: the C functions of FMI 2.0 and 3.0 for co-simulation around a run of the scene.
//!
//! * [`component`]: the run, and what an importer may do with it;
//! * [`instance`], [`states`]: what both versions have;
//! * [`fmi2`], [`fmi3`]: the functions of each.

#![allow(
    unsafe_code,
    non_snake_case,
    clippy::missing_safety_doc,
    reason = "functions of the C interface of FMI; the importer keeps to the standard"
)]

pub mod component;
pub mod fmi2;
pub mod fmi3;
pub mod instance;
pub mod states;
