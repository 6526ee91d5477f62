//! `run.json`: what a command is about, how it stands, and in the end its numbers.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::Program;
use crate::commands::CommandError;
use crate::files::replace_text;
use crate::interrupt;

/// Name of the file.
pub const FILE: &str = "run.json";

/// Blanks behind the text of a command that is under way: room for its end on a disk that is full by then.
const RESERVE: usize = 2048;

/// Most bytes of a reason on such a disk.
const SHORT_REASON: usize = 512;

/// How a command ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Ending {
    /// With all that was asked.
    Done,
    /// Early, for a reason.
    Failed(String),
    /// Early, since somebody asked for that.
    Interrupted(String),
}

impl Ending {
    /// That of a command.
    pub fn of<T>(outcome: &Result<T, CommandError>) -> Self {
        match outcome {
            Ok(_) => Self::Done,
            Err(error) if error.is_interrupt() => {
                let signal = interrupt::received().map(interrupt::Request::name);
                let by = signal.map(|name| format!(" ({name})")).unwrap_or_default();
                Self::Interrupted(format!("{error}{by}"))
            }
            Err(error) => Self::Failed(error.to_string()),
        }
    }

    /// In a word: `done`, `failed` or `interrupted`.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Failed(_) => "failed",
            Self::Interrupted(_) => "interrupted",
        }
    }

    fn reason(&self) -> Option<&str> {
        match self {
            Self::Done => None,
            Self::Failed(reason) | Self::Interrupted(reason) => Some(reason),
        }
    }
}

/// The file of one command; `A` is what it is about.
pub struct StatusFile<A> {
    path: PathBuf,
    program: Program,
    /// What the command is about.
    pub about: A,
}

#[derive(Serialize)]
struct Document<'a, A, R> {
    /// `running`, `done`, `failed` or `interrupted`.
    status: &'a str,
    /// Why it did not come to its end.
    reason: Option<&'a str>,
    #[serde(flatten)]
    program: &'a Program,
    #[serde(flatten)]
    about: &'a A,
    #[serde(flatten)]
    results: Option<R>,
}

/// No results.
#[derive(Serialize)]
struct Nothing {}

impl<A: Serialize> StatusFile<A> {
    /// The file of this command in a folder; nothing is written yet.
    pub fn new(folder: &Path, program: &Program, about: A) -> Self {
        Self {
            path: folder.join(FILE),
            program: program.clone(),
            about,
        }
    }

    /// Whether there is a file already: that of an earlier command.
    pub fn is_there(&self) -> bool {
        self.path.exists()
    }

    /// Says that the command is under way.
    ///
    /// # Errors
    /// [`CommandError::Unwritable`]
    pub fn running(&self) -> Result<(), CommandError> {
        let mut text = self.text("running", None, None::<Nothing>)?;
        text.push_str(&" ".repeat(RESERVE));
        text.push('\n');
        self.write(&text)
    }

    /// Says how the command ended, with its results as far as there are any.
    ///
    /// # Errors
    /// [`CommandError::Unwritable`]
    pub fn end(
        &self,
        ending: &Ending,
        results: Option<impl Serialize>,
    ) -> Result<(), CommandError> {
        let whole = self.text(ending.word(), ending.reason(), results)? + "\n";
        self.write(&whole).or_else(|error| {
            // The disk may be full: then at least the status, in the room that was kept for it.
            let reason = ending.reason().map(shortened);
            let short = self.text(ending.word(), reason, None::<Nothing>)? + "\n";
            self.write(&short).map_err(|_| error)
        })
    }

    fn write(&self, text: &str) -> Result<(), CommandError> {
        replace_text(&self.path, text)
    }

    fn text(
        &self,
        status: &str,
        reason: Option<&str>,
        results: Option<impl Serialize>,
    ) -> Result<String, CommandError> {
        let document = Document {
            status,
            reason,
            program: &self.program,
            about: &self.about,
            results,
        };
        let text = serde_json::to_string_pretty(&document).map_err(std::io::Error::from);
        text.map_err(CommandError::unwritable(&self.path))
    }
}

/// The beginning of a reason.
fn shortened(reason: &str) -> &str {
    let end = (0..=SHORT_REASON.min(reason.len()))
        .rev()
        .find(|end| reason.is_char_boundary(*end));
    &reason[..end.unwrap_or_default()]
}
