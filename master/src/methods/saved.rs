//! What a method remembers at a macro point, as bytes.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// The state of a method, of which only the method itself knows what it is. Numbers are kept bit by bit.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Saved(Vec<u8>);

/// A state that its reader cannot read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the state of the coupling method belongs to another method or another version of Linchpin"
)]
pub struct Unreadable;

impl Saved {
    /// Writes a state; a state that cannot be written is empty, and cannot be read.
    pub fn of(state: &impl Serialize) -> Self {
        Self(postcard::to_stdvec(state).unwrap_or_default())
    }

    /// Reads it back.
    ///
    /// # Errors
    /// It is no state of this type.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, Unreadable> {
        match postcard::take_from_bytes(&self.0) {
            Ok((state, [])) => Ok(state),
            _ => Err(Unreadable),
        }
    }
}
