//! Where in the scene's text something stands.

use std::fmt;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// Where the text of a setting comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Origin {
    /// A scene file, or text under a given name.
    File(String),
    /// A setting given beside the file, such as `--set coupling.degree=2`.
    Override,
}

/// A text that holds settings: the scene file, or one override.
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Source {
    origin: Origin,
    text: String,
}

/// Without the text, which would bury whatever else is shown.
impl fmt::Debug for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Source")
            .field("origin", &self.origin)
            .finish_non_exhaustive()
    }
}

impl Source {
    pub(crate) fn file(origin: &str, text: &str) -> Self {
        Self {
            origin: Origin::File(origin.to_owned()),
            text: text.to_owned(),
        }
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The path of the file.
    pub(crate) fn path(&self) -> Option<&Path> {
        match &self.origin {
            Origin::File(name) => Some(Path::new(name)),
            Origin::Override => None,
        }
    }

    pub(crate) fn over_ride(text: String) -> Self {
        Self {
            origin: Origin::Override,
            text,
        }
    }
}

/// A range of bytes in one of the sources of a scene; the first source is the file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Spot {
    pub(crate) source: usize,
    pub(crate) start: usize,
    pub(crate) end: usize,
}

impl Spot {
    /// The same range in another source.
    pub(crate) fn in_source(&self, source: usize) -> Self {
        Self {
            source,
            ..self.clone()
        }
    }

    pub(crate) fn new(source: usize, span: Range<usize>) -> Self {
        Self {
            source,
            start: span.start,
            end: span.end,
        }
    }
}

/// A place in a scene file, or in an override such as `--set coupling.degree=2`.
///
/// Its `Display` is `file:line:column`, or the override itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    source: Arc<Source>,
    /// Bytes of [`Place::text`].
    pub span: Range<usize>,
    /// Line of the first byte, counted from 1.
    pub line: usize,
    /// Column of the first byte in characters, counted from 1.
    pub column: usize,
}

impl Place {
    pub(crate) fn new(source: &Arc<Source>, spot: &Spot) -> Self {
        let before = source.text.get(..spot.start).unwrap_or(&source.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Self {
            source: Arc::clone(source),
            span: before.len()..spot.end.clamp(before.len(), source.text.len()),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        }
    }

    /// Name of the file, or the override itself.
    pub fn origin(&self) -> &str {
        match &self.source.origin {
            Origin::File(name) => name,
            Origin::Override => &self.source.text,
        }
    }

    /// The whole text of which [`Place::span`] is a part.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// True if the place is an override, not the scene file.
    pub fn is_override(&self) -> bool {
        self.source.origin == Origin::Override
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.source.origin {
            Origin::File(name) => write!(f, "{name}:{}:{}", self.line, self.column),
            Origin::Override => f.write_str(&self.source.text),
        }
    }
}
