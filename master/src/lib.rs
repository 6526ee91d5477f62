//! The co-simulation master: couples workers by algebraic constraints over a macro-time grid.
//!
//! Every part has a folder or file; each takes what it needs from those before it only:
//!
//! * [`interrupt`]: stopping a run from outside;
//! * [`time`]: the macro-time grid;
//! * [`signal`]: the polynomials of the coupling variables;
//! * [`joint`]: coupling conditions and loads of each kind of joint;
//! * [`scene`]: what the user wrote, checked and resolved;
//! * [`connection`]: workers, in this process or behind gRPC, and starting them;
//! * [`error`]: what ends a run;
//! * [`layout`]: which outputs the joints read, which are exchanged, and which inputs are driven;
//! * [`system`]: conditions and Jacobian of the whole scene;
//! * [`results`]: rows, residuals, verdicts, statistics;
//! * [`workers`]: requests to the workers and their answers;
//! * [`coupling`]: the coupling methods;
//! * [`cosimulation`]: a run and its macro steps, from start to end;
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
