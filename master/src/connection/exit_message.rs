//! What a worker process left behind when it failed.

use std::fmt;
use std::os::unix::process::ExitStatusExt;
use std::path::PathBuf;
use std::process::ExitStatus;

/// How a worker process ended and what it said before.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ExitMessage {
    /// How it ended; absent if it runs, or if the master did not start it.
    pub status: Option<ExitStatus>,
    /// What it has printed; absent if that is nothing.
    pub printed: Option<Box<Printed>>,
}

/// What a worker process has printed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Printed {
    /// The last lines.
    pub last: String,
    /// The file with all of it, if there is one.
    pub log: Option<PathBuf>,
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
        let Some(printed) = &self.printed else {
            return Ok(());
        };
        f.write_str("\n  last output of the worker")?;
        if let Some(log) = &printed.log {
            write!(f, " (all of it: {})", log.display())?;
        }
        f.write_str(":")?;
        let mut lines = printed.last.lines();
        lines.try_for_each(|line| write!(f, "\n    {line}"))
    }
}
