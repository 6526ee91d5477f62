//! What becomes of results.

use std::os::unix::fs::symlink;
use std::time::Duration;

use linchpin_tests::process::{Peer, Workshop};
use linchpin_tests::scripted::Act;
use rustix::process::Signal;
use serde_json::Value;

use crate::{exists, rows, run, workshop};

#[test]
fn a_mistake_spoils_no_earlier_results() {
    let workshop = workshop(&[]);
    workshop
        .run(&["run", "scene.toml", "--out", "out"])
        .succeeds();
    let before = workshop.read("out/results.csv");
    for setting in [
        "subsystem.mass2.parameters.m=-1",
        "subsystem.mass1.parameters.x0=1",
    ] {
        workshop.run(&run(&["--set", setting])).fails(2, &[]);
    }
    assert_eq!(workshop.read("out/results.csv"), before);
    assert!(exists(&workshop, "out/run.json") && exists(&workshop, "out/results.svg"));
}

/// What `run.json` in a folder says.
fn report(workshop: &Workshop, folder: &str) -> Value {
    serde_json::from_str(&workshop.read(&format!("{folder}/run.json"))).unwrap()
}

#[test]
fn a_run_that_fails_leaves_nothing_of_an_earlier_one() {
    let workshop = workshop(&[]);
    workshop
        .run(&["run", "scene.toml", "--out", "out"])
        .succeeds();
    assert_eq!(report(&workshop, "out")["status"], "done");
    let settings = [
        "--set",
        "coupling.method=penalty",
        "--set",
        "coupling.stiffness=1e9",
    ];
    let outcome = workshop.run(&run(&settings));
    outcome.fails(1, &["diverged"]);
    let rows = rows(&workshop);
    assert!(rows.len() < 1001);
    for name in ["results.svg", "results.png"] {
        assert!(
            !exists(&workshop, &format!("out/{name}")),
            "{name} is that of the earlier run"
        );
    }
    let report = report(&workshop, "out");
    assert_eq!(report["status"], "failed");
    assert!(
        report["reason"]
            .as_str()
            .unwrap()
            .contains("diverged at t = ")
    );
    assert_eq!(report["statistics"]["macro_steps"], rows.len() as u64 - 1);
}

/// The picture of a run that fails shows how it came to that.
#[test]
fn a_run_that_diverges_is_drawn() {
    let workshop = workshop(&[]);
    let diverging = [
        "--set",
        "coupling.method=penalty",
        "--set",
        "coupling.stiffness=1e9",
    ];
    let arguments = ["run", "scene.toml", "--out", "out"];
    workshop
        .run(&[&arguments[..], &diverging].concat())
        .fails(1, &["diverged"]);
    for name in ["results.csv", "run.json", "results.svg", "results.png"] {
        assert!(exists(&workshop, &format!("out/{name}")), "{name}");
    }
}

/// A macro step of half a period gives a motion that is several times as large as the true one.
#[test]
fn a_run_that_is_wrong_says_so_even_when_it_is_quiet() {
    let workshop = workshop(&[]);
    let hermite = ["--quiet", "--set", "coupling.method=hermite"];
    let of_step = |step: &str| {
        let step = format!("coupling.macro_step={step}");
        let outcome = workshop.run(&run(&[&hermite[..], &["--set", &step]].concat()));
        let warnings = report(&workshop, "out")["warnings"].clone();
        let warnings = warnings.as_array().unwrap();
        let texts: Vec<String> = warnings
            .iter()
            .map(|own| own.as_str().unwrap().to_owned())
            .collect();
        (outcome, texts)
    };
    let (outcome, texts) = of_step("0.25");
    assert!(!texts.is_empty());
    for text in &texts {
        assert!(
            text.contains("of the motion") && text.contains("coupling.macro_step"),
            "{text}"
        );
        assert!(
            outcome.stderr.contains(&format!("warning: {text}")),
            "{}",
            outcome.stderr
        );
    }
    let (outcome, texts) = of_step("1e-2");
    assert!(
        texts.is_empty() && outcome.stderr.is_empty(),
        "{texts:?} {}",
        outcome.stderr
    );
}

#[test]
fn a_run_that_does_not_start_leaves_its_reason_or_nothing_new() {
    let workshop = workshop(&[]);
    let wrong = ["--set", "subsystem.mass2.parameters.m=-1"];
    workshop.run(&run(&wrong)).fails(2, &["-1"]);
    let first = report(&workshop, "out");
    assert_eq!(first["status"], "failed");
    assert!(first["statistics"].is_null() && !exists(&workshop, "out/results.csv"));
    workshop.run(&run(&[])).succeeds();
    let before = workshop.read("out/run.json");
    workshop.run(&run(&wrong)).fails(2, &["-1"]);
    assert_eq!(workshop.read("out/run.json"), before);
}

