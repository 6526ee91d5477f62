//! Pages whose commands are typed along: what they print is what the page says.

use crate::command::{Command, commands};
use crate::commands::workshop;
use crate::page::{Page, repository};

/// Stands in a page for lines that it leaves out.
const LEFT_OUT: &str = "..";

#[test]
fn the_readme_runs() {
    walk("README.md");
}

#[test]
fn the_first_scene_can_be_typed_along() {
    walk("docs/guide/first-scene.md");
}

#[test]
fn the_summary_that_is_explained_is_that_of_the_program() {
    walk("docs/guide/reading-results.md");
}

fn walk(name: &str) {
    let page = Page::read(repository().join(name));
    let workshop = workshop(&page);
    let mut shown = 0;
    for command in commands(&page) {
        let outcome = workshop.run(&command.arguments);
        let code = command.exit_code();
        outcome.exits_with(code);
        let printed = [outcome.stdout, outcome.stderr].join("\n");
        compare(&command, &printed);
        shown += command.output.len();
    }
    assert!(shown > 0, "{name} shows no output");
}

fn compare(command: &Command, printed: &str) {
    let lines: Vec<String> = printed.lines().map(comparable).collect();
    for line in command.output.iter().filter(|line| *line != LEFT_OUT) {
        assert!(
            lines.contains(&comparable(line)),
            "{}: the page shows the line\n{line}\nbut the command prints\n{printed}",
            command.place
        );
    }
}

/// A line as it is, but for times that a clock has measured.
fn comparable(line: &str) -> String {
    let is_timed = [": reached t = ", "s in its solver", "  time: "]
        .iter()
        .any(|piece| line.contains(piece));
    if !is_timed {
        return line.trim_end().to_owned();
    }
    let words = line.split_whitespace().map(|word| {
        let is_number = word.trim_start_matches('(').parse::<f64>().is_ok();
        if is_number { "#" } else { word }
    });
    words.collect::<Vec<_>>().join(" ")
}
