//! The workers of a run: requests to them, in memory that is kept, and the reading of their answers.
//!
//! * `subsystem`: one worker, its request, and its answer, checked;
//! * `parts`: all of them with the layout of the coupling: what the next requests ask for;
//! * `exchange`: all requests out, all answers in;
//! * `samples`: results at fixed times inside a macro step;
//! * `recovery`: exchanges after which a shorter macro step may follow;
//! * `pieces`: an advance that a worker cannot take at once.

mod exchange;
mod parts;
mod pieces;
pub(crate) mod recovery;
mod samples;
mod subsystem;

pub(crate) use exchange::exchange;
pub use parts::Parts;
pub(crate) use samples::Samples;
pub use subsystem::{Ahead, Subsystem};