#[test]
fn a_disk_that_is_full() {
    let workshop = workshop(&[]);
    std::fs::create_dir(workshop.path().join("out")).unwrap();
    symlink("/dev/full", workshop.path().join("out/results.csv")).unwrap();
    workshop
        .run(&["run", "scene.toml", "--out", "out"])
        .fails(1, &["out/results.csv", "No space left"]);
    let report = report(&workshop, "out");
    assert_eq!(report["status"], "failed");
    assert!(report["reason"].as_str().unwrap().contains("No space left"));
    assert!(
        exists(&workshop, "out/results.svg"),
        "the rows that there were are drawn"
    );
}

#[test]
fn a_folder_has_one_writer() {
    let workshop = workshop(&[("t_end = 1.0", "t_end = 10000.0")]);
    let mut first = workshop.start(&run(&[]));
    first.wait_for_rows("out");
    let holder = format!("process {} on ", first.id());
    let short = ["--set", "scene.t_end=0.01", "--set", "output.every=1"];
    let commands = [
        run(&short),
        run(&[&short[..], &["--in-process"]].concat()),
        vec![
            "converge",
            "scene.toml",
            "--macro-steps",
            "1e-3,2e-3",
            "--out",
            "out",
        ],
    ];
    for command in commands {
        // The outputs of both go to the same files of the workshop.
        let second = workshop.command(&command).output().unwrap();
        let said = String::from_utf8_lossy(&second.stderr);
        assert_eq!(second.status.code(), Some(1), "{said}");
        for words in ["out is in use by", &holder, "--out"] {
            assert!(said.contains(words), "{said}");
        }
    }
    first.send(Signal::TERM);
    first.wait().fails(143, &[]);
    let times: Vec<f64> = rows(&workshop).iter().map(|row| row[0]).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    workshop.run(&run(&short)).succeeds();
    assert_eq!(rows(&workshop).len(), 11);
}

/// The lock of a process that was killed is gone with it.
#[test]
fn a_killed_run_holds_nobody_up() {
    let workshop = workshop(&[("t_end = 1.0", "t_end = 10000.0")]);
    let mut first = workshop.start(&run(&[]));
    first.wait_for_rows("out");
    first.send(Signal::KILL);
    first.wait().leaves_no_process();
    assert_eq!(report(&workshop, "out")["status"], "running");
    workshop
        .run(&run(&["--set", "scene.t_end=0.01"]))
        .exits_with(0);
    assert_eq!(report(&workshop, "out")["status"], "done");
    assert!(!exists(&workshop, "out/.linchpin-lock"));
}

/// A row stays in memory for a second at most, even where no other follows.
#[test]
fn rows_are_there_while_a_long_step_is_under_way() {
    let workshop = workshop(&[]);
    let hang = Act::Wait(Duration::from_secs(60));
    let peer = Peer::scripted(&workshop, |peer| peer.at_exchange(7, hang));
    let address = format!("subsystem.mass2.address={}", peer.address());
    let settings = ["--set", &address, "--set", "coupling.jacobian=every-step"];
    let mut running = workshop.start(&run(&settings));
    running.wait_until("all rows before the long step", |_| {
        let text = std::fs::read_to_string(workshop.path().join("out/results.csv"));
        text.is_ok_and(|text| text.lines().count() == 8 && text.ends_with('\n'))
    });
    running.send(Signal::TERM);
    running.wait().fails(143, &["interrupted at t = 0.006 s"]);
}

