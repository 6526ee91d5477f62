//! What a call of an FMU has answered, and what the FMU has said meanwhile.

use std::ffi::{CStr, CString, c_char, c_int};
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// Longest message of an FMU that is kept, in characters.
const LONGEST: usize = 500;

/// The status of a call that did not succeed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// The call had no effect; a smaller step may help.
    Discard,
    /// The instance is in no sound state, until it goes back to one.
    Error,
    /// No instance of this FMU can go on in this process.
    Fatal,
    /// The answer comes later, which was not permitted.
    Pending,
    /// It asks to end the simulation.
    Terminated,
    /// It gave nothing.
    Nothing,
    /// A number that the standard does not know.
    Unknown(c_int),
    /// It was not called: an earlier call was fatal.
    Lost,
}

/// A call that did not succeed.
#[derive(Debug, Clone, PartialEq)]
pub struct CallFailure {
    /// Name of the function.
    pub function: &'static str,
    /// How it ended.
    pub status: Status,
    /// What the FMU has said; empty if nothing.
    pub said: String,
}

impl fmt::Display for CallFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let function = self.function;
        match self.status {
            Status::Discard => write!(f, "{function} answered Discard")?,
            Status::Error => write!(f, "{function} answered Error")?,
            Status::Fatal => write!(f, "{function} answered Fatal")?,
            Status::Pending => write!(
                f,
                "{function} answered Pending, although asynchronous steps were not permitted"
            )?,
            Status::Terminated => write!(f, "{function} asked to end the simulation")?,
            Status::Nothing => write!(f, "{function} gave nothing")?,
            Status::Unknown(number) => {
                write!(f, "{function} answered {number}, which is no status of FMI")?;
            }
            Status::Lost => write!(
                f,
                "{function} was not called: a call of this FMU has answered Fatal in this process, start the worker again"
            )?,
        }
        match self.said.as_str() {
            "" => Ok(()),
            said => write!(f, "; it says: {said}"),
        }
    }
}

/// What an FMU has said during a call.
#[derive(Debug, Default)]
pub(super) struct Messages(Mutex<String>);

impl Messages {
    /// Keeps the last message that is a complaint, and writes all to the log.
    pub(super) fn note(&self, name: &str, status: c_int, message: &str) {
        if status == OK {
            tracing::debug!(fmu = name, message);
            return;
        }
        tracing::warn!(fmu = name, message);
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = message.to_owned();
    }

    fn take(&self) -> String {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// A failure of `function` with all that was said.
    pub(super) fn failure(&self, function: &'static str, status: Status) -> CallFailure {
        CallFailure {
            function,
            status,
            said: self.take(),
        }
    }

    /// The answer of `function`.
    pub(super) fn check(&self, function: &'static str, status: c_int) -> Result<(), CallFailure> {
        let status = match status {
            OK | WARNING => {
                // What was said has been told in the log, and has nothing to do with a later failure.
                self.take();
                return Ok(());
            }
            2 => Status::Discard,
            3 => Status::Error,
            4 => Status::Fatal,
            5 => Status::Pending,
            number => Status::Unknown(number),
        };
        Err(self.failure(function, status))
    }
}

/// `fmi2OK`, `fmi3OK`.
pub(super) const OK: c_int = 0;
const WARNING: c_int = 1;

/// A text that a library gave, without line ends.
///
/// # Safety
/// `text` is null or ends with a zero byte.
pub(super) unsafe fn text_of(text: *const c_char) -> String {
    if text.is_null() {
        return String::new();
    }
    // SAFETY: the caller answers for the end.
    let text = unsafe { CStr::from_ptr(text) }.to_string_lossy();
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ").chars().take(LONGEST).collect()
}

/// A text for C; it ends before a zero byte in it.
pub(super) fn terminated(text: &str) -> CString {
    let bytes: Vec<u8> = text.bytes().take_while(|byte| *byte != 0).collect();
    CString::new(bytes).unwrap_or_default()
}
