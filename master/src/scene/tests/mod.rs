//! Tests of the scene: the example as it is, mistakes in it, overrides, stability rules, arbitrary text.
#![allow(clippy::unwrap_used)]

mod coupling_mistakes;
mod mistakes;
mod override_mistakes;
mod overrides;
mod panels;
mod properties;
mod reference_mistakes;
mod settings;
mod spectrum_mistakes;
mod stability;
mod step_control;
mod study_mistakes;

use super::{Scene, SceneError, SceneErrors, parse};

/// The example that must run as it is.
const EXAMPLE: &str = include_str!("../../../../scenes/oscillator.toml");

/// The name under which the tests parse text.
const ORIGIN: &str = "scene.toml";

fn example() -> Scene {
    parse(EXAMPLE, ORIGIN, &[]).unwrap()
}

/// The example with parts of its text replaced at their first occurrence.
fn edited(edits: &[(&str, &str)]) -> String {
    let mut text = EXAMPLE.to_owned();
    for (old, new) in edits {
        assert!(text.contains(old), "the example does not contain {old:?}");
        text = text.replacen(old, new, 1);
    }
    text
}

fn scene(edits: &[(&str, &str)]) -> Scene {
    let text = edited(edits);
    parse(&text, ORIGIN, &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The example with its coupling replaced, apart from the macro step of 1e-3 s.
fn coupled(settings: &str) -> Result<Scene, SceneErrors> {
    let (head, rest) = EXAMPLE.split_once("[coupling]").unwrap();
    let (_, tail) = rest.split_once("[[subsystem]]").unwrap();
    let text = format!("{head}[coupling]\nmacro_step = 1e-3\n{settings}\n[[subsystem]]{tail}");
    parse(&text, ORIGIN, &[])
}

fn line_of(text: &str, part: &str) -> usize {
    let start = text.find(part).unwrap();
    text[..start].matches('\n').count() + 1
}

fn only(errors: SceneErrors) -> SceneError {
    let mut errors: Vec<_> = errors.into_iter().collect();
    assert_eq!(errors.len(), 1, "{errors:#?}");
    errors.remove(0)
}

/// Asserts that an error text has all the words.
fn assert_words(error: &SceneError, words: &[&str]) {
    let shown = error.to_string();
    for word in words {
        assert!(shown.contains(word), "{word:?} is missing in\n{shown}");
    }
}

/// Asserts that the edited example has exactly one mistake, in the line where `at` stands, told with all the words.
fn assert_mistake(edits: &[(&str, &str)], at: &str, words: &[&str]) {
    let text = edited(edits);
    let error = only(parse(&text, ORIGIN, &[]).unwrap_err());
    assert_words(&error, words);
    let place = error.place.unwrap();
    assert_eq!(
        (place.origin(), place.line),
        (ORIGIN, line_of(&text, at)),
        "{place}"
    );
}
