//! What workers print that a run has started: files in its folder, lines as they come, and the last of them in messages.

#![allow(clippy::unwrap_used, missing_docs)]

use std::path::PathBuf;

use linchpin_tests::process::Workshop;

const OSCILLATOR: &str = include_str!("../../scenes/oscillator.toml");

/// A worker that prints to both outputs before it serves.
fn talkative() -> String {
    let command = Workshop::new().command::<&str>(&[]);
    let linchpin = command.get_program().display();
    let serve = format!("exec {linchpin} worker --exit-with-stdin --listen $0");
    let script = format!("echo to the output; echo to the errors >&2; {serve}");
    format!("command = [\"sh\", \"-c\", \"{script}\", \"{{address}}\"]\nmodel = \"oscillator\"  ")
}

fn workshop(served: &str) -> Workshop {
    let workshop = Workshop::new();
    let scene = OSCILLATOR.replacen("model = \"oscillator\"  ", served, 1);
    assert_ne!(scene, OSCILLATOR);
    workshop.write("scene.toml", scene);
    workshop
}

const RUN: [&str; 5] = ["run", "scene.toml", "--out", "out", "--no-plots"];

fn logs(workshop: &Workshop) -> Vec<PathBuf> {
    let folder = workshop.path().join("out/workers");
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Vec::new();
    };
    entries.map(|entry| entry.unwrap().path()).collect()
}

#[test]
fn both_outputs_of_a_worker_are_in_a_file_and_silent_workers_have_none() {
    let workshop = workshop(&talkative());
    workshop.run(&RUN).succeeds();
    assert_eq!(
        logs(&workshop),
        [workshop.path().join("out/workers/mass1.log")]
    );
    let text = workshop.read("out/workers/mass1.log");
    let mut lines: Vec<&str> = text.lines().collect();
    lines.sort();
    assert_eq!(lines, ["to the errors", "to the output"]);
}

#[test]
fn a_run_begins_with_empty_files_and_leaves_those_of_others() {
    let workshop = workshop(&talkative());
    workshop.run(&RUN).succeeds();
    workshop.write("out/workers/notes.txt", "mine");
    workshop.run(&RUN).succeeds();
    let text = workshop.read("out/workers/mass1.log");
    assert_eq!(text.lines().count(), 2, "{text}");
    workshop
        .run(&[&RUN[..], &["--in-process"]].concat())
        .succeeds();
    assert_eq!(workshop.read("out/workers/notes.txt"), "mine");
    assert_eq!(
        logs(&workshop).len(),
        2,
        "the command is started in this run too"
    );
}

#[test]
fn on_request_the_lines_are_shown() {
    let workshop = workshop(&talkative());
    let outcome = workshop.run(&[&RUN[..], &["--worker-log"]].concat());
    outcome
        .succeeds()
        .says(&["mass1| to the output", "mass1| to the errors"]);
    assert!(!outcome.stderr.contains("mass2|"), "{outcome}");
    let quiet = workshop.run(&RUN);
    assert!(!quiet.stderr.contains("mass1|"), "{quiet}");
}

#[test]
fn a_worker_that_ends_says_why_and_where_the_rest_is() {
    let served = "command = [\"sh\", \"-c\", \"for i in 1 2 3 4 5 6 7 8 9; do echo line $i; done; exit 7\", \"{address}\"]\n\
                  model = \"oscillator\"  ";
    let workshop = workshop(served);
    let outcome = workshop.run(&RUN);
    let log = "(all of it: out/workers/mass1.log)";
    outcome.fails(1, &["mass1", "exit status: 7", "line 4", "line 9", log]);
    assert!(!outcome.stderr.contains("line 3"), "{outcome}");
    assert_eq!(workshop.read("out/workers/mass1.log").lines().count(), 9);
}

/// Far more than a pipe holds: a worker that nobody read would stand still.
#[test]
fn a_worker_that_floods_its_output_is_not_held_up() {
    let flood = "yes 0123456789 | head -c 3000000 >&2; ";
    let served = talkative().replace("echo to the output; ", flood);
    let workshop = workshop(&served);
    workshop.run(&RUN).succeeds();
    let text = workshop.read("out/workers/mass1.log");
    assert_eq!(text.len(), 3_000_000 + "to the errors\n".len());
}
