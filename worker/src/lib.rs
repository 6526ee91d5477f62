//! SDK: makes a Linchpin worker of one solver.
//!
//! A solver author implements [`Subsystem`] (step, outputs, snapshot, restore) and [`Model`] (describe,
//! initialize). [`Host`] gives the contract `linchpin.v1` around it: instances, sequence numbers, snapshots, the
//! fused exchange. [`server`] serves a host over gRPC, on TCP or a Unix socket.
//!
//! * [`subsystem`], [`cancel`], [`inputs`], [`snapshot`], [`joint_load`], [`impact`]: what a solver sees;
//! * [`host`], [`instance`]: what the contract sees;
//! * [`server`]: the gRPC service, health, reflection, shutdown.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod cancel;
pub mod host;
pub mod impact;
pub mod inputs;
pub mod instance;
pub mod joint_load;
pub mod server;
pub mod setup;
pub mod snapshot;
mod span;
pub mod subsystem;

pub use cancel::Cancel;
pub use host::Host;
pub use impact::{Impact, Impacts, Interface};
pub use inputs::Inputs;
pub use joint_load::JointLoad;
pub use setup::Setup;
pub use snapshot::Snapshot;
pub use subsystem::{Interval, Model, StepFailure, Subsystem};

/// The examples of the guide are compiled.
#[cfg(doctest)]
#[doc = include_str!("../../docs/guide/own-worker.md")]
pub struct Guide;
