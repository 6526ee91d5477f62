//! Scenes that are exported as FMUs: FMPy and the worker for FMUs step them, with the bits of `linchpin run`.

#![allow(clippy::unwrap_used, missing_docs)]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

use linchpin_tests::process::Workshop;
use linchpin_tests::python::{in_repository, python};
use serde_json::Value;

const OSCILLATOR: &str = include_str!("../../scenes/oscillator.toml");
const DOUBLE_PENDULUM: &str = include_str!("../../scenes/double-pendulum.toml");
const LOAD_STEP: &str = include_str!("../../scenes/hard/load-step.toml");
const HERMITE: &str = "coupling.method=\"hermite\"";

/// The interpreter with FMPy.
fn interpreter() -> &'static Path {
    static READY: OnceLock<()> = OnceLock::new();
    READY.get_or_init(|| {
        python();
        let mut add = Command::new("bash");
        add.arg(in_repository("tests/python/add.sh")).arg("fmpy");
        assert!(add.status().unwrap().success());
    });
    &python().interpreter
}

/// What `tests/python/drive_fmu.py` prints.
fn drive(workshop: &Workshop, arguments: &[&str]) -> Value {
    let script = in_repository("tests/python/drive_fmu.py");
    let mut command = Command::new(interpreter());
    command
        .arg(script)
        .args(arguments)
        .current_dir(workshop.path());
    let output = command.env("TMPDIR", workshop.path()).output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}\n{errors}"))
}

/// A folder with the scene, and its FMU as `scene.fmu`.
fn exported(scene: &str, arguments: &[&str]) -> Workshop {
    let workshop = Workshop::new();
    workshop.write("scene.toml", scene);
    let export = ["export", "scene.toml", "scene.fmu"];
    workshop.run(&[&export, arguments].concat()).succeeds();
    workshop
}

/// The rows of `linchpin run` by time, each by column.
fn rows(workshop: &Workshop, settings: &[&str]) -> Vec<BTreeMap<String, f64>> {
    let run = ["run", "scene.toml", "--out", "out", "--no-plots", "--quiet"];
    workshop.run(&[&run, settings].concat()).succeeds();
    let text = workshop.read("out/results.csv");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        let values = line.split(',').map(|value| value.parse().unwrap());
        names
            .iter()
            .map(|name| (*name).to_owned())
            .zip(values)
            .collect()
    };
    lines.map(row).collect()
}

fn from_hex(text: &Value) -> f64 {
    let text = text.as_str().unwrap();
    let (sign, text) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text),
    };
    let (digits, power) = text.strip_prefix("0x").unwrap().split_once('p').unwrap();
    let (whole, part) = digits.split_once('.').unwrap();
    let mantissa = u64::from_str_radix(&format!("{whole}{part}"), 16).unwrap() as f64;
    let power: i32 = power.parse().unwrap();
    sign * mantissa * 2.0_f64.powi(power - 4 * part.len() as i32)
}

/// The largest difference between FMPy and `linchpin run` at the communication points, and how many values are compared.
fn difference(found: &Value, rows: &[BTreeMap<String, f64>]) -> (f64, usize) {
    assert_eq!(found["problems"], Value::Array(Vec::new()));
    let times: Vec<f64> = { found["t"].as_array().unwrap().iter() }
        .map(|t| t.as_f64().unwrap())
        .collect();
    let (mut most, mut compared) = (0.0_f64, 0);
    for (name, values) in found["values"].as_object().unwrap() {
        for (t, value) in times.iter().zip(values.as_array().unwrap()) {
            let row = rows.iter().find(|row| (row["t"] - t).abs() < 1e-9);
            let expected = row.unwrap_or_else(|| panic!("no row at {t}"))[name];
            most = most.max((from_hex(value) - expected).abs());
            compared += 1;
        }
    }
    (most, compared)
}

