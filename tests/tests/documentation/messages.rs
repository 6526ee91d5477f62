//! The page on messages has those of the program.

use std::fs;
use std::path::Path;

use crate::page::{Page, repository};

/// Shortest piece of a message that is looked for.
const SHORTEST: usize = 4;

#[test]
fn every_message_is_one_of_the_program() {
    let mut sources = String::new();
    for folder in ["master/src", "master/cli/src", "proto/src", "worker/src"] {
        collect(&repository().join(folder), &mut sources);
    }
    let page = Page::read(repository().join("docs/guide/when-it-goes-wrong.md"));
    let mut found = 0;
    for line in page.prose().filter(|line| line.text.starts_with("| *")) {
        let messages = line.text.split('|').nth(1).unwrap_or_default();
        for message in messages.split('*').skip(1).step_by(2) {
            for piece in message.split("..").map(str::trim) {
                assert!(
                    piece.len() < SHORTEST || sources.contains(piece),
                    "{}:{}: no message says {piece:?}",
                    page.name(),
                    line.number
                );
            }
            found += 1;
        }
    }
    assert!(found > 0, "the page has no messages");
}

/// Adds the sources of a folder, texts that are broken over lines in one piece.
fn collect(folder: &Path, sources: &mut String) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, sources);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let mut is_broken = false;
            for line in fs::read_to_string(&path).unwrap().lines() {
                let line = if is_broken { line.trim_start() } else { line };
                is_broken = line.ends_with('\\');
                let text = line.strip_suffix('\\').unwrap_or(line);
                sources.push_str(&text.replace("\\\"", "\""));
                if !is_broken {
                    sources.push('\n');
                }
            }
        }
    }
}
