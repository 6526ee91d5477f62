//! A run whose master has ended goes on from its last checkpoint.

use std::fs;

use linchpin_tests::process::Workshop;
use rustix::process::Signal;

use crate::{DOUBLE_PENDULUM, OSCILLATOR, report, run, undisturbed, with_python_worker, workshop};

/// A run that is killed when it has written checkpoints.
#[track_caller]
fn killed(workshop: &Workshop, settings: &[&str]) {
    let mut running = workshop.start(&run("out", settings));
    let previous = workshop.path().join("out/checkpoint.previous");
    running.wait_until("two checkpoints", |_| previous.exists());
    running.send(Signal::KILL);
    running.wait().leaves_no_process();
    workshop.clear();
}

fn resumed(settings: &[&str]) -> Vec<String> {
    [run("out", settings), vec!["--resume".into()]].concat()
}

const EVERY: &str = "run.checkpoint_steps=37";

#[test]
fn a_killed_run_goes_on_without_a_gap_or_a_row_twice() {
    for (scene, settings) in [
        (OSCILLATOR, &["scene.t_end=3", EVERY][..]),
        (
            OSCILLATOR,
            &[
                "scene.t_end=3",
                EVERY,
                "output.every=5",
                "subsystem.*.calls=unary",
            ],
        ),
        (
            DOUBLE_PENDULUM,
            &[
                EVERY,
                "coupling.method=hermite",
                "coupling.tolerance=1e-7",
                "output.interval=1.3e-3",
            ],
        ),
    ] {
        let workshop = workshop(scene);
        let expected = undisturbed(&workshop, settings);
        killed(&workshop, settings);
        // A row that was being written.
        let table = workshop.path().join("out/results.csv");
        let text = workshop.read("out/results.csv");
        fs::write(&table, text + "0.1234,1").unwrap();
        workshop.run(&resumed(settings)).succeeds();
        assert!(workshop.read("out/results.csv") == expected, "{settings:?}");
        let (own, whole) = (report(&workshop, "out"), report(&workshop, "undisturbed"));
        assert!(own["resumed_at"].as_f64().unwrap() > 0.0);
        assert_eq!(own["status"], "done");
        for count in [
            "macro_steps",
            "joints",
            "verdicts",
            "corrections",
            "integrations_by_cause",
        ] {
            let [own, whole] = [&own, &whole].map(|report| &report["statistics"][count]);
            assert!(!whole.is_null(), "{count}");
            // The look-ahead over the next step was asked for once more.
            if count != "integrations_by_cause" {
                assert_eq!(own, whole, "{count} {settings:?}");
            }
        }
        assert!(!workshop.path().join("out/checkpoint").exists());
    }
}

/// What pictures, error norms and animation show of a resumed run is what they show of a whole one.
#[test]
fn what_a_run_tells_at_its_end_does_not_depend_on_where_it_went_on() {
    let workshop = workshop(OSCILLATOR);
    let settings = ["scene.t_end=2", EVERY];
    let told = |folder: &str, more: &[&str]| {
        let mut words = run(folder, &settings);
        words.retain(|word| word != "--no-plots" && word != "--quiet");
        words.extend(more.iter().map(ToString::to_string));
        words
    };
    workshop
        .run(&told("undisturbed", &["--animate"]))
        .succeeds();
    let mut running = workshop.start(&told("out", &["--animate"]));
    let previous = workshop.path().join("out/checkpoint.previous");
    running.wait_until("two checkpoints", |_| previous.exists());
    running.send(Signal::KILL);
    running.wait();
    workshop.clear();
    workshop
        .run(&told("out", &["--animate", "--resume"]))
        .succeeds();
    for file in ["results.csv", "results.svg", "animation.html"] {
        let [own, whole] =
            ["out", "undisturbed"].map(|folder| workshop.read(&format!("{folder}/{file}")));
        assert!(own == whole, "{file}");
    }
    let errors = |folder: &str| report(&workshop, folder)["errors"].clone();
    assert!(!errors("out").is_null());
    assert_eq!(errors("out"), errors("undisturbed"));
}

#[test]
fn a_damaged_checkpoint_is_told_and_the_one_before_serves() {
    let workshop = workshop(OSCILLATOR);
    let settings = ["scene.t_end=3", EVERY];
    let expected = undisturbed(&workshop, &settings);
    killed(&workshop, &settings);
    let newest = workshop.path().join("out/checkpoint");
    let whole = fs::read(&newest).unwrap();
    let mut flipped = whole.clone();
    let place = flipped.len() / 2;
    flipped[place] ^= 16;
    fs::write(&newest, &flipped).unwrap();
    workshop.run(&resumed(&settings)).succeeds().says(&[
        "warning",
        "newest checkpoint cannot be used",
        "the one before",
    ]);
    assert!(workshop.read("out/results.csv") == expected);

    // Without the one before.
    killed(&workshop, &settings);
    let whole = fs::read(&newest).unwrap();
    fs::remove_file(workshop.path().join("out/checkpoint.previous")).unwrap();
    let mut other_format = whole.clone();
    other_format[20] = 99;
    for (bytes, words) in [
        (
            &flipped[..],
            &["out/checkpoint is damaged", "checksum", "without --resume"][..],
        ),
        (
            &whole[..whole.len() - 3],
            &["is damaged", "bytes of content instead of"],
        ),
        (&whole[..25], &["is damaged", "within its header"]),
        (
            b"t,x\n0,1\n",
            &["is damaged", "does not begin as a checkpoint"],
        ),
        (b"", &["is damaged"]),
        (&other_format, &["has format 99", "reads format 1"]),
    ] {
        fs::write(&newest, bytes).unwrap();
        workshop.run(&resumed(&settings)).fails(1, words);
    }
}

