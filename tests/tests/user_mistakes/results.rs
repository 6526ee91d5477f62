//! What becomes of results.

use std::os::unix::fs::symlink;

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

#[test]
fn a_run_that_fails_leaves_nothing_of_an_earlier_one() {
    let workshop = workshop(&[]);
    workshop
        .run(&["run", "scene.toml", "--out", "out"])
        .succeeds();
    let settings = [
        "--set",
        "coupling.method=penalty",
        "--set",
        "coupling.stiffness=1e9",
    ];
    workshop.run(&run(&settings)).fails(1, &["diverged"]);
    assert!(rows(&workshop).len() < 1001);
    for name in ["run.json", "results.svg", "results.png"] {
        assert!(
            !exists(&workshop, &format!("out/{name}")),
            "{name} is that of the earlier run"
        );
    }
}

#[test]
fn a_disk_that_is_full() {
    let workshop = workshop(&[]);
    std::fs::create_dir(workshop.path().join("out")).unwrap();
    symlink("/dev/full", workshop.path().join("out/results.csv")).unwrap();
    workshop
        .run(&run(&[]))
        .fails(1, &["out/results.csv", "No space left"]);
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