#[test]
fn fmpy_has_the_bits_of_the_run() {
    for (scene, settings, step) in [
        (OSCILLATOR, &["scene.t_end=0.2"][..], "1e-2"),
        (
            OSCILLATOR,
            &[
                "scene.t_end=0.2",
                HERMITE,
                "coupling.degree=4",
                "coupling.macro_step=5e-3",
            ],
            "5e-3",
        ),
        (DOUBLE_PENDULUM, &["scene.t_end=0.1"], "1e-2"),
        (
            DOUBLE_PENDULUM,
            &["scene.t_end=0.1", HERMITE, "coupling.macro_step=1e-2"],
            "2e-2",
        ),
    ] {
        let settings: Vec<&str> = settings.iter().flat_map(|own| ["--set", *own]).collect();
        for fmi in ["2", "3"] {
            let workshop = exported(scene, &[&settings[..], &["--fmi", fmi]].concat());
            let rows = rows(&workshop, &settings);
            let end = rows.last().unwrap()["t"].to_string();
            let found = drive(&workshop, &["run", "scene.fmu", step, &end]);
            let (most, compared) = difference(&found, &rows);
            assert!(compared > 30, "{compared}");
            assert!(most == 0.0, "FMI {fmi}, {settings:?}: {most:e}");
        }
    }
}

/// Communication points that are no macro points shorten the steps before them.
#[test]
fn any_communication_points_keep_the_accuracy() {
    let settings = [
        "--set",
        "scene.t_end=0.2",
        "--set",
        HERMITE,
        "--set",
        "coupling.degree=3",
        "--set",
        "coupling.macro_step=4e-3",
    ];
    let workshop = exported(
        OSCILLATOR,
        &[
            &["--fmi", "3"],
            &settings[..],
            &["--output", "mass1.x", "--output", "mass1.v"],
        ]
        .concat(),
    );
    let rows = rows(
        &workshop,
        &[&settings[..], &["--set", "output.interval=0.0125"]].concat(),
    );
    let found = drive(&workshop, &["run", "scene.fmu", "0.0125", "0.2"]);
    assert_eq!(found["values"].as_object().unwrap().len(), 2);
    let (most, _) = difference(&found, &rows);
    let size = rows
        .iter()
        .map(|row| row["mass1.v"].abs())
        .fold(0.0, f64::max);
    assert!(most < 1e-6 * size, "{most:e} of {size}");
}

#[test]
fn a_state_goes_on_with_the_same_bits_also_in_another_process() {
    for (scene, settings) in [
        (
            OSCILLATOR,
            &["--set", HERMITE, "--set", "coupling.degree=3"][..],
        ),
        (DOUBLE_PENDULUM, &["--fmi", "3"]),
        (LOAD_STEP, &[]),
    ] {
        let workshop = exported(scene, settings);
        let step = "3.7e-3";
        let found = drive(&workshop, &["states", "scene.fmu", step, "state"]);
        assert_eq!(found["once"], found["again"]);
        assert_eq!(found["before"], found["anew"]);
        assert_ne!(found["once"][0], found["once"][1]);
        let other = drive(&workshop, &["resume", "scene.fmu", step, "state"]);
        assert_eq!(found["once"], other["again"]);
    }
}

#[test]
fn parameters_are_those_of_the_subsystems() {
    let settings = ["--set", "scene.t_end=0.05"];
    let workshop = exported(
        OSCILLATOR,
        &[
            &["--fmi", "3"],
            &settings[..],
            &["--parameter", "mass1.c", "--parameter", "mass2.load"],
        ]
        .concat(),
    );
    let changed = ["mass1.c=1234.5", "mass2.load=-3.25"];
    let found = drive(
        &workshop,
        &[&["run", "scene.fmu", "1e-2", "0.05"], &changed[..]].concat(),
    );
    let more = [
        "--set",
        "subsystem.mass1.parameters.c=1234.5",
        "--set",
        "subsystem.mass2.parameters.load=-3.25",
    ];
    let rows = rows(&workshop, &[&settings[..], &more].concat());
    assert_eq!(difference(&found, &rows).0, 0.0);
    let description = archived(&workshop, "modelDescription.xml");
    assert!(
        description
            .contains("<Float64 name=\"mass1.c\" valueReference=\"5\" causality=\"parameter\""),
        "{description}"
    );
    assert!(description.contains("unit=\"N/m\""), "{description}");
}

