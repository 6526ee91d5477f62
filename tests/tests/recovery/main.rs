//! Processes that die during a run: workers are replaced and runs are resumed, and no bit of the results is another one.

#![allow(clippy::unwrap_used)]

mod chaos;
mod checkpoints;
mod lost_workers;
mod seen;

use linchpin_tests::process::Workshop;
use linchpin_tests::python::{Python, in_repository, python};

/// The oscillator of two masses.
pub const OSCILLATOR: &str = include_str!("../../../scenes/oscillator.toml");
/// A crank and a rod with slider, which collides, in two workers.
pub const SPLIT: &str = include_str!("../../../scenes/s2/split-slider-crank.toml");
/// Two links on a hinge.
pub const DOUBLE_PENDULUM: &str = include_str!("../../../scenes/double-pendulum.toml");

/// The oscillator scene with the second mass in a worker in plain Python.
pub fn with_python_worker() -> String {
    let Python { interpreter, stubs } = python();
    let worker = in_repository("tests/python/oscillator_worker.py");
    let path = format!("PYTHONPATH={}", stubs.display());
    let command = ["env".into(), path.into(), interpreter.clone(), worker];
    let (first, second) = OSCILLATOR
        .split_once("name = \"mass2\"\nmodel = \"oscillator\"\n")
        .unwrap();
    // The worker has one solver.
    let (parameters, rest) = second
        .split_once("solver = { kind = \"exact\" }\n")
        .unwrap();
    format!("{first}name = \"mass2\"\ncommand = {command:?}\n{parameters}{rest}")
}

/// A folder with `scene.toml`.
pub fn workshop(scene: &str) -> Workshop {
    let workshop = Workshop::new();
    workshop.write("scene.toml", scene);
    workshop
}

/// `run scene.toml --out FOLDER` with settings.
pub fn run(folder: &str, settings: &[&str]) -> Vec<String> {
    let words = [
        "run",
        "scene.toml",
        "--out",
        folder,
        "--no-plots",
        "--quiet",
    ];
    let mut words: Vec<String> = words.map(str::to_owned).into();
    for setting in settings {
        words.extend(["--set".to_owned(), (*setting).to_owned()]);
    }
    words
}

/// The table of an undisturbed run.
pub fn undisturbed(workshop: &Workshop, settings: &[&str]) -> String {
    workshop.run(&run("undisturbed", settings)).succeeds();
    workshop.read("undisturbed/results.csv")
}

/// What `FOLDER/run.json` says.
pub fn report(workshop: &Workshop, folder: &str) -> serde_json::Value {
    serde_json::from_str(&workshop.read(&format!("{folder}/run.json"))).unwrap()
}

/// Workers that took the place of others, and macro steps that they repeated, by the report of a run.
pub fn recoveries(report: &serde_json::Value) -> (u64, u64) {
    let subsystems = report["statistics"]["subsystems"].as_array().unwrap();
    let sum = |key: &str| {
        let own = subsystems.iter();
        own.map(|subsystem| subsystem["recoveries"][key].as_u64().unwrap())
            .sum()
    };
    (sum("workers"), sum("repeated_steps"))
}
