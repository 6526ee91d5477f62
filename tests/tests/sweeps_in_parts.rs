//! Studies in parts: together they are the study, and Slurm does them as a job array.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use linchpin_tests::process::Workshop;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()
        .unwrap()
}

fn scene(name: &str) -> String {
    repository().join("scenes").join(name).display().to_string()
}

/// A study of a shipped scene that takes seconds, and the files that it writes.
struct Study {
    arguments: Vec<String>,
    files: &'static [&'static str],
}

/// 21 points of a linear scene, some of them unstable.
fn map() -> Study {
    let scene = scene("oscillator.toml");
    let arguments = [
        "stability",
        &scene,
        "--x",
        "subsystem.*.parameters.c=1e1:1e8:7:log",
        "--y",
        "subsystem.*.parameters.d=1e-1:1e5:3:log",
        "--set",
        "scene.t_end=0.2",
    ];
    Study {
        arguments: arguments.map(str::to_owned).to_vec(),
        files: &["stability.csv", "stability.svg"],
    }
}

/// Three runs that are compared with the finest one, which diverges where H is too large.
fn orders() -> Study {
    let scene = scene("oscillator.toml");
    let arguments = [
        "converge",
        &scene,
        "--macro-steps",
        "1e-2,2e-3,1e-3",
        "--reference",
        "finest",
    ];
    Study {
        arguments: arguments.map(str::to_owned).to_vec(),
        files: &["converge.csv", "converge.svg", "work-precision.svg"],
    }
}

impl Study {
    fn with<'a>(&'a self, more: &[&'a str]) -> Vec<&'a str> {
        let own = self.arguments.iter().map(String::as_str);
        own.chain(more.iter().copied()).collect()
    }
}

/// The files of two studies are the same, byte by byte.
#[track_caller]
fn assert_same(workshop: &Workshop, study: &Study, one: &str, other: &str) {
    for file in study.files {
        let [one, other] = [one, other].map(|run| workshop.read(&format!("{run}/{file}")));
        assert!(one == other, "{file} differs:\n{one}\n{other}");
    }
}

#[test]
fn parts_together_are_the_study() {
    for (study, parts) in [(map(), 4), (orders(), 3)] {
        let workshop = Workshop::new();
        workshop.run(&study.with(&["--out", "whole"])).exits_with(0);
        for number in (1..=parts).rev() {
            let part = format!("{number}/{parts}");
            let outcome = workshop.run(&study.with(&["--part", &part, "--out", "parts"]));
            let said = &outcome.exits_with(0).stdout;
            assert!(said.contains(&format!("part {part}")), "{said}");
        }
        let parts = parts.to_string();
        workshop
            .run(&study.with(&["--merge", &parts, "--out", "parts"]))
            .exits_with(0);
        assert_same(&workshop, &study, "whole", "parts");
    }
}

/// Two scenes, one of them with a map, and two settings.
fn small_report() -> String {
    let file = scene("oscillator.toml");
    format!(
        r#"
[study]
name = "small"
title = "Small"

[[scene]]
name = "mapped"
file = "{file}"
macro_steps = [4e-2, 2e-2, 7e-3]
trace_step = 2e-2
[scene.set]
"coupling.macro_step" = 2e-2
"stability.x" = {{ key = "subsystem.*.parameters.c", from = 1e1, to = 1e7, points = 4, scale = "log" }}
"stability.y" = {{ key = "subsystem.*.parameters.d", from = 1e-1, to = 1e5, points = 3, scale = "log" }}

[[scene]]
name = "damped"
file = "{file}"
macro_steps = [4e-2, 1.3e-2]
trace_step = 4e-2
set = {{ "subsystem.*.parameters.d" = 31.0 }}

[[setting]]
name = "linear"
set = {{ "coupling.degree" = 1 }}

[[setting]]
name = "constant"
set = {{ "coupling.degree" = 0 }}
"#
    )
}

/// The times of a report differ from run to run; nothing else does.
#[test]
fn parts_of_a_report_hold_whole_scenes() {
    let workshop = Workshop::new();
    workshop.write("small.toml", small_report());
    let report = |more: &[&str]| {
        let own = ["report", "small.toml"];
        workshop.run(&[&own[..], more].concat()).exits_with(0);
    };
    report(&["--out", "whole"]);
    for part in ["1/2", "2/2"] {
        report(&["--out", "parts", "--part", part]);
    }
    report(&["--out", "parts", "--merge", "2"]);
    let rows = |run: &str| {
        let text = workshop.read(&format!("{run}/report.csv"));
        let mut table = csv::Reader::from_reader(text.as_bytes());
        let headers = table.headers().unwrap().clone();
        let is_time = |name: &str| name.contains("time");
        let rows = table.records().map(|row| {
            let row = row.unwrap();
            let fields = headers.iter().zip(row.iter());
            let kept = fields.filter(|(name, _)| !is_time(name));
            kept.map(|(_, field)| field.to_owned()).collect::<Vec<_>>()
        });
        rows.collect::<Vec<_>>()
    };
    // Five runs with either setting, and nine tolerances of the monolithic scene, which does not follow a changed damper.
    assert_eq!(rows("whole").len(), 2 * 5 + 9);
    assert_eq!(rows("whole"), rows("parts"));
    let map = ["whole", "parts"].map(|run| workshop.read(&format!("{run}/mapped-stability-1.svg")));
    assert!(map[0] == map[1]);
}

#[test]
fn what_is_missing_is_named_and_what_is_there_is_kept() {
    let workshop = Workshop::new();
    let study = map();
    for part in ["1/4", "3/4"] {
        workshop
            .run(&study.with(&["--part", part, "--out", "out"]))
            .exits_with(0);
    }
    let merge = || workshop.run(&study.with(&["--merge", "4", "--out", "out"]));
    let outcome = merge();
    outcome.fails(1, &["--part 2/4, 4/4"]);
    let run = workshop.read("out/run.json");
    assert!(run.contains("\"status\": \"failed\""), "{run}");
    // 21 points, of which the parts 2 and 4 have five each.
    assert_eq!(workshop.read("out/stability.csv").lines().count(), 1 + 11);

    for part in ["2/4", "4/4"] {
        workshop
            .run(&study.with(&["--part", part, "--out", "out"]))
            .exits_with(0);
    }
    merge().exits_with(0);
    assert_eq!(workshop.read("out/stability.csv").lines().count(), 1 + 21);

    let path = workshop.path().join("out/parts/3-of-4/part.bin");
    let whole = fs::read(&path).unwrap();
    fs::write(&path, &whole[..whole.len() - 7]).unwrap();
    let outcome = merge();
    outcome.fails(1, &["3-of-4/part.bin is damaged", "--part 3/4"]);

    fs::write(&path, &whole).unwrap();
    let changed = study.with(&["--merge", "4", "--out", "out", "--set", "scene.t_end=0.3"]);
    let outcome = workshop.run(&changed);
    outcome.fails(1, &["is of another study", "--part 1/4"]);
}

#[test]
fn parts_that_cannot_be_are_refused() {
    let workshop = Workshop::new();
    let study = orders();
    for (arguments, message) in [
        (["--part", "0/3"], "it must be I/N"),
        (["--part", "4/3"], "it must be I/N"),
        (["--merge", "0"], "it must be a whole number from 1"),
        (["--slurm", "x"], "it must be a whole number from 1"),
        (["--slurm", "4"], "4 parts, but only 3 runs to do"),
        (["--part", "1/4"], "4 parts, but only 3 runs to do"),
        (["--merge", "4"], "4 parts, but only 3 runs to do"),
    ] {
        let outcome = workshop.run(&study.with(&arguments));
        let said = &outcome.exits_with(2).stderr;
        assert!(said.contains(message), "{arguments:?}: {said}");
    }
    workshop
        .run(&study.with(&["--part", "1/3", "--merge", "3"]))
        .exits_with(2);
}

/// A Slurm of one node. Dropping it ends it.
struct Cluster<'a> {
    workshop: &'a Workshop,
}

