//! Reads `[monolithic]`: the same system in one subsystem, which coupled runs are compared with.

use std::path::Path;

use super::resolved::Monolithic;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::reader::{Field, Problems, Section};

const SUM: &str =
    "result columns such as \"mass1.x\", or sums of them such as \"a.energy + b.energy\"";

pub(super) fn read(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Monolithic> {
    section.allow_only(&["scene", "columns"], problems);
    let scene = section
        .require("scene", "scene = \"monolithic/oscillator.toml\"", problems)
        .and_then(|field| field.text(problems));
    let columns = section
        .require(
            "columns",
            "columns = { \"mass1.x\" = \"mass.x\" }",
            problems,
        )
        .and_then(|field| field.section(problems))
        .map(|columns| {
            let pairs = columns.fields();
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
