//! Studies that are ended early keep what they have found, and say what is missing.

use std::time::Duration;

use linchpin_tests::process::{Outcome, Workshop};
use rustix::process::Signal;
use serde_json::Value;

use crate::{exists, workshop};

/// Far longer than the short points of a study take, and far shorter than the long ones.
const WHILE: Duration = Duration::from_secs(4);

/// Starts a study in `out` and sends it a signal after a while.
fn interrupted(workshop: &Workshop, arguments: &[&str], signal: Signal) -> (Outcome, Value) {
    let mut command = workshop.command(&[arguments, &["--out", "out"]].concat());
    command.env("RAYON_NUM_THREADS", "2");
    let mut running = workshop.start_command(command);
    running.wait_until("the status", |_| exists(workshop, "out/run.json"));
    assert_eq!(status(workshop)["status"], "running");
    std::thread::sleep(WHILE);
    running.send(signal);
    let outcome = running.wait();
    (outcome, status(workshop))
}

fn status(workshop: &Workshop) -> Value {
    serde_json::from_str(&workshop.read("out/run.json")).unwrap()
}

fn strings(value: &Value) -> Vec<&str> {
    let list = value.as_array().unwrap();
    list.iter().map(|own| own.as_str().unwrap()).collect()
}

#[test]
fn a_convergence_study() {
    let workshop = workshop(&[]);
    let steps = [
        "converge",
        "scene.toml",
        "--macro-steps",
        "2e-2,1e-2,5e-3,1e-9",
    ];
    let (outcome, status) = interrupted(&workshop, &steps, Signal::INT);
    outcome.fails(130, &["interrupted"]);
    assert_eq!(status["status"], "interrupted", "{status}");
    assert_eq!(status["study"], "converge");
    assert_eq!(strings(&status["missing"]), ["oscillator, H = 1e-9 s"]);
    assert!(strings(&status["results"]).contains(&"converge.csv"));
    let table = workshop.read("out/converge.csv");
    let endings: Vec<&str> = { table.lines().skip(1) }
        .map(|line| line.split(',').nth(2).unwrap())
        .collect();
    assert_eq!(endings, ["done", "done", "done", "missing"]);
    assert!(exists(&workshop, "out/converge.svg"));
}

#[test]
fn a_map_of_stability() {
    let workshop = workshop(&[]);
    let axes = [
        "stability",
        "scene.toml",
        "--x",
        "subsystem.*.parameters.c=1e2:1e3:3:log",
        "--y",
        "coupling.macro_step=1e-9:1e-2:2:log",
    ];
    let (outcome, status) = interrupted(&workshop, &axes, Signal::TERM);
    outcome.fails(143, &["interrupted"]);
    assert_eq!(status["status"], "interrupted", "{status}");
    let missing = strings(&status["missing"]);
    for stiffness in ["100", "316.2", "1000"] {
        let endless = format!("oscillator, point ({stiffness}, 1e-9)");
        assert!(missing.contains(&&*endless), "{missing:?}");
    }
    let rows = workshop.read("out/stability.csv").lines().count() - 1;
    assert_eq!(rows + missing.len(), 6);
    assert!(
        rows > 0
            && outcome
                .stdout
                .contains(&format!("{} missing", missing.len())),
        "{outcome}"
    );
}

#[test]
fn a_report() {
    // Nothing to compare with but the closed form, and far more to do than there is time.
    let workshop = workshop(&[
        ("[monolithic]", "[output] #"),
        ("t_end = 1.0", "t_end = 1e5"),
    ]);
    let text = workshop.read("scene.toml");
    let (scene, _) = text.split_once("[output] #").unwrap();
    workshop.write("scene.toml", scene);
    let (outcome, status) = interrupted(&workshop, &["report", "scene.toml"], Signal::HUP);
    outcome.fails(129, &["interrupted"]);
    assert_eq!(status["status"], "interrupted", "{status}");
    assert!(!strings(&status["missing"]).is_empty());
}

#[test]
fn a_study_that_comes_to_its_end_misses_nothing() {
    let workshop = workshop(&[]);
    workshop
        .run(&[
            "converge",
            "scene.toml",
            "--macro-steps",
            "2e-2,1e-2",
            "--out",
            "out",
        ])
        .succeeds();
    let status = status(&workshop);
    assert_eq!(status["status"], "done", "{status}");
    assert!(strings(&status["missing"]).is_empty());
    for file in strings(&status["results"]) {
        assert!(exists(&workshop, &format!("out/{file}")), "{file}");
    }
}
