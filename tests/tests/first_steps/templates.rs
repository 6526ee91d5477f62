//! `linchpin init`: what it writes runs at once.

use std::env;
use std::process::Command;

use linchpin_tests::process::Workshop;
use linchpin_tests::python::{in_repository, python};

#[test]
fn a_first_scene_runs() {
    let workshop = Workshop::new();
    let outcome = workshop.run(&["init", "first"]);
    outcome.succeeds();
    assert!(
        outcome.stdout.starts_with("first/scene.toml\n"),
        "{outcome}"
    );
    let outcome = workshop.run(&["run", "first/scene.toml"]);
    outcome.succeeds();
    assert!(
        outcome.stdout.contains("two-links: reached t = 2 s"),
        "{outcome}"
    );
}

#[test]
fn a_python_worker_runs() {
    let workshop = Workshop::new();
    workshop
        .run(&["init", "--template", "python-worker", "mine"])
        .succeeds();
    let bin = python().interpreter.parent().unwrap().display().to_string();
    let path = [bin, env::var("PATH").unwrap()].join(":");
    let mut command = workshop.command(&["run", "scene.toml"]);
    command
        .current_dir(workshop.path().join("mine"))
        .env("PATH", path)
        .env("PYTHONPATH", in_repository("worker/python/src"));
    assert_runs(&workshop, command);
}

#[track_caller]
fn assert_runs(workshop: &Workshop, command: Command) {
    let outcome = workshop.start_command(command).wait();
    outcome.succeeds();
    assert!(
        outcome.stdout.contains("mine: reached t = 1 s"),
        "{outcome}"
    );
}

/// Cargo builds the template as an example of the SDK for these tests: what a user would build has the same text.
#[test]
fn a_rust_worker_runs() {
    let workshop = Workshop::new();
    let clone = in_repository(".").display().to_string();
    let template = [
        "init",
        "--template",
        "rust-worker",
        "mine",
        "--source",
        &clone,
    ];
    workshop.run(&template).succeeds();
    let manifest = workshop.read("mine/Cargo.toml");
    for part in ["proto", "worker"] {
        let path = format!("path = \"{clone}/{part}\"");
        assert!(manifest.contains(&path), "{manifest}");
    }
    let text = std::fs::read_to_string(in_repository("worker/template/src/main.rs")).unwrap();
    assert_eq!(workshop.read("mine/src/main.rs"), text);
    let folder = workshop.path().join("mine");
    std::fs::create_dir_all(folder.join("target/release")).unwrap();
    let built = env::current_exe().unwrap();
    let built = built.parent().unwrap().join("../examples/worker-template");
    assert!(
        built.exists(),
        "cargo build --release -p linchpin-worker --example worker-template"
    );
    std::fs::copy(built, folder.join("target/release/mine")).unwrap();
    let mut command = workshop.command(&["run", "scene.toml"]);
    command.current_dir(&folder);
    assert_runs(&workshop, command);
}

#[test]
fn nothing_is_overwritten() {
    let workshop = Workshop::new();
    std::fs::create_dir(workshop.path().join("mine")).unwrap();
    workshop.write("mine/worker.py", "my own");
    let init = ["init", "--template", "python-worker", "mine"];
    workshop.run(&init).fails(
        2,
        &["mine/worker.py is there already", "nothing was written"],
    );
    assert_eq!(workshop.read("mine/worker.py"), "my own");
    assert!(!workshop.path().join("mine/scene.toml").exists());
    let no_clone = [
        "init",
        "--template",
        "rust-worker",
        "other",
        "--source",
        "mine",
    ];
    workshop
        .run(&no_clone)
        .fails(2, &["mine is no clone of Linchpin", "--source"]);
    workshop.write("file", "");
    workshop
        .run(&["init", "file/inside"])
        .fails(1, &["cannot write to file/inside"]);
    workshop
        .run(&["init", "--template", "fortran", "x"])
        .fails(2, &["fortran", "python-worker"]);
}
