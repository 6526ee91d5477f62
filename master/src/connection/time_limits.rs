//! How long a connection waits.

use std::time::Duration;

/// Time limits of a connection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeLimits {
    /// For a worker to start or to be reached.
    pub start: Duration,
    /// For one answer.
    pub answer: Duration,
}
