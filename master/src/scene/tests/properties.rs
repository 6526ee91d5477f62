//! No text whatever makes the reader panic, and an error always says something.

use proptest::prelude::*;

use super::super::{Override, parse, warnings};
use super::{EXAMPLE, ORIGIN};

/// Parses and uses whatever comes out.
fn exercise(text: &str, overrides: &[Override]) -> Result<(), TestCaseError> {
    match parse(text, ORIGIN, overrides) {
        Ok(scene) => {
            warnings(&scene);
            prop_assert_eq!(&scene, &parse(text, ORIGIN, overrides).unwrap());
        }
        Err(errors) => {
            prop_assert!(errors.iter().count() > 0);
            prop_assert!(errors.iter().all(|error| !error.message().is_empty()));
            for place in errors.iter().filter_map(|error| error.place.as_ref()) {
                prop_assert!(place.text().get(place.span.clone()).is_some());
            }
        }
    }
    Ok(())
}

/// Words that occur in scenes, and what people put in their place.
fn word() -> impl Strategy<Value = String> {
    prop_oneof![
        prop::sample::select(vec![
            "-1",
            "0",
            "1e400",
            "nan",
            "inf",
            "99999999999999999999",
            "0xffffffffffffffffff",
            "\"2H\"",
            "\"-H\"",
            "\"H^2\"",
            "[]",
            "{}",
            "[[1]]",
            "true",
            "1979-05-27",
            "mass1",
            "*",
            "index = 3",
            "[[subsystem]]",
            "[run]",
            "gamma = \"1e308H^2\"",
            "beta",
            "weighted",
            "explicit",
            "set",
            ".",
            "=",
            "\"",
            "\n",
            "1e-320",
        ])
        .prop_map(str::to_owned),
        "\\PC{0,6}",
    ]
}

fn key() -> impl Strategy<Value = String> {
    let part = prop_oneof![
        prop::sample::select(vec![
            "coupling",
            "subsystem",
            "mass1",
            "*",
            "joint",
            "link",
            "scene",
            "parameters",
            "beta",
            "method",
            "x",
            "",
            "name",
            "t_end",
            "macro_step",
            "case",
            "stability",
            "degree",
        ])
        .prop_map(str::to_owned),
        "\\PC{0,4}",
    ];
    prop::collection::vec(part, 0..5).prop_map(|parts| parts.join("."))
}

proptest! {
    #[test]
    fn arbitrary_text_is_an_error_or_a_scene(text in "(\\PC|\n|\t){0,200}") {
        exercise(&text, &[])?;
    }

    #[test]
    fn a_damaged_example_is_an_error_or_a_scene(
        damages in prop::collection::vec((0..EXAMPLE.len(), 0usize..40, word()), 1..4)
    ) {
        let mut text = EXAMPLE.to_owned();
        for (start, length, new) in damages {
            let start = text.floor_char_boundary(start);
            let end = text.floor_char_boundary(start + length);
            text.replace_range(start..end, &new);
        }
        exercise(&text, &[])?;
    }

    #[test]
    fn values_exchanged_for_others_are_errors_or_scenes(
        changes in prop::collection::vec((0usize..60, word()), 1..4)
    ) {
        let mut lines: Vec<String> = EXAMPLE.lines().map(str::to_owned).collect();
        for (i, new) in changes {
            let count = lines.len();
            let line = &mut lines[i % count];
            if let Some(equals) = line.find('=') {
                *line = format!("{} {new}", &line[..=equals]);
            }
        }
        exercise(&lines.join("\n"), &[])?;
    }

    #[test]
    fn arbitrary_overrides_are_errors_or_scenes(
        settings in prop::collection::vec((key(), word()), 1..4)
    ) {
        let overrides: Vec<Override> =
            settings.into_iter().map(|(key, value)| Override { key, value }).collect();
        exercise(EXAMPLE, &overrides)?;
    }

    #[test]
    fn the_text_of_an_override_is_key_and_value(text in "\\PC{0,20}") {
        match text.parse::<Override>() {
            Ok(parsed) => {
                prop_assert!(!parsed.key.is_empty());
                let squeezed = |s: &str| s.split_whitespace().collect::<String>();
                prop_assert_eq!(squeezed(&text), squeezed(&parsed.to_string()));
            }
            Err(_) => prop_assert!(text.split_once('=').is_none_or(|(key, _)| key.trim().is_empty())),
        }
    }
}
