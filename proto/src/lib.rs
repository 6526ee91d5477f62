//! The contract `linchpin.v1` between master and worker, and what its messages mean.
//!
//! * [`certificates`]: by which masters and workers know each other;
//! * [`v1`]: the messages and the gRPC client and server, generated from `proto/linchpin/v1/worker.proto`;
//! * [`contract`]: the same calls as a plain Rust trait, for peers in one process;
//! * [`exported`]: states that have left their process;
//! * [`foreign`]: texts of a peer, made fit to be shown;
//! * [`exchange`]: what the parts of an exchange must keep to;
//! * [`joint_load`]: the conditions of joints and the loads that they put on markers;
//! * [`label`]: which request a reply belongs to;
//! * [`polynomial`]: the Lagrange polynomial that a [`v1::Signal`] stands for;
//! * [`readable`]: numbers in messages;
//! * [`status`]: failures as gRPC statuses;
//! * [`token`]: a secret between processes of one machine;
//! * [`version`]: which protocol versions understand each other.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod certificates;
pub mod contract;
pub mod exchange;
pub mod exported;
pub mod foreign;
pub mod joint_load;
pub mod label;
pub mod polynomial;
pub mod readable;
pub mod status;
pub mod token;
pub mod version;
pub mod weights;

/// Generated messages, client and server of the package `linchpin.v1`.
#[allow(
    missing_docs,
    clippy::all,
    reason = "generated; its documentation stands in the .proto file"
)]
pub mod v1 {
    tonic::include_proto!("linchpin.v1");

    /// The compiled description of the contract, for gRPC reflection.
    pub const FILE_DESCRIPTOR_SET: &[u8] =
        include_bytes!(concat!(env!("OUT_DIR"), "/linchpin_v1.bin"));
}