impl<'a> Cluster<'a> {
    fn start(workshop: &'a Workshop) -> Self {
        let cluster = Self { workshop };
        let output = cluster.script("start").output().unwrap();
        assert!(output.status.success(), "{output:?}");
        cluster
    }

    fn folder(&self) -> PathBuf {
        self.workshop.path().join("slurm")
    }

    fn script(&self, action: &str) -> Command {
        let mut command = Command::new("bash");
        let script = repository().join("tests/slurm/cluster.sh");
        command.arg(script).arg(action).arg(self.folder());
        command
    }

    /// Runs a line of a shell as a user of the cluster does.
    fn shell(&self, line: &str) -> std::process::Output {
        let mut command = Command::new("bash");
        command
            .args(["-c", line])
            .current_dir(self.workshop.path())
            .env("SLURM_CONF", self.folder().join("slurm.conf"));
        command.output().unwrap()
    }
}

impl Drop for Cluster<'_> {
    fn drop(&mut self) {
        let _ = self.script("stop").status();
    }
}

/// Why there is no Slurm on this machine.
fn missing_slurm() -> Option<String> {
    let found = Command::new("bash")
        .args([
            "-c",
            "PATH=$PATH:/usr/sbin; type munged slurmctld slurmd sbatch",
        ])
        .output()
        .unwrap();
    let reason = String::from_utf8_lossy(&found.stderr).into_owned();
    (!found.status.success()).then_some(reason)
}

/// The script as it is printed, submitted with the line that stands in it, on a real Slurm.
#[test]
fn slurm_does_the_parts() {
    if let Some(reason) = missing_slurm() {
        println!("skipped, there is no Slurm: {reason}");
        return;
    }
    let workshop = Workshop::new();
    let study = map();
    workshop.run(&study.with(&["--out", "whole"])).exits_with(0);
    let outcome = workshop.run(&study.with(&["--out", "array", "--slurm", "3"]));
    let script = workshop.write("map.sbatch", &outcome.exits_with(0).stdout);
    assert!(!workshop.path().join("array").exists());

    let cluster = Cluster::start(&workshop);
    let script = fs::read_to_string(script).unwrap();
    let submit = script.lines().find_map(|line| line.strip_prefix("#   "));
    let submit = submit.unwrap().replace("FILE", "map.sbatch");
    let output = cluster.shell(&submit);
    let logs = cluster.shell("cat slurm-*.out").stdout;
    assert!(
        output.status.success(),
        "{submit}\n{output:?}\n{}",
        String::from_utf8_lossy(&logs)
    );
    assert_same(&workshop, &study, "whole", "array");
    // Each part was a task of the array.
    let logs = String::from_utf8_lossy(&logs).into_owned();
    for part in ["1/3", "2/3", "3/3"] {
        assert!(logs.contains(&format!("part {part}")), "{logs}");
    }
}
