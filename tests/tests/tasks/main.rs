//! Ten tasks of a new user, typed from the book, each in a folder of its own: the user gets what was wanted.

#![allow(clippy::unwrap_used)]

mod table;

use std::fs;
use std::os::unix::fs::symlink;
use std::process::{Command, Output, Stdio};

use linchpin_tests::process::Workshop;
use linchpin_tests::python::{in_repository, python};
use linchpin_tests::tasks::{Task, tasks};
use serde_json::Value;

fn task(name: &str) -> Task {
    let found = tasks().into_iter().find(|task| task.name == name);
    found.unwrap_or_else(|| panic!("there is no task {name}"))
}

/// What a task leaves.
struct Done {
    workshop: Workshop,
    printed: String,
}

impl Done {
    #[track_caller]
    fn says(&self, words: &[&str]) -> &Self {
        for word in words {
            assert!(
                self.printed.contains(word),
                "no {word:?} in\n{}",
                self.printed
            );
        }
        self
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.workshop.read(name)).unwrap()
    }

    /// The last number of a column, as the table has it.
    fn last(&self, table: &str, column: &str) -> String {
        let text = self.workshop.read(table);
        let mut rows = text.lines();
        let place = rows
            .next()
            .unwrap()
            .split(',')
            .position(|name| name == column);
        let last = rows.next_back().unwrap().split(',').nth(place.unwrap());
        last.unwrap().to_owned()
    }
}

/// `linchpin` and the interpreter of the tests come first on the PATH; what a clone has is there by links.
fn command(workshop: &Workshop, script: &Task) -> Command {
    let linchpin = workshop.command::<&str>(&[]).get_program().to_owned();
    let programs = [linchpin.as_ref(), python().interpreter.as_path()];
    let mut path = programs
        .map(|program: &std::path::Path| program.parent().unwrap().to_owned())
        .to_vec();
    path.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap()));
    let mut command = Command::new("sh");
    command
        .arg(&script.path)
        .env("PATH", std::env::join_paths(path).unwrap())
        .env("TMPDIR", workshop.path())
        .env_remove("LINCHPIN_LOG")
        .stdin(Stdio::null());
    command
}

#[track_caller]
fn printed(name: &str, output: &Output) -> String {
    let texts = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    let printed = texts.join("\n");
    assert!(
        output.status.success(),
        "{name}: {}\n{printed}",
        output.status
    );
    printed
}

#[track_caller]
fn done(name: &str) -> Done {
    let workshop = Workshop::new();
    for folder in ["scenes", "worker"] {
        symlink(in_repository(folder), workshop.path().join(folder)).unwrap();
    }
    let output = command(&workshop, &task(name))
        .current_dir(workshop.path())
        .output();
    let printed = printed(name, &output.unwrap());
    Done { workshop, printed }
}

/// Adds pandas and VTK to the interpreter of the tests.
fn add_packages() {
    let mut command = Command::new("bash");
    command.args([
        in_repository("tests/python/add.sh").as_os_str(),
        "tasks".as_ref(),
    ]);
    printed("add.sh", &command.output().unwrap());
}

#[test]
fn a_first_scene_moves() {
    let done = done("01-first-scene");
    done.says(&[
        "two-links.toml: ok",
        "reached t = 2 s",
        "results in out/two-links",
    ]);
    assert!(
        done.workshop
            .read("out/two-links/animation.html")
            .contains("<html")
    );
    assert_eq!(done.last("out/two-links/results.csv", "t"), "2.0");
}

#[test]
fn an_own_worker_is_coupled() {
    let done = done("02-own-worker");
    done.says(&["reached t = 1 s", "residual of bolt (position)"]);
    let ends = ["own.x", "built-in.x"].map(|column| done.last("out/masses/results.csv", column));
    let [own, other] = ends.map(|end| end.parse::<f64>().unwrap());
    assert!(own != 0.0 && (own - other).abs() < 1e-8, "{own} {other}");
}

#[test]
fn the_macro_step_is_another() {
    let done = done("03-macro-step");
    done.says(&["macro steps       10000"]);
    let rows = done.workshop.read("out/fine/results.csv").lines().count();
    assert_eq!(rows, 1 + 10_001);
}

#[test]
fn two_runs_are_compared() {
    done("04-compare").says(&[
        "coupling.macro_step              0.001 | 0.0005",
        "5 other columns differ by at most 1e-1 of their size",
        "error: the runs differ: 3 columns",
    ]);
}

