//! The co-simulation master: couples workers by algebraic constraints over a macro-time grid.
//!
//! One macro step, in the order in which its parts run; every part has a folder:
//!
//! * [`scene`]: what the user wrote, checked and resolved;
//! * [`connection`]: workers, in this process or behind gRPC, and starting them;
//! * [`time`]: the macro-time grid;
//! * [`signal`]: the polynomials of the coupling variables;
//! * [`joint`]: coupling conditions and loads of each kind of joint;
//! * [`coupling`]: conditions and Jacobian of the whole scene, and the coupling methods;
//! * [`cosimulation`]: the macro step itself, from start to end;
//! * [`results`]: rows, residuals, verdicts, statistics;
//! * [`interrupt`]: stopping a run from outside;
//! * [`probe`]: the matrix of the macro-step map of a linear scene.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod connection;
pub mod cosimulation;
pub mod coupling;
pub mod error;
pub mod interrupt;
pub mod joint;
pub mod layout;
pub mod probe;
pub mod results;
pub mod scene;
pub mod signal;
pub mod system;
pub mod time;
pub mod workers;

pub use cosimulation::CoSimulation;
pub use error::RunError;
pub use interrupt::Interrupt;
