//! FMUs for co-simulation, FMI 2.0 and 3.0, behind [`linchpin_worker::Model`].
//!
//! * [`description`]: what an FMU says about itself;
//! * [`archive`]: unpacking it;
//! * [`library`]: its functions, the only code of the workspace that calls into foreign libraries;
//! * [`markers`]: which of its variables belong to a marker, as a scene says;
//! * [`model`]: the FMU as a model;
//! * [`pieces`]: inputs of a high degree for FMUs that take low ones;
//! * [`subsystem`]: one instance as a subsystem.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod archive;
pub mod description;
mod error;
pub mod library;
pub mod markers;
pub mod model;
mod names;
mod parameters;
pub mod pieces;
pub mod subsystem;

pub use error::FmuError;
pub use model::Fmu;
