//! Reads `[monolithic]`: the same system in one subsystem, which coupled runs are compared with.

use std::path::Path;

use super::resolved::Monolithic;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::key::{Key, Takes};
use crate::reading::reader::{Field, Problems, Section};

pub(super) const KEYS: [Key; 2] = [
    Key::new("scene", Takes::Text)
        .required("scene = \"monolithic/oscillator.toml\"")
        .means(
            "a scene file, from the folder of this one, that has the same system in one \
             subsystem",
        ),
    Key::new("columns", Takes::Open(&[]))
        .required("columns = { \"mass1.x\" = \"mass.x\" }")
        .means("result columns of this scene, or sums of them, and what they are in that one"),
];

const SUM: &str =
    "result columns such as \"mass1.x\", or sums of them such as \"a.energy + b.energy\"";

pub(super) fn read(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Monolithic> {
    let [scene, columns] = section.read(&KEYS, problems);
    let scene = scene.and_then(|field| field.text(problems));
    let columns = columns
        .and_then(|field| field.section(problems))
        .map(|columns| {
            let pairs = columns.entries();
            let read = pairs.map(|(own, field)| {
                let own = sum(own, &field, problems)?;
                Some((own, sum(field.text(problems)?, &field, problems)?))
            });
            // Every mistake is to be found, so nothing stops at the first one.
            let read: Vec<Option<(String, String)>> = read.collect();
            read.into_iter().collect::<Option<_>>()
        });
    Some(Monolithic {
        scene: problems.written.folder().join(Path::new(scene?)),
        columns: columns??,
    })
}

/// A sum of columns with one space around every plus.
fn sum(text: &str, field: &Field<'_>, problems: &mut Problems<'_>) -> Option<String> {
    let terms: Vec<&str> = text.split('+').map(str::trim).collect();
    let is_column = |term: &&str| matches!(term.split_once('.'), Some((own, rest)) if !own.is_empty() && !rest.is_empty());
    if terms.iter().all(is_column) {
        return Some(terms.join(" + "));
    }
    let kind = SceneErrorKind::InvalidReference {
        key: field.key.clone(),
        found: text.to_owned(),
        allowed: SUM,
    };
    field.report(kind, problems);
    None
}
