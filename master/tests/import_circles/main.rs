//! No files of the master import each other in a circle, so that each can be read after those that it builds on.

#![allow(clippy::unwrap_used, missing_docs)]

mod graph;
mod parser;
mod source;

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

use graph::{Arrow, Files, circles};

/// Adds the source files of a folder, with their places below the root.
fn read(folder: &Path, below: &str, files: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        let place = format!("{below}{name}");
        if entry.file_type().unwrap().is_dir() {
            read(&entry.path(), &format!("{place}/"), files);
        } else if name.ends_with(".rs") {
            files.push((place, std::fs::read_to_string(entry.path()).unwrap()));
        }
    }
}

/// Folders and files of unit tests may import what they like.
fn is_test(place: &str) -> bool {
    place.split(['/', '.']).any(|part| part == "tests")
}

fn told(circles: &[Vec<Arrow>]) -> String {
    let mut told = String::new();
    for (number, circle) in circles.iter().enumerate() {
        writeln!(told, "circle {}:", number + 1).unwrap();
        for Arrow { from, to, text } in circle {
            writeln!(told, "  {from} -> {to}: {text}").unwrap();
        }
    }
    told
}

/// Every arrow between files of the master.
fn arrows() -> BTreeSet<Arrow> {
    let mut files = Vec::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    read(&folder, "", &mut files);
    files.retain(|(place, _)| !is_test(place));
    let arrows = Files::read(files).arrows();
    assert!(arrows.len() > 300, "only {} arrows found", arrows.len());
    arrows
}

#[test]
fn the_files_of_the_master_import_each_other_in_no_circle() {
    let circles = circles(&arrows());
    assert!(
        circles.is_empty(),
        "move what both sides need to a file of its own:\n{}",
        told(&circles)
    );
}

#[test]
fn nor_do_its_folders() {
    let folder = |file: &str| {
        let first = file.split(['/', '.']).next();
        first.unwrap().to_owned()
    };
    let between = arrows().into_iter().map(|arrow| Arrow {
        text: format!("{}: {}", arrow.from, arrow.text),
        from: folder(&arrow.from),
        to: folder(&arrow.to),
    });
    let between: BTreeSet<_> = between.filter(|arrow| arrow.from != arrow.to).collect();
    let circles = circles(&between);
    assert!(
        circles.is_empty(),
        "move what both sides need below both:\n{}",
        told(&circles)
    );
}

/// Which room takes nothing from which others.
const FORBIDDEN: [(&str, &[&str]); 4] = [
    ("policies", &["workers", "methods", "macro_step", "scene"]),
    ("methods", &["workers", "policies", "macro_step", "scene"]),
    ("results", &["workers"]),
    ("workers", &["methods", "policies", "macro_step", "scene"]),
];

#[test]
fn policies_methods_and_workers_know_nothing_of_each_other() {
    let arrows = arrows();
    let parts = |file: &str| -> Vec<String> { file.split(['/', '.']).map(str::to_owned).collect() };
    let mut wrong = BTreeSet::new();
    for arrow in &arrows {
        let (from, to) = (parts(&arrow.from), parts(&arrow.to));
        let forbidden = FORBIDDEN.iter().find(|(room, _)| *room == from[0]);
        let is_forbidden = forbidden.is_some_and(|(_, others)| others.contains(&to[0].as_str()));
        let is_other_policy = from[0] == "policies" && to[0] == "policies" && from[1] != to[1];
        if is_forbidden || is_other_policy {
            wrong.insert(format!("{} -> {}: {}", arrow.from, arrow.to, arrow.text));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