fn archived(workshop: &Workshop, name: &str) -> String {
    let mut unzip = Command::new(interpreter());
    let code =
        "import sys, zipfile; print(zipfile.ZipFile(sys.argv[1]).read(sys.argv[2]).decode())";
    unzip
        .args(["-c", code, "scene.fmu", name])
        .current_dir(workshop.path());
    String::from_utf8(unzip.output().unwrap().stdout).unwrap()
}

/// A scene inside a scene.
#[test]
fn the_worker_for_fmus_serves_it() {
    for fmi in ["2", "3"] {
        serve(fmi);
    }
}

fn serve(fmi: &str) {
    let settings = ["--set", "scene.t_end=0.05"];
    let workshop = exported(OSCILLATOR, &[&settings[..], &["--fmi", fmi]].concat());
    let expected = rows(&workshop, &settings);
    workshop.write(
        "scene.toml",
        "[scene]\nname = \"outer\"\nt_end = 0.05\n[coupling]\nmacro_step = 1e-2\n\
         [[subsystem]]\nname = \"inner\"\nfmu = \"scene.fmu\"\n[output]\nvariables = [\"inner.mass1.x\", \"inner.link.lambda\"]\n",
    );
    for row in rows(&workshop, &[]) {
        let inner = expected
            .iter()
            .find(|own| (own["t"] - row["t"]).abs() < 1e-9)
            .unwrap();
        for name in ["mass1.x", "link.lambda"] {
            let (found, expected) = (row[&format!("inner.{name}")], inner[name]);
            assert!(
                (found - expected).abs() <= 1e-9 * expected.abs().max(1.0),
                "{name}: {found} and {expected}"
            );
        }
    }
}

/// Workers outside of the importer's process: one that the scene starts, and one that runs already.
#[test]
fn workers_of_commands_and_addresses_take_part() {
    let (workshop, elsewhere) = (Workshop::new(), Workshop::new());
    let linchpin = workshop.command::<&str>(&[]).get_program().to_owned();
    let socket = elsewhere.path().join("standing.sock");
    let address = format!("unix:{}", socket.display());
    let mut standing = elsewhere.start(&["worker", "--listen", &address]);
    standing.wait_until("the socket", |_| socket.exists());
    let started = format!(
        "command = [{:?}, \"worker\", \"--exit-with-stdin\"]",
        linchpin
    );
    let served = |name: &str, by: &str| {
        let name = format!("name = {name:?}\n");
        [name.clone(), format!("{name}{by}\n")]
    };
    let [mass1, started] = served("mass1", &started);
    let [mass2, standing_by] = served("mass2", &format!("address = {address:?}"));
    let scene = { OSCILLATOR.replacen(&mass1, &started, 1) }.replacen(&mass2, &standing_by, 1);
    assert!(
        scene.contains(&started) && scene.contains(&standing_by),
        "{scene}"
    );
    workshop.write("scene.toml", &scene);
    let settings = ["--set", "scene.t_end=0.05"];
    let export = ["export", "scene.toml", "scene.fmu"];
    workshop.run(&[&export, &settings[..]].concat()).succeeds();
    let found = drive(&workshop, &["run", "scene.fmu", "1e-2", "0.05"]);
    let (most, compared) = difference(&found, &rows(&workshop, &settings));
    assert!(compared > 20, "{compared}");
    assert_eq!(most, 0.0);
}

#[test]
fn what_an_importer_does_wrong_is_told_by_its_logger() {
    for fmi in ["2", "3"] {
        let workshop = exported(OSCILLATOR, &["--fmi", fmi, "--parameter", "mass1.c"]);
        assert_told(&drive(&workshop, &["mistakes", "scene.fmu"]));
    }
}

