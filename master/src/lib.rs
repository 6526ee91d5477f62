//! The co-simulation master: couples workers by algebraic constraints over a macro-time grid.
//!
//! Every part has a folder or file; each takes what it needs from those before it only:
//!
//! * [`interrupt`]: stopping a run from outside;
//! * [`time`]: the macro-time grid;
//! * [`signal`]: the polynomials of the coupling variables;
//! * [`joint`]: coupling conditions and loads of each kind of joint;
//! * [`reading`]: what the user wrote, with places;
//! * [`connection`]: workers, in this process or behind gRPC, and starting them;
//! * [`layout`]: which outputs the joints read, which are exchanged, and which inputs are driven;
//! * [`system`]: conditions and Jacobian of the whole scene;
//! * [`results`]: rows, residuals, verdicts, statistics;
//! * [`accuracy`]: how large the error of a macro step is, and how large it may be;
//! * [`methods`]: the coupling methods;
//! * [`policies`]: what decides about a macro step;
//! * [`error`]: what ends a run;
//! * [`workers`]: requests to the workers and their answers;
//! * [`scene`]: what is coupled, how, and for how long, checked and resolved;
//! * [`macro_step`]: one macro step, top to bottom;
//! * [`run`]: the loop around it, and what a run is at a macro point;
//! * [`setup`]: from a scene to a run at its first macro point;
//! * [`probe`]: the matrix of the macro-step map of a linear scene.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod accuracy;
pub mod connection;
pub mod error;
pub mod interrupt;
pub mod joint;
pub mod layout;
pub mod macro_step;
pub mod methods;
pub mod policies;
pub mod probe;
pub mod reading;
pub mod results;
pub mod run;
pub mod scene;
pub mod setup;
pub mod signal;
pub mod system;
pub mod time;
pub mod workers;

pub use error::RunError;
pub use interrupt::Interrupt;
pub use run::CoSimulation;