#[test]
fn what_cannot_be_resumed_is_refused_and_nothing_is_touched() {
    let workshop = workshop(OSCILLATOR);
    let settings = ["scene.t_end=3", EVERY];
    workshop
        .run(&resumed(&settings))
        .fails(2, &["there is no checkpoint in out", "--resume"]);
    killed(&workshop, &settings);
    let table = workshop.read("out/results.csv");
    let refuses = |words: &[String], told: &[&str]| {
        workshop.run(words).fails(2, told);
        assert!(workshop.read("out/results.csv") == table);
    };
    refuses(
        &resumed(&["scene.t_end=4", EVERY]),
        &["another run", "scene.t_end=3", "scene.t_end=4"],
    );
    refuses(&resumed(&[]), &["this one is with no --set"]);
    let animated = [resumed(&settings), vec!["--animate".into()]].concat();
    refuses(&animated, &["--animate"]);
    workshop.write("scene.toml", OSCILLATOR.to_owned() + "# changed\n");
    refuses(&resumed(&settings), &["the scene file has changed"]);
    workshop.write("scene.toml", OSCILLATOR);
    let path = workshop.path().join("out/results.csv");
    fs::write(&path, &table[..table.len() / 20]).unwrap();
    workshop
        .run(&resumed(&settings))
        .fails(1, &["out/results.csv has", "rows are missing"]);
    let (head, rest) = table.split_once('\n').unwrap();
    fs::write(&path, format!("{head}\nx{}", &rest[1..])).unwrap();
    workshop
        .run(&resumed(&settings))
        .fails(1, &["out/results.csv:2: column ", "which is no number"]);
}

/// A worker whose states stay inside it: that there are no checkpoints is told once, and the run goes on.
#[test]
fn a_run_without_checkpoints_says_so() {
    let workshop = workshop(&with_python_worker());
    let outcome = workshop.run(&run("out", &["scene.t_end=0.2", EVERY]));
    outcome.succeeds().says(&[
        "warning",
        "\"mass2\" at t = 0.037 s: its state cannot be exported",
        "begins at its start again",
    ]);
    assert_eq!(
        outcome.stderr.matches("cannot be exported").count(),
        1,
        "{outcome}"
    );
    assert!(!workshop.path().join("out/checkpoint").exists());
}

/// A folder stands where a new checkpoint is written: the run goes on, says so, and the one before stays.
#[test]
fn a_checkpoint_that_cannot_be_written_is_told_and_the_run_goes_on() {
    let workshop = workshop(OSCILLATOR);
    let mut running = workshop.start(&run("out", &["scene.t_end=3", EVERY]));
    running.wait_for_rows("out");
    let in_the_way = workshop.path().join("out/checkpoint.unfinished");
    // It may stand there for a moment.
    running.wait_until("a folder in the way", |_| {
        fs::create_dir(&in_the_way).is_ok()
    });
    running.wait_until("a warning", |running| {
        running.stderr().contains("no checkpoint")
    });
    fs::remove_dir(&in_the_way).unwrap();
    let outcome = running.wait();
    outcome.succeeds().says(&[
        "warning",
        "no checkpoint at t = ",
        "cannot write to out",
        "still serves",
    ]);
}

#[test]
fn cases_go_on_where_they_stopped() {
    let case = |name: &str, c: &str| {
        format!(
            "\n[[case]]\nname = \"{name}\"\n[case.set]\n\"subsystem.mass1.parameters.c\" = {c}\n"
        )
    };
    let cases = case("soft", "500.0") + &case("hard", "2000.0");
    let workshop = workshop(&(OSCILLATOR.to_owned() + &cases));
    let settings = ["scene.t_end=2", EVERY];
    workshop.run(&run("undisturbed", &settings)).succeeds();
    let mut running = workshop.start(&run("out", &settings));
    let previous = workshop.path().join("out/hard/checkpoint.previous");
    running.wait_until("checkpoints of the second case", |_| previous.exists());
    running.send(Signal::KILL);
    running.wait();
    workshop.clear();
    workshop.run(&resumed(&settings)).succeeds();
    for case in ["soft", "hard"] {
        let [own, whole] = ["out", "undisturbed"]
            .map(|folder| workshop.read(&format!("{folder}/{case}/results.csv")));
        assert!(own == whole, "{case}");
    }
    assert!(
        report(&workshop, "out/hard")["resumed_at"]
            .as_f64()
            .is_some()
    );
}