fn assert_told(told: &Value) {
    for (call, words) in [
        ("too early", "before the scene is initialised"),
        (
            "start time",
            "the start time is 1 s, and the scene starts at 0 s",
        ),
        (
            "another time",
            "a step from t = 0.5 s, and the scene stands at t = 0 s",
        ),
        ("no step", "greater than 0"),
        ("too late", "\"mass1.c\" is set after the start"),
        ("no variable", "no variable has the value reference 1000"),
        ("no state", "no state of this FMU"),
    ] {
        let said = told[call]
            .as_str()
            .unwrap_or_else(|| panic!("{call} does not fail"));
        assert!(said.contains(words), "{call}: {said}");
    }
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let workshop = Workshop::new();
    workshop.write("scene.toml", OSCILLATOR);
    let cases = OSCILLATOR.to_owned()
        + "\n[[case]]\nname = \"stiff\"\nset = { \"subsystem.mass1.parameters.c\" = 1e5 }\n";
    workshop.write("cases.toml", cases);
    let fmu = OSCILLATOR.replacen("model = \"oscillator\"  ", "fmu = \"some.fmu\" # ", 1);
    workshop.write("fmu.toml", fmu);
    let export = |scene: &str, more: &[&str]| {
        let outcome = workshop.run(&[&["export", scene, "new.fmu"], more].concat());
        assert!(!workshop.path().join("new.fmu").exists());
        outcome
    };
    export("scene.toml", &["--output", "mass1.y"]).fails(
        2,
        &[
            "no result column \"mass1.y\"",
            "mass1.x",
            "output.variables",
        ],
    );
    export("scene.toml", &["--parameter", "mass1.k"])
        .fails(2, &["\"mass1.k\" is no parameter", "mass1.c"]);
    export(
        "scene.toml",
        &["--output", "mass1.x", "--output", "mass1.x"],
    )
    .fails(2, &["\"mass1.x\" is given twice"]);
    export("scene.toml", &["--case", "stiff"]).fails(2, &["no case \"stiff\"; it has none"]);
    export("cases.toml", &[]).fails(2, &["has cases", "--case", "stiff"]);
    export("fmu.toml", &[]).fails(2, &["\"mass1\" is an FMU itself"]);
    export("scene.toml", &["--set", "coupling.macro_step=-1"]).fails(2, &["coupling.macro_step"]);
    export("nothing.toml", &[]).fails(2, &["nothing.toml"]);
}

#[test]
fn a_case_is_exported() {
    let cases = OSCILLATOR.to_owned()
        + "\n[[case]]\nname = \"stiff\"\nset = { \"subsystem.mass1.parameters.c\" = 1e5 }\n";
    let workshop = exported(&cases, &["--case", "stiff", "--set", "scene.t_end=0.02"]);
    let found = drive(&workshop, &["run", "scene.fmu", "1e-2", "0.02"]);
    workshop.write("scene.toml", OSCILLATOR);
    let settings = [
        "--set",
        "subsystem.mass1.parameters.c=1e5",
        "--set",
        "scene.t_end=0.02",
    ];
    assert_eq!(difference(&found, &rows(&workshop, &settings)).0, 0.0);
}

/// A program without its library beside it.
#[test]
fn without_the_library_the_error_says_how_it_is_built() {
    let workshop = Workshop::new();
    workshop.write("scene.toml", OSCILLATOR);
    let program = workshop.command::<&str>(&[]).get_program().to_owned();
    let alone = workshop.path().join("linchpin");
    fs::copy(program, &alone).unwrap();
    let mut export = Command::new(&alone);
    export
        .args(["export", "scene.toml", "scene.fmu"])
        .current_dir(workshop.path());
    let output = export.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{errors}");
    assert!(
        errors.contains("cargo build --release --workspace")
            && errors.contains("liblinchpin_scene.so"),
        "{errors}"
    );
}
