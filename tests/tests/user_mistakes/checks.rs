//! What `check` finds before anything is run.

use std::path::{Path, PathBuf};

use crate::{check, run, workshop};

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

/// Connections and joints to workers that cannot be asked: what can be told is told, of the right model.
#[test]
fn workers_elsewhere_on_either_side_of_a_connection() {
    let workshop = workshop(&[]);
    let files: Vec<PathBuf> = { std::fs::read_dir(scenes().join("motor")).unwrap() }
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .collect();
    assert!(!files.is_empty());
    for file in &files {
        let file = file.to_str().unwrap();
        let scene = linchpin_master::scene::load(Path::new(file), &[]).unwrap();
        let all = ["*".to_owned()];
        let names = scene.subsystems.iter().map(|own| own.name.clone());
        for name in names.chain(all) {
            let elsewhere = format!("subsystem.{name}.address=\"http://127.0.0.1:9\"");
            workshop
                .run(&["check", file, "--set", &elsewhere])
                .succeeds()
                .prints(&["ok as far as it can be told without the workers of"]);
        }
    }
}

#[test]
fn a_wrong_end_of_a_connection_beside_a_worker_elsewhere() {
    let text = "[scene]\nname = \"pair\"\nt_end = 1.0\n[coupling]\nmethod = \"weighted\"\nmacro_step = 0.01\n\
                [[subsystem]]\nname = \"there\"\nmodel = \"anything\"\naddress = \"http://127.0.0.1:9\"\n\
                [[subsystem]]\nname = \"here\"\nmodel = \"oscillator\"\nparameters = { m = 3.0, c = 70.0 }\n\
                [[connection]]\nname = \"signal\"\nfrom = \"there.out\"\nto = \"here.forse\"\n";
    let workshop = workshop(&[]);
    workshop.write("scene.toml", text);
    workshop.run(&check(&[])).fails(
        2,
        &[
            "connection.signal.to",
            "model \"oscillator\" has no input \"forse\"",
        ],
    );
    workshop.write("scene.toml", text.replace("here.forse", "here.f"));
    workshop.run(&check(&[])).succeeds();
    let wrong = "joint.link.b=\"here.tip\"";
    let joint = "[[joint]]\nname = \"link\"\nkind = \"rigid-link\"\na = \"there\"\nb = \"here\"\n";
    workshop.write("scene.toml", text.replace("here.forse", "here.f") + joint);
    workshop.run(&check(&["--set", wrong])).fails(
        2,
        &["joint.link.b", "model \"oscillator\" has no marker \"tip\""],
    );
}

#[test]
fn so_many_rows_or_steps_that_no_run_would_end() {
    let workshop = workshop(&[]);
    for (settings, words) in [
        (
            &["output.interval=1e-300"][..],
            &["output.interval", "1e300"][..],
        ),
        (
            &["output.interval=5e-11"],
            &["output.interval", "2e10 steps or rows"],
        ),
        (
            &["coupling.macro_step=1e-10"],
            &["coupling.macro_step", "1e10", "1e-9 s or more"],
        ),
        (
            &["scene.t_end=3e7", "coupling.macro_step=0.01"],
            &["3e9", "0.03 s or more"],
        ),
        (
            &["converge.macro_steps=[1e-2,1e-12]"],
            &["converge.macro_steps", "1e12"],
        ),
    ] {
        let settings: Vec<&str> = settings.iter().flat_map(|own| ["--set", own]).collect();
        for command in [check(&settings), run(&settings)] {
            workshop
                .run(&command)
                .fails(2, &[words, &["at most 1e9 are allowed"]].concat());
        }
    }
    // The scale is that of the scene.
    let tiny = [
        "--set",
        "scene.t_end=1e-12",
        "--set",
        "coupling.macro_step=1e-15",
        "--set",
        "output.interval=1e-14",
    ];
    workshop.run(&check(&tiny)).succeeds();
}

#[test]
fn an_address_without_a_port() {
    let workshop = workshop(&[]);
    for address in [
        "http://localhost",
        "http://10.0.0.7/",
        "http://[::1]",
        "http://host:0",
    ] {
        let setting = format!("subsystem.mass1.address=\"{address}\"");
        workshop
            .run(&check(&["--set", &setting]))
            .fails(2, &["subsystem.mass1.address", address, "http://HOST:PORT"]);
    }
}

#[test]
fn subsystems_that_nothing_holds_together() {
    let workshop = workshop(&[("[[joint]]", "[ignored]\n[[joint]]")]);
    let text = workshop.read("scene.toml");
    let (before, behind) = text.split_once("[ignored]").unwrap();
    let (_, behind) = behind.split_once("[monolithic]").unwrap();
    let (_, output) = behind.split_once("[output]").unwrap();
    workshop.write("scene.toml", format!("{before}[output]{output}"));
    workshop.run(&check(&[])).succeeds().says(&[
        "warning:",
        "the scene falls apart",
        "2 groups of subsystems together: mass1 | mass2",
    ]);
}

#[test]
fn a_study_is_checked_as_one() {
    let workshop = workshop(&[]);
    let study = scenes().join("report.toml");
    let study = study.to_str().unwrap();
    workshop
        .run(&["check", study])
        .succeeds()
        .prints(&["linchpin report runs it"]);
    for command in ["run", "converge", "stability"] {
        workshop
            .run(&[command, study])
            .fails(2, &["is a study and no scene", "linchpin report"]);
    }
    workshop
        .run(&["check", study, "--set", "scene.t_end=1"])
        .fails(2, &["--set changes scenes", "is a study"]);
}

#[test]
fn numbers_in_messages_are_short() {
    let workshop = workshop(&[]);
    let third = "scene.t_end=0.33333333333333331";
    let outcome = workshop.run(&check(&[
        "--set",
        third,
        "--set",
        "coupling.macro_step=0.66666666666666663",
    ]));
    outcome.fails(
        2,
        &[
            "coupling.macro_step` = 0.6667 s",
            "t_end - t_start = 0.333333333 s",
        ],
    );
}
