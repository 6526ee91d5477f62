//! How errors are shown: mistakes in a scene with the lines where they stand.

use std::fmt;
use std::io::Write;

use linchpin_master::scene::SceneError;
use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};

use crate::commands::CommandError;

/// Writes an error to the error output: with source lines for a person at a terminal, one line each otherwise.
pub fn show(error: &CommandError, for_a_person: bool) {
    let text = match error.scene_errors() {
        Some(errors) if for_a_person => errors.iter().map(with_source_lines).collect(),
        Some(errors) => errors
            .iter()
            .map(|error| format!("error: {error}\n"))
            .collect(),
        None => format!("error: {error}\n"),
    };
    // Whoever closed the error output is not told.
    let _ = write!(std::io::stderr(), "{text}");
}

fn with_source_lines(error: &SceneError) -> String {
    format!("{:?}\n", miette::Report::new(Shown::from(error)))
}

#[derive(Debug)]
struct Shown {
    message: String,
    help: Option<String>,
    source: Option<NamedSource<String>>,
    span: Option<LabeledSpan>,
}

impl From<&SceneError> for Shown {
    fn from(error: &SceneError) -> Self {
        let place = error.place.as_ref();
        Self {
            message: error.message(),
            help: error.help(),
            source: place.map(|place| NamedSource::new(place.origin(), place.text().to_owned())),
            span: place.map(|place| LabeledSpan::new_with_span(None, place.span.clone())),
        }
    }
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Shown {}

impl Diagnostic for Shown {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help
            .as_ref()
            .map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.span
            .as_ref()
            .map(|span| Box::new(std::iter::once(span.clone())) as Box<dyn Iterator<Item = _>>)
    }
}
