//! States that leave their process: what the kit finds only because it starts the worker once more.

use linchpin_tests::process::Workshop;
use linchpin_tests::python::{in_repository, python};
use serde_json::Value as Json;

/// The report on the worker in Python that keeps a part of its state elsewhere.
fn report(kept: &str) -> Json {
    let parameter = format!("kept={kept}");
    let path = format!(
        "PYTHONPATH={}",
        in_repository("worker/python/src").display()
    );
    let script = in_repository("tests/python/forgetful_worker.py");
    let command = [
        "conformance",
        "--json",
        "--parameter",
        &parameter,
        "--",
        "env",
        &path,
        python().interpreter.to_str().unwrap(),
        script.to_str().unwrap(),
    ];
    let outcome = Workshop::new().run(&command);
    serde_json::from_str(&outcome.stdout).unwrap_or_else(|_| panic!("{outcome:?}"))
}

fn failed(report: &Json) -> Vec<&str> {
    let checks = report["checks"].as_array().unwrap().iter();
    checks
        .filter(|own| own["grade"] == "fail")
        .map(|own| own["name"].as_str().unwrap())
        .collect()
}

fn texts(report: &Json, name: &str) -> String {
    let checks = report["checks"].as_array().unwrap();
    let check = checks.iter().find(|own| own["name"] == name).unwrap();
    check.to_string()
}

#[test]
fn a_whole_state_goes_on_in_another_process() {
    let report = report("state");
    assert!(failed(&report).is_empty(), "{report:#}");
    assert!(!texts(&report, "exported-states").contains("not in another process"));
}

/// Everything within one process is sound: the table has what the state leaves out.
#[test]
fn what_is_in_a_table_of_the_program_is_missed_elsewhere() {
    let report = report("table");
    assert_eq!(failed(&report), ["exported-states"], "{report:#}");
    let text = texts(&report, "exported-states");
    assert!(
        text.contains("another process goes on otherwise from an imported state"),
        "{text}"
    );
    assert!(!text.contains("an instance at its start"), "{text}");
}

#[test]
fn what_no_state_has_is_missed_everywhere() {
    let report = report("program");
    let failed = failed(&report);
    assert!(failed.contains(&"replay"), "{report:#}");
    assert!(failed.contains(&"exported-states"), "{report:#}");
}