#[test]
fn one_variable_is_drawn() {
    let done = done("05-plot");
    done.says(&["mass1.x", "position of the mass"]);
    let picture = done.workshop.read("position.svg");
    assert!(picture.contains("mass1.x") && !picture.contains("mass2.x"));
}

/// The message leads to settings with which the run is sound.
#[test]
fn a_run_that_diverged_is_mended() {
    let done = done("06-diverged");
    done.says(&[
        "the run diverged at t = 0.029 s",
        "index 2 with degree 2 is unstable",
        "or index = 1",
    ]);
    assert_eq!(done.json("out/oscillator/run.json")["status"], "done");
}

#[test]
#[ignore = "builds images, which the tests of docker-compose.yml do as well"]
fn a_run_in_containers_ends_with_its_results() {
    let name = "07-containers";
    if let Some(reason) = missing_engine() {
        eprintln!("skipped: {name}: {reason}");
        return;
    }
    let workshop = Workshop::new();
    let mut command = command(&workshop, &task(name));
    let clone = workshop.path().join("clone");
    let mut git = Command::new("git");
    git.args(["clone", "--quiet"])
        .arg(in_repository("."))
        .arg(&clone);
    printed("git clone", &git.output().unwrap());
    command.env("COMPOSE_PROJECT_NAME", "linchpin-task");
    printed(name, &command.current_dir(&clone).output().unwrap());
    assert!(
        fs::read_to_string(clone.join("out/compose/results.csv"))
            .unwrap()
            .lines()
            .count()
            > 1
    );
}

/// Why containers cannot be tested on this machine.
fn missing_engine() -> Option<String> {
    [("docker", "info"), ("docker-compose", "version")]
        .into_iter()
        .find_map(
            |(program, argument)| match Command::new(program).arg(argument).output() {
                Err(error) => Some(format!("{program}: {error}")),
                Ok(output) => (!output.status.success())
                    .then(|| format!("{program} {argument}: {}", output.status)),
            },
        )
}

#[test]
fn an_interrupted_run_goes_on_with_the_same_bits() {
    let done = done("08-resume");
    done.says(&["interrupted at t = ", "reached t = "]);
    let resumed_at = done.json("out/double-pendulum/run.json")["resumed_at"].as_f64();
    assert!(resumed_at.unwrap() > 0.0);
    let step = "coupling.macro_step=5e-5";
    let whole = [
        "run",
        "scenes/double-pendulum.toml",
        "--set",
        step,
        "--out",
        "out/whole",
        "--no-plots",
    ];
    done.workshop.run(&whole).succeeds();
    let tables = ["double-pendulum", "whole"]
        .map(|run| done.workshop.read(&format!("out/{run}/results.csv")));
    assert!(tables[0] == tables[1]);
}

#[test]
fn pandas_reads_the_same_bits() {
    add_packages();
    let done = done("09-pandas");
    let last = done.last("out/oscillator/results.csv", "mass1.x");
    done.says(&[&format!("{last} m")]);
}

/// VTK finds as many files as the run has rows, and in the last one the markers where the table has them.
#[test]
fn paraview_has_the_markers_at_their_places() {
    add_packages();
    let done = done("10-paraview");
    done.says(&["out/four-bar/vtk/four-bar.pvd"]);
    let read = done.workshop.write("read.py", READ);
    let mut command = Command::new(&python().interpreter);
    command
        .arg(read)
        .current_dir(done.workshop.path().join("out/four-bar/vtk"));
    let printed = printed("read.py", &command.output().unwrap());
    let table = "out/four-bar/results.csv";
    assert!(printed.contains("files 1001"), "{printed}");
    for bar in ["crank", "coupler", "rocker"] {
        let [x, y] = ["x", "y"].map(|axis| {
            done.last(table, &format!("{bar}.end_{axis}"))
                .parse::<f64>()
                .unwrap()
        });
        let is_there = |line: &str| {
            let numbers: Vec<f64> = line
                .split(' ')
                .filter_map(|word| word.parse().ok())
                .collect();
            matches!(numbers[..], [a, b, _] if (a - x).abs() < 1e-6 && (b - y).abs() < 1e-6)
        };
        assert!(printed.lines().any(is_there), "{bar} {x} {y}\n{printed}");
    }
}

/// Reads what ParaView reads.
const READ: &str = r#"
import xml.etree.ElementTree as xml
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

files = [entry.get("file") for entry in xml.parse("four-bar.pvd").iter("DataSet")]
print("files", len(files))
reader = vtkXMLPolyDataReader()
reader.SetFileName(files[-1])
reader.Update()
points = reader.GetOutput().GetPoints()
for number in range(points.GetNumberOfPoints()):
    print(*points.GetPoint(number))
"#;
