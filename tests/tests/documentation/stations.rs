//! The walk through one macro step: short, in order, and along functions that are there.

use std::collections::BTreeSet;
use std::fs;

use crate::page::{Page, repository};

/// Most stations that a newcomer is asked to walk along.
const MOST: usize = 25;

/// A line `N. [file](target), `function`: what happens there.`
struct Station<'a> {
    number: usize,
    file: &'a str,
    target: &'a str,
    function: &'a str,
}

impl<'a> Station<'a> {
    fn read(line: &'a str) -> Option<Self> {
        let (number, rest) = line.split_once(". [")?;
        let (file, rest) = rest.split_once("](")?;
        let (target, rest) = rest.split_once("), `")?;
        let (function, what) = rest.split_once("`: ")?;
        let number = number.parse().ok()?;
        (!what.is_empty()).then_some(Self {
            number,
            file,
            target,
            function,
        })
    }

    /// What is wrong with it, if anything.
    fn mistake(&self) -> Option<String> {
        let Self {
            file,
            target,
            function,
            ..
        } = self;
        if *target != format!("../../master/src/{file}") {
            return Some(format!("{target} is not {file}"));
        }
        let path = repository().join("master/src").join(file);
        let Ok(text) = fs::read_to_string(path) else {
            return Some(format!("there is no {file}"));
        };
        let (owner, name) = function.rsplit_once("::").unwrap_or(("", function));
        let is_there = ["(", "<"].map(|behind| text.contains(&format!("fn {name}{behind}")));
        let has_owner = text.contains(owner);
        (!is_there.contains(&true) || !has_owner).then(|| format!("{file} has no {function}"))
    }
}

#[test]
fn the_walk_through_a_macro_step_names_what_is_there() {
    let page = Page::read(repository().join("docs/guide/macro-step.md"));
    let is_numbered = |text: &str| text.starts_with(|letter: char| letter.is_ascii_digit());
    let lines = page.prose().filter(|line| is_numbered(line.text));
    let mut mistakes = Vec::new();
    let mut told = BTreeSet::new();
    let mut count = 0;
    for line in lines {
        count += 1;
        let Some(station) = Station::read(line.text) else {
            mistakes.push(format!("{}: this is no station", line.number));
            continue;
        };
        if station.number != count {
            mistakes.push(format!("{}: this is station {count}", line.number));
        }
        if !told.insert((station.file, station.function)) {
            mistakes.push(format!("{}: told twice", line.number));
        }
        let mistake = station.mistake();
        mistakes.extend(mistake.map(|mistake| format!("{}: {mistake}", line.number)));
    }
    assert!(mistakes.is_empty(), "\n{}", mistakes.join("\n"));
    assert!(count > 0, "the walk has no station");
    assert!(count <= MOST, "{count} stations are too many");
}
