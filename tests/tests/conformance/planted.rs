//! Faults that are planted in sound models: in the solver and in the protocol.

pub mod body;
pub mod protocol;
pub mod replies;
pub mod solver;
