//! `linchpin conformance` as its user runs it.

use std::sync::Arc;
use std::time::Instant;

use linchpin_tests::process::Workshop;
use serde_json::Value as Json;

use crate::planted::protocol::{Fault, Faulty};
use crate::subjects::built_in;

const LINK: [&str; 8] = [
    "--parameter",
    "m=2",
    "--parameter",
    "inertia=0.3",
    "--parameter",
    "length=1.1",
    "--parameter",
    "angle0=0.7",
];

fn arguments<'a>(more: &[&'a str], worker: &[&'a str]) -> Vec<&'a str> {
    [
        &["conformance", "--model", "planar-body"][..],
        &LINK,
        more,
        worker,
    ]
    .concat()
}

fn this_program() -> String {
    let test = std::env::current_exe().unwrap();
    let folder = test.parent().and_then(std::path::Path::parent).unwrap();
    folder.join("linchpin").display().to_string()
}

#[test]
fn a_sound_command_passes_and_is_ended() {
    let workshop = Workshop::new();
    let program = this_program();
    let worker = ["--", program.as_str(), "worker"];
    let outcome = workshop.run(&arguments(
        &["--step", "1e-3", "--step", "1e-2", "--junit", "kit.xml"],
        &worker,
    ));
    outcome.exits_with(0);
    for line in [
        "pass           mobility",
        "not applicable attitude",
        "0 failed",
        "macro step 0.001, 0.01 s",
    ] {
        assert!(outcome.stdout.contains(line), "{line}\n{}", outcome.stdout);
    }
    assert!(!outcome.stdout.contains('\u{1b}'), "colours in a pipe");
    let junit = workshop.read("kit.xml");
    assert!(
        junit.contains("<testsuite") && junit.contains("failures=\"0\""),
        "{junit}"
    );
}

#[test]
fn the_report_is_json_on_request() {
    let workshop = Workshop::new();
    let program = this_program();
    let outcome = workshop.run(&arguments(&["--json"], &["--", &program, "worker"]));
    outcome.exits_with(0);
    let report: Json = serde_json::from_str(&outcome.stdout).unwrap();
    let checks = report["checks"].as_array().unwrap();
    let grade = |name: &str| {
        checks
            .iter()
            .find(|own| own["name"] == name)
            .map(|own| &own["grade"])
    };
    assert_eq!(grade("replay").unwrap(), "pass");
    assert_eq!(grade("attitude").unwrap(), "not-applicable");
}

#[test]
fn a_fault_ends_with_exit_code_1() {
    let workshop = Workshop::new();
    let address = crate::serve::serve(
        Arc::new(Faulty::new(built_in(), Fault::OneSnapshot)),
        &workshop,
    );
    let outcome = workshop.run(&arguments(&[], &[&address]));
    outcome.exits_with(1);
    assert!(
        outcome.stdout.contains("fail           replay"),
        "{}",
        outcome.stdout
    );
    assert!(
        outcome
            .stdout
            .contains("look at: whether a snapshot has the whole state"),
        "{}",
        outcome.stdout
    );
    assert!(
        outcome.stderr.contains("checks failed"),
        "{}",
        outcome.stderr
    );
}

#[test]
fn a_worker_that_hangs_in_restore_is_given_up() {
    let workshop = Workshop::new();
    let address = crate::serve::serve(
        Arc::new(Faulty::new(built_in(), Fault::HangsInRestore)),
        &workshop,
    );
    let started = Instant::now();
    let outcome = workshop.run(&arguments(&["--timeout", "0.5"], &[&address]));
    outcome.exits_with(1);
    assert!(
        outcome.stdout.contains("no answer within 0.5 s"),
        "{}",
        outcome.stdout
    );
    assert!(
        outcome.stdout.contains("not applicable parallel"),
        "{}",
        outcome.stdout
    );
    assert!(started.elapsed().as_secs() < 10);
}

#[test]
fn what_cannot_be_examined_is_told() {
    let workshop = Workshop::new();
    let program = this_program();
    for (arguments, words) in [
        (
            vec!["conformance", "--", &program, "worker"],
            "choose one with --model",
        ),
        (
            vec![
                "conformance",
                "--model",
                "oscilator",
                "--",
                &program,
                "worker",
            ],
            "no model \"oscilator\"",
        ),
        (
            vec![
                "conformance",
                "--model",
                "oscillator",
                "--",
                &program,
                "worker",
            ],
            "parameters.m is missing",
        ),
        (vec!["conformance", "--", "false"], "its process has ended"),
        (
            vec!["conformance", "--", "no-such-program"],
            "no-such-program",
        ),
        (
            vec!["conformance", "--timeout", "0.2", "http://127.0.0.1:9"],
            "127.0.0.1:9",
        ),
    ] {
        let outcome = workshop.run(&arguments);
        outcome.exits_with(1);
        assert!(
            outcome.stderr.contains(words),
            "{words}\n{}",
            outcome.stderr
        );
    }
    let outcome = workshop.run(&["conformance"]);
    outcome.exits_with(2);
}

#[test]
fn the_worker_in_python_is_not_accused() {
    let workshop = Workshop::new();
    let own = linchpin_tests::python::python();
    let python = own.interpreter.display().to_string();
    let stubs = format!("PYTHONPATH={}", own.stubs.display());
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/python/oscillator_worker.py");
    let outcome = workshop.run(&[
        "conformance",
        "-p",
        "m=2",
        "-p",
        "c=1000",
        "-p",
        "d=10",
        "-p",
        "v0=1",
        "--",
        "env",
        &stubs,
        &python,
        script,
    ]);
    outcome.exits_with(0);
    assert!(
        outcome.stdout.contains("0 with a warning, 0 failed"),
        "{}",
        outcome.stdout
    );
}
