//! What a method remembers at a macro point, as bytes.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// The state of a method, of which only the method itself knows what it is. Numbers are kept bit by bit.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Saved {
    /// What the state is of.
    of: String,
    bytes: Vec<u8>,
}

/// A state that its reader cannot read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "it is one of the coupling method {found}, this run has {expected}; go on with the scene and the version of Linchpin that wrote it"
)]
pub struct Unreadable {
    /// What it is of.
    pub found: String,
    /// What it was to be of.
    pub expected: String,
}

impl Saved {
    /// Writes the state `of` a method; one that cannot be written is empty, and cannot be read.
    pub fn new(of: &str, state: &impl Serialize) -> Self {
        Self {
            of: of.to_owned(),
            bytes: postcard::to_stdvec(state).unwrap_or_default(),
        }
    }

    /// Compares whose states this one and another are.
    ///
    /// # Errors
    /// The other one is of another method.
    pub fn compare(&self, other: &Self) -> Result<(), Unreadable> {
        match self.of == other.of {
            true => Ok(()),
            false => Err(Unreadable {
                found: other.of.clone(),
                expected: self.of.clone(),
            }),
        }
    }

    /// Reads the state `of` a method back.
    ///
    /// # Errors
    /// It is one of another method, or of another version of this one.
    pub fn read<T: DeserializeOwned>(&self, of: &str) -> Result<T, Unreadable> {
        let read = postcard::take_from_bytes(&self.bytes).ok();
        let whole = read.filter(|(_, rest)| rest.is_empty() && self.of == of);
        whole.map(|(state, _)| state).ok_or_else(|| Unreadable {
            found: self.of.clone(),
            expected: of.to_owned(),
        })
    }
}
