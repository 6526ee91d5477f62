//! The state of a subsystem as a row of bytes.

use crate::StepFailure;

/// A state that was written by [`Subsystem::snapshot`](crate::Subsystem::snapshot).
///
/// Numbers are kept bit by bit. Being plain bytes, a snapshot can leave the process.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Snapshot {
    bytes: Vec<u8>,
}

impl Snapshot {
    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// A snapshot of bytes that were kept elsewhere.
    pub fn from_bytes(bytes: Vec<u8>) -> Self {
        Self { bytes }
    }

    /// Empties it; its memory is kept.
    pub fn clear(&mut self) {
        self.bytes.clear();
    }

    /// Appends bytes.
    pub fn put_bytes(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// Appends numbers.
    pub fn put(&mut self, numbers: &[f64]) {
        for number in numbers {
            self.bytes.extend_from_slice(&number.to_le_bytes());
        }
    }

    /// Reads exactly as many numbers as `numbers` has room for.
    ///
    /// # Errors
    /// A fatal [`StepFailure`] if the snapshot has another length.
    pub fn get(&self, numbers: &mut [f64]) -> Result<(), StepFailure> {
        let expected = size_of_val(numbers);
        if self.bytes.len() != expected {
            return Err(StepFailure::Fatal {
                message: format!(
                    "the snapshot has {} bytes, this subsystem needs {expected}",
                    self.bytes.len()
                ),
            });
        }
        let (chunks, _) = self.bytes.as_chunks();
        for (number, chunk) in numbers.iter_mut().zip(chunks) {
            *number = f64::from_le_bytes(*chunk);
        }
        Ok(())
    }
}
