//! The workers of a run: the only writer of requests to them, in memory that is kept, and the only reader of their answers.
//!
//! * `subsystem`: one worker, its request, and its answer, checked;
//! * `all`: all of them;
//! * `look`: what a look-ahead is asked for;
//! * `requests`: what the next requests to all of them ask for;
//! * `views`: what they have answered, as values;
//! * `exchange`: all requests out, all answers in;
//! * `impacts`: what requests and answers say of impacts;
//! * `samples`: results at fixed times inside a macro step;
//! * `varying`: exchanges after which a shorter macro step may follow;
//! * `substeps`: an advance that a worker cannot take at once.

mod all;
mod exchange;
mod impacts;
mod look;
mod requests;
mod samples;
mod substeps;
mod subsystem;
mod varying;
mod views;

pub use all::Workers;
pub(crate) use look::Look;
pub(crate) use samples::Samples;
pub use subsystem::{Ahead, RecoverySettings, Subsystem};
