//! Variable macro steps on hard scenes: the tolerance is met, at less cost than with any fixed step, and rejected steps leave no
//! trace.

#![allow(clippy::unwrap_used, missing_docs)]

mod brittle;
mod degrees;
mod failures;
mod hard_scenes;
mod jump;
mod mechanisms;
mod mistakes;
mod traces;
