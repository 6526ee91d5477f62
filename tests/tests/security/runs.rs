//! Runs whose workers are reached by TLS: the bits of a run without.

use std::path::PathBuf;

use linchpin_tests::process::Workshop;
use linchpin_tests::python::{Program, in_repository};
use rustix::process::Signal;

use crate::{Worker, certified, free_port};

const OSCILLATOR: &str = include_str!("../../../scenes/oscillator.toml");

fn run(workshop: &Workshop, name: &str, settings: &[String]) -> Vec<String> {
    workshop.write("scene.toml", OSCILLATOR);
    let mut words: Vec<String> = ["run", "scene.toml", "--out", name, "--no-plots", "--quiet"]
        .map(str::to_owned)
        .into();
    words.extend(
        settings
            .iter()
            .flat_map(|own| ["--set".to_owned(), own.clone()]),
    );
    words
}

fn worker_folder(workshop: &Workshop, name: &str) -> PathBuf {
    workshop.path().join("certificates/workers").join(name)
}

/// Settings of a run with these workers.
fn over_tls(addresses: [&str; 2]) -> Vec<String> {
    vec![
        "security.certificates=certificates/master".to_owned(),
        format!("subsystem.mass1.address={}", addresses[0]),
        format!("subsystem.mass2.address={}", addresses[1]),
    ]
}

#[test]
fn the_results_are_those_of_a_run_without_tls() {
    let workshop = certified();
    workshop.run(&run(&workshop, "plain", &[])).succeeds();
    let expected = workshop.read("plain/results.csv");
    let workers = ["mass1", "mass2"].map(|name| Worker::start(&worker_folder(&workshop, name)));
    let settings = over_tls([&workers[0].address, &workers[1].address]);
    for (name, more) in [
        ("stream", None),
        ("unary", Some("subsystem.*.calls=unary".to_owned())),
    ] {
        let settings: Vec<String> = settings.iter().cloned().chain(more).collect();
        workshop.run(&run(&workshop, name, &settings)).succeeds();
        assert!(
            workshop.read(&format!("{name}/results.csv")) == expected,
            "{name}"
        );
    }
}

/// One of them in Python: the results are those over its Unix socket.
#[test]
fn a_worker_of_the_python_sdk_speaks_tls_too() {
    let workshop = certified();
    let worker = worker_folder(&workshop, "mass2");
    let (encrypted, own) = (Worker::in_python(&worker), Worker::start(&worker));
    let models = in_repository("worker/python/tests/models.py");
    let elsewhere = Workshop::new();
    let socket = elsewhere.path().join("python.sock");
    let plain = Program::start(&models, &in_repository("worker/python/src"), &socket);
    let scene = OSCILLATOR.replace("solver = { kind = \"exact\" }", "");
    let table = |name: &str, addresses: [&str; 2]| {
        let command = run(&workshop, name, &over_tls(addresses));
        workshop.write("scene.toml", &scene);
        workshop.run(&command).succeeds();
        workshop.read(&format!("{name}/results.csv"))
    };
    let expected = table("plain", [&own.address, plain.address()]);
    assert!(table("tls", [&own.address, &encrypted.address]) == expected);
    // It demands a certificate of its masters, and says what is wrong with its own.
    let stranger = certified();
    let ask = [
        "describe",
        &encrypted.address,
        "--certificates",
        "certificates/master",
    ];
    stranger
        .run(&ask)
        .fails(1, &[&encrypted.address, "another authority"]);
    let alone = ["describe", &encrypted.address];
    stranger.run(&alone).fails(1, &["takes certificates"]);
}

#[test]
fn a_worker_that_was_killed_is_replaced() {
    let workshop = certified();
    let long = "scene.t_end=6".to_owned();
    workshop
        .run(&run(&workshop, "plain", std::slice::from_ref(&long)))
        .succeeds();
    let expected = workshop.read("plain/results.csv");
    let port = free_port();
    let folder = worker_folder(&workshop, "mass1");
    let killed = Worker::start_at(port, &folder);
    let stays = Worker::start(&worker_folder(&workshop, "mass2"));
    let mut settings = over_tls([&killed.address, &stays.address]);
    settings.push(long);
    let mut running = workshop.start(&run(&workshop, "out", &settings));
    let table = workshop.path().join("out/results.csv");
    let third = expected.len() as u64 / 3;
    running.wait_until("a third of the rows", |_| {
        table.metadata().is_ok_and(|own| own.len() > third)
    });
    killed.running().send(Signal::KILL);
    drop(killed);
    let _again = Worker::start_at(port, &folder);
    running.wait().exits_with(0).says(&["mass1", "lost"]);
    assert!(workshop.read("out/results.csv") == expected);
}

#[test]
fn a_worker_that_is_not_trusted_ends_the_run_at_its_start() {
    let workshop = certified();
    let strange = certified();
    let own = Worker::start(&worker_folder(&workshop, "mass1"));
    let strange = Worker::start(&worker_folder(&strange, "mass2"));
    let settings = over_tls([&own.address, &strange.address]);
    let outcome = workshop.run(&run(&workshop, "out", &settings));
    outcome.fails(
        1,
        &[
            "mass2",
            &strange.address,
            "another authority than ca.crt",
            "one linchpin certificates",
        ],
    );
    let mut lost = settings;
    lost[0] = "security.certificates=nowhere".to_owned();
    workshop
        .run(&run(&workshop, "out", &lost))
        .fails(1, &["nowhere/ca.crt", "linchpin certificates"]);
}