#[test]
fn the_report_says_who_ran_what_and_in_which_units() {
    let workshop = workshop(&[]);
    workshop
        .run(&run(&["--set", "scene.t_end=0.01"]))
        .succeeds();
    let report = report(&workshop, "out");
    let text = |key: &str| report[key].as_str().unwrap().to_owned();
    assert_eq!(text("linchpin"), env!("CARGO_PKG_VERSION"));
    assert!(!text("commit").is_empty() && !text("host").is_empty());
    let started = text("started");
    assert!(
        started.starts_with("20") && started.ends_with('Z') && started.len() == 20,
        "{started}"
    );
    assert_eq!(report["command"][1], "run");
    assert_eq!(report["models"][1]["subsystem"], "mass2");
    assert_eq!(report["models"][1]["model"], "oscillator");
    let table = workshop.read("out/results.csv");
    let names: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let columns = report["columns"].as_array().unwrap();
    let told: Vec<&str> = columns
        .iter()
        .map(|own| own["name"].as_str().unwrap())
        .collect();
    assert_eq!(told, names);
    for (name, unit) in [
        ("t", "s"),
        ("mass1.x", "m"),
        ("mass2.v", "m/s"),
        ("link.lambda", "N"),
        ("link.residual.position", "m"),
        ("link.residual.velocity", "m/s"),
    ] {
        let own = columns.iter().find(|own| own["name"] == name).unwrap();
        assert_eq!(own["unit"], unit, "{name}");
    }
}

/// Equal masses on equal springs: the multiplier is 0, and so is its error.
#[test]
fn an_error_of_nothing_is_no_nan() {
    for (changes, at_rest) in [
        (
            &[
                ("v0 = 100.0", "v0 = 0.0"),
                (
                    "m = 2.0, c = 1000.0, d = 10.0, x0 = 0.0, v0 = 100.0",
                    "m = 7.0",
                ),
            ][..],
            true,
        ),
        (&[("m = 2.0", "m = 1.0")], false),
    ] {
        let workshop = workshop(changes);
        let outcome = workshop.run(&run(&["--set", "scene.t_end=0.05"]));
        outcome.succeeds();
        assert!(
            !outcome.stdout.contains("NaN") && !outcome.stdout.contains("inf "),
            "{outcome}"
        );
        let report = report(&workshop, "out");
        let errors = report["errors"].as_array().unwrap();
        assert!(!errors.is_empty());
        for error in errors {
            let is_exact = error["largest"] == 0.0;
            assert!(is_exact || !at_rest, "{error}");
            assert!(!is_exact || error["normalised"] == 0.0, "{error}");
        }
    }
}

#[test]
fn the_report_holds_the_scene_that_was_run() {
    let workshop = workshop(&[("t_end = 1.0", "t_end = 50.0")]);
    let text = workshop.read("scene.toml");
    let mut running = workshop.start(&run(&["--in-process"]));
    running.wait_for_rows("out");
    workshop.write("scene.toml", "# overwritten while the run is under way");
    running.wait().succeeds();
    let report: serde_json::Value = serde_json::from_str(&workshop.read("out/run.json")).unwrap();
    assert_eq!(report["scene_text"], text);
}

/// Steps of 0.1 s are too long for the weighted method: one of twenty is poor, and the errors are told.
const TOO_LONG: [&str; 6] = [
    "--set",
    "coupling.method=weighted",
    "--set",
    "coupling.macro_step=0.1",
    "--set",
    "scene.t_end=2",
];

fn double_pendulum() -> Workshop {
    let workshop = Workshop::new();
    let text = std::fs::read_to_string("../scenes/double-pendulum.toml").unwrap();
    workshop.write("scene.toml", text);
    workshop
}

#[test]
fn more_poor_steps_than_a_scene_allows_are_a_failure_behind_results() {
    let workshop = double_pendulum();
    let allowed = workshop.run(&run(&TOO_LONG));
    allowed.succeeds().says(&["1 of 20 macro steps are poor"]);
    let refused = workshop.run(&run(
        &[&TOO_LONG[..], &["--set", "run.most_poor=0.04"]].concat()
    ));
    refused.fails(
        1,
        &[
            "1 of 20",
            "0.050",
            "run.most_poor allows 0.04",
            "macro_step",
        ],
    );
    let report = report(&workshop, "out");
    assert_eq!(report["status"], "failed");
    assert_eq!(report["statistics"]["verdicts"]["poor"], 1);
    assert_eq!(rows(&workshop).len(), 21);
    for share in ["-0.1", "1.5"] {
        let setting = format!("run.most_poor={share}");
        let outcome = workshop.run(&run(&["--set", &setting]));
        outcome.fails(2, &["most_poor", "from 0 to 1"]);
    }
}

#[test]
fn strict_runs_take_no_warning_against_their_results() {
    let workshop = double_pendulum();
    let strict = |more: &[&str]| workshop.run(&run(&[&["--strict"], more].concat()));
    strict(&TOO_LONG).fails(
        1,
        &["1 of 20 macro steps are poor", "--strict", "3 warnings"],
    );
    assert_eq!(rows(&workshop).len(), 21);
    strict(&["--set", "scene.t_end=0.2"]).succeeds();
}
