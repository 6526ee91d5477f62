//! Every key that a scene file may have stands in its page: the reader is asked for what it offers in place of an unknown key.

use std::collections::BTreeSet;

use linchpin_master::scene::parse;

use crate::page::{Page, repository};

/// No key of any table.
const UNKNOWN: &str = "zzz";

/// Tables of a scene, each with an unknown key.
const TABLES: [&str; 18] = [
    "[scene]\nzzz = 1",
    "[coupling]\nmethod = 'hermite'\nzzz = 1",
    "[coupling]\nmethod = 'baumgarte'\nzzz = 1",
    "[coupling]\nmethod = 'weighted'\nzzz = 1",
    "[coupling]\nmethod = 'explicit'\nzzz = 1",
    "[coupling]\nmethod = 'penalty'\nzzz = 1",
    "[coupling]\nmethod = 'weighted'\niterations = { zzz = 1 }",
    "[[subsystem]]\nzzz = 1",
    "[[joint]]\nzzz = 1",
    "[[connection]]\nzzz = 1",
    "[output]\nzzz = 1",
    "[[output.panel]]\nzzz = 1",
    "[run]\nzzz = 1",
    "[[case]]\nzzz = 1",
    "[converge]\nzzz = 1",
    "[stability]\nzzz = 1",
    "[stability]\nx = { key = 'coupling.macro_step', from = 1, to = 2, zzz = 1 }",
    "[monolithic]\nzzz = 1",
];

/// What a message offers in place of the unknown key: `it has a, b, c`.
fn offered(message: &str) -> Vec<String> {
    let lists = message.split("it has ").skip(1);
    let lines = lists.filter_map(|list| list.lines().next());
    let keys = lines.flat_map(|line| line.split(", "));
    keys.map(|key| key.trim().trim_end_matches('.').to_owned())
        .collect()
}

#[test]
fn every_key_of_a_scene_is_in_its_page() {
    let page = Page::read(repository().join("docs/reference/scene.md"));
    let studies = Page::read(repository().join("docs/reference/studies.md"));
    let text = page.text + &studies.text;
    let mut missing = BTreeSet::new();
    for table in TABLES {
        let message = parse(table, "scene.toml", &[]).unwrap_err().to_string();
        assert!(message.contains(UNKNOWN), "{table}: {message}");
        let keys = offered(&message);
        assert!(!keys.is_empty(), "{table}: {message}");
        let is_missing = |key: &String| !text.contains(&format!("`{key}`"));
        missing.extend(keys.into_iter().filter(is_missing));
    }
    assert!(missing.is_empty(), "{missing:?}");
}
