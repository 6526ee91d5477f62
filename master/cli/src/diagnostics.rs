//! How errors are shown: mistakes in a scene with the lines where they stand.

use std::io::Write;

use linchpin_master::scene::SceneError;
use miette::{LabeledSpan, MietteDiagnostic, NamedSource, Report};

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
    let mut shown = MietteDiagnostic::new(error.message());
    shown.help = error.help();
    let Some(place) = &error.place else {
        return format!("{:?}\n", Report::new(shown));
    };
    let label = LabeledSpan::new_with_span(None, place.span.clone());
    let source = NamedSource::new(place.origin(), place.text().to_owned());
    let report = Report::new(shown.with_label(label)).with_source_code(source);
    format!("{report:?}\n")
}
