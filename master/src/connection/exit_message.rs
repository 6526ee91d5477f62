//! What a worker process left behind when it failed.

use std::fmt;
use std::os::unix::process::ExitStatusExt;
use std::process::ExitStatus;

/// How a worker process ended and what it said before.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ExitMessage {
    /// How it ended; absent if it runs, or if the master did not start it.
    pub status: Option<ExitStatus>,
    /// Last lines of its error output; empty if there are none.
    pub error_output: String,
}

impl ExitMessage {
    /// Whether a signal has ended it, which is no decision of its own.
    pub fn is_killed(&self) -> bool {
        self.status.is_some_and(|status| status.signal().is_some())
    }
}

/// To be put behind an error message.
impl fmt::Display for ExitMessage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(status) = &self.status {
            write!(f, "; its process has ended ({status})")?;
        }
        if self.error_output.is_empty() {
            return Ok(());
        }
        f.write_str("\n  last error output of the worker:")?;
        self.error_output
            .lines()
            .try_for_each(|line| write!(f, "\n    {line}"))
    }
}
