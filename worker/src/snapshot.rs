//! The state of a subsystem: a row of bytes, or a handle to a state that stays inside the solver.

use std::any::Any;
use std::sync::Arc;

use crate::StepFailure;

/// A state that was written by [`Subsystem::snapshot`](crate::Subsystem::snapshot).
///
/// Numbers are kept bit by bit. Being plain bytes, a snapshot can leave the process; one with a handle can if
/// [`Subsystem::export`](crate::Subsystem::export) makes bytes of it.
#[derive(Debug, Clone, Default)]
pub struct Snapshot {
    bytes: Vec<u8>,
    handle: Option<Arc<dyn Any + Send + Sync>>,
}

/// Equal bytes, and the same handle or none.
impl PartialEq for Snapshot {
    fn eq(&self, other: &Self) -> bool {
        let is_same_handle = match (&self.handle, &other.handle) {
            (None, None) => true,
            (Some(own), Some(other)) => Arc::ptr_eq(own, other),
            _ => false,
        };
        is_same_handle && self.bytes == other.bytes
    }
}

impl Eq for Snapshot {}

impl Snapshot {
    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// A snapshot of bytes that were kept elsewhere.
    pub fn from_bytes(bytes: Vec<u8>) -> Self {
        Self {
            bytes,
            handle: None,
        }
    }

    /// Empties it; its memory is kept.
    pub fn clear(&mut self) {
        self.bytes.clear();
        self.handle = None;
    }

    /// Takes over another one, in memory that is already there.
    pub fn copy_from(&mut self, other: &Self) {
        self.bytes.clone_from(&other.bytes);
        self.handle.clone_from(&other.handle);
    }

    /// Keeps a handle to a state that stays inside the solver. It is dropped when no snapshot has it any more: then the solver may
    /// forget that state.
    pub fn put_handle(&mut self, handle: Arc<dyn Any + Send + Sync>) {
        self.handle = Some(handle);
    }

    /// The handle, if there is one of this type.
    pub fn handle<T: 'static>(&self) -> Option<&T> {
        self.handle.as_deref()?.downcast_ref()
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
