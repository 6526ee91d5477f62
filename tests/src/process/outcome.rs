//! How a command ended, and what is demanded of that.

use std::fmt;
use std::path::PathBuf;
use std::time::Duration;

use super::running::AFTERMATH;
use super::{holds_within, leftovers};

/// What a command that has ended leaves for inspection. Every failed demand shows all of it.
#[derive(Debug, Clone)]
pub struct Outcome {
    pub(super) command: String,
    pub(super) folder: PathBuf,
    pub(super) code: Option<i32>,
    pub(super) signal: Option<i32>,
    /// Standard output.
    pub stdout: String,
    /// Error output.
    pub stderr: String,
    /// Time that the command took.
    pub time: Duration,
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "command: {}\nfolder:  {}",
            self.command,
            self.folder.display()
        )?;
        match (self.code, self.signal) {
            (Some(code), _) => writeln!(f, "exit code {code} after {:?}", self.time)?,
            (None, Some(signal)) => writeln!(f, "ended by signal {signal} after {:?}", self.time)?,
            (None, None) => writeln!(f, "still running after {:?}", self.time)?,
        }
        write!(
            f,
            "--- stdout\n{}\n--- stderr\n{}",
            self.stdout, self.stderr
        )
    }
}

impl Outcome {
    /// The exit code is `code`.
    #[track_caller]
    pub fn exits_with(&self, code: i32) -> &Self {
        assert_eq!(self.code, Some(code), "\n{self}");
        self
    }

    /// The command did what was asked.
    #[track_caller]
    pub fn succeeds(&self) -> &Self {
        self.exits_with(0).leaves_nothing()
    }

    /// A mistake is reported: the exit code, every one of `words` in the error output, no panic, and nothing left.
    #[track_caller]
    pub fn fails(&self, code: i32, words: &[&str]) -> &Self {
        self.exits_with(code).says(words).leaves_nothing();
        assert!(!self.stderr.contains("panicked"), "\n{self}");
        self
    }

    /// The error output contains every one of `words`.
    #[track_caller]
    pub fn says(&self, words: &[&str]) -> &Self {
        for word in words {
            assert!(
                self.stderr.contains(word),
                "no {word:?} in the error output\n{self}"
            );
        }
        self
    }

    /// The output contains every one of `words`.
    #[track_caller]
    pub fn prints(&self, words: &[&str]) -> &Self {
        for word in words {
            assert!(
                self.stdout.contains(word),
                "no {word:?} in the output\n{self}"
            );
        }
        self
    }

    /// The command took less than `limit`.
    #[track_caller]
    pub fn takes_less_than(&self, limit: Duration) -> &Self {
        assert!(self.time < limit, "\n{self}");
        self
    }

    /// Neither processes nor folders for sockets are left.
    #[track_caller]
    pub fn leaves_nothing(&self) -> &Self {
        let folders = leftovers::socket_folders(&self.folder);
        assert!(folders.is_empty(), "folders are left: {folders:?}\n{self}");
        self.leaves_no_process()
    }

    /// No process is left.
    #[track_caller]
    pub fn leaves_no_process(&self) -> &Self {
        let gone = holds_within(AFTERMATH, &mut || {
            leftovers::processes(&self.folder).is_empty()
        });
        assert!(
            gone,
            "processes are left: {:?}\n{self}",
            leftovers::processes(&self.folder)
        );
        self
    }
}
