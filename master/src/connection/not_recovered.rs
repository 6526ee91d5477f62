//! Why a lost worker could not be replaced.

use std::io;

use linchpin_proto::contract::CallError;

use super::start_error::StartError;

/// Why no other worker could take the place of a lost one.
#[derive(Debug, thiserror::Error)]
pub enum NotRecovered {
    /// It could not be made.
    #[error(transparent)]
    Start(#[from] StartError),
    /// It failed before it came to the present macro point, or was lost as well.
    #[error("{0}")]
    Call(#[from] CallError),
    /// The inputs of the steps to be repeated cannot be read.
    #[error(
        "the inputs of the macro steps to be repeated cannot be read back from the temporary file (TMPDIR): {0}"
    )]
    Journal(#[from] io::Error),
    /// The same steps had other results.
    #[error(
        "repeating its macro steps it came to {variable} = {found} instead of {expected}: a worker must give the same bits for the same \
         inputs, or export its states"
    )]
    OtherBits {
        /// Output of the model.
        variable: String,
        /// That of the new worker.
        found: f64,
        /// That of the lost one.
        expected: f64,
    },
}
