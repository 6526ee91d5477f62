//! How much a server does for its callers.

use tokio::runtime::{Builder, Runtime};

use super::solvers::OTHER_THREADS;

/// What a server allows its callers, all together or on one connection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capacity {
    /// Most calls that compute at a time.
    pub threads: usize,
    /// Most calls that wait until another one has computed; those beyond are refused.
    pub waiting: usize,
    /// Largest message, in bytes, that is accepted or sent.
    pub message: usize,
    /// Most calls and streams that are open on one connection at a time; those beyond wait at the caller.
    pub calls: u32,
}

impl Default for Capacity {
    fn default() -> Self {
        Self {
            threads: 1,
            waiting: 1024,
            message: 16 << 20,
            calls: 128,
        }
    }
}

/// A runtime for a server on which `threads` calls compute at a time, while others answer what needs no solver. On a smaller one a server
/// works as well, but every call to a solver takes some microseconds more.
///
/// # Errors
/// Those of the system.
pub fn runtime(threads: usize) -> std::io::Result<Runtime> {
    Builder::new_multi_thread()
        .worker_threads(threads + OTHER_THREADS)
        .thread_name("linchpin-worker")
        .enable_all()
        .build()
}
