//! Pages of the reference that are written from the program itself: command line, built-in models, contract, conformance checks,
//! and the keys of scene, study and spectrum files, with their JSON schemas.

use linchpin_master::scene::{SCENE_KEYS, SPECTRUM_KEYS, STUDY_KEYS};

mod command_line;
mod conformance;
mod contract;
mod keys;
mod models;
mod schema;

/// Command that writes the pages.
pub const COMMAND: &str = "cargo run --release -p linchpin-tests --example reference";

/// Columns of a line of prose.
const WIDTH: usize = 110;

/// The pages under docs/reference: name of the file and text.
pub fn pages() -> [(&'static str, String); 9] {
    let scene = ("scene file", &SCENE_KEYS[..]);
    let study = ("study file", &STUDY_KEYS[..]);
    let spectrum = ("spectrum file", &SPECTRUM_KEYS[..]);
    let schema = |(title, keys)| schema::schema(&format!("Linchpin {title}"), keys);
    [
        ("command-line.md", command_line::page()),
        ("models.md", models::page()),
        ("contract.md", contract::page()),
        ("conformance.md", conformance::page()),
        ("scene.md", keys::page("scene.md", &[scene])),
        ("studies.md", keys::page("studies.md", &[study, spectrum])),
        ("scene.schema.json", schema(scene)),
        ("study.schema.json", schema(study)),
        ("spectrum.schema.json", schema(spectrum)),
    ]
}

/// First lines of a page.
fn head(title: &str) -> String {
    format!("<!-- Written by `{COMMAND}`; changes by hand are lost. -->\n\n# {title}\n")
}

/// Text for a cell of a table.
fn cell(text: &str) -> String {
    text.split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
        .replace('|', "\\|")
        .replace('<', "&lt;")
}

/// A name as code; empty if there is none.
fn code(name: &str) -> String {
    if name.is_empty() {
        String::new()
    } else {
        format!("`{name}`")
    }
}

/// A paragraph within the width of a page. A line breaks before words only, so that none looks like a list or a heading.
fn prose(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.replace('<', "&lt;").split_whitespace() {
        let may_start = word.starts_with(|c: char| c.is_alphabetic() || "\"(`".contains(c));
        let line = lines.last().map_or("", String::as_str);
        let is_full = line.chars().count() + 1 + word.chars().count() > WIDTH;
        if line.is_empty() || (is_full && may_start) {
            lines.push(word.to_owned());
        } else if let Some(line) = lines.last_mut() {
            line.push(' ');
            line.push_str(word);
        }
    }
    lines[1..].join("\n") + "\n"
}
