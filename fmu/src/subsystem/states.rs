//! States of an FMU that snapshots hold.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::library::{CallFailure, State};

/// States inside the FMU that nobody needs any more.
#[derive(Debug, Default)]
pub(super) struct States {
    pub unneeded: Mutex<Vec<State>>,
    /// All that the instance has made, to be freed with it.
    pub made: Mutex<Vec<State>>,
}

/// A handle in a snapshot.
#[derive(Debug)]
pub(super) enum Kept {
    State(State, Arc<States>),
    /// It could not be kept, and why.
    Failed(CallFailure),
}

impl Drop for Kept {
    fn drop(&mut self) {
        if let Self::State(state, states) = self {
            locked(&states.unneeded).push(*state);
        }
    }
}

/// The content of a mutex; a call that panicked leaves it whole.
pub(super) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
