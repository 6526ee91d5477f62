//! What users get wrong, and what goes wrong around them: every mistake ends with its exit code, a message with place
//! and remedy, no process and no folder left behind, and the results up to there.

#![allow(clippy::unwrap_used)]

mod checks;
mod command_line;
mod divergence;
mod listening;
mod misplaced_replies;
mod results;
mod scene_file;
mod signals;
mod standing_workers;
mod starting_workers;
mod studies;
mod workers_at_work;

use std::path::PathBuf;

use linchpin_tests::process::Workshop;

const OSCILLATOR: &str = include_str!("../../../scenes/oscillator.toml");

/// The oscillator scene with pieces of its text replaced.
fn oscillator(changes: &[(&str, &str)]) -> String {
    let mut text = OSCILLATOR.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "the scene has no {from:?}");
        text = text.replacen(from, to, 1);
    }
    text
}

/// A folder with `scene.toml`, the oscillator scene with pieces of its text replaced.
fn workshop(changes: &[(&str, &str)]) -> Workshop {
    let workshop = Workshop::new();
    workshop.write("scene.toml", oscillator(changes));
    workshop
}

/// The first subsystem served by whatever `line` says.
fn served_by(line: &str) -> Workshop {
    workshop(&[(
        "model = \"oscillator\"  ",
        &format!("{line}\nmodel = \"oscillator\"  "),
    )])
}

/// `run scene.toml --out out` with more arguments.
fn run<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["run", "scene.toml", "--out", "out", "--no-plots"], more].concat()
}

/// `check scene.toml` with more arguments.
fn check<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["check", "scene.toml"], more].concat()
}

/// Place of the first line of `scene.toml` with `piece`, as messages show it.
fn place(workshop: &Workshop, piece: &str) -> String {
    let text = workshop.read("scene.toml");
    let line = text.lines().position(|line| line.contains(piece)).unwrap();
    format!("scene.toml:{}:", line + 1)
}

/// The rows of `out/results.csv` as numbers; fails if one of them cannot be read.
fn rows(workshop: &Workshop) -> Vec<Vec<f64>> {
    let text = workshop.read("out/results.csv");
    let mut lines = text.lines();
    let columns = lines.next().unwrap().split(',').count();
    let row = |line: &str| {
        let values: Vec<f64> = line
            .split(',')
            .map(|value| value.parse().unwrap())
            .collect();
        assert_eq!(values.len(), columns, "{line}");
        values
    };
    lines.map(row).collect()
}

/// Files that a test leaves in its workshop, for demands on what is not there.
fn exists(workshop: &Workshop, name: &str) -> bool {
    let path: PathBuf = workshop.path().join(name);
    path.exists()
}
