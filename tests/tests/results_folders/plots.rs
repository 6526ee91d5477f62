//! `linchpin plot`, and the units and descriptions that it draws by.

use linchpin_tests::process::Workshop;
use serde_json::Value;

use super::{DOUBLE_PENDULUM, OSCILLATOR, run, set};

const GIMBAL: &str = include_str!("../../../scenes/spatial/gimbal.toml");

/// Texts of a picture.
fn texts(workshop: &Workshop, file: &str) -> Vec<String> {
    let svg = workshop.read(file);
    let elements = svg.split("<text").skip(1);
    let content = elements.map(|text| text.split('>').nth(1).unwrap().split('<').next().unwrap());
    content.map(|text| text.trim().to_owned()).collect()
}

#[track_caller]
fn has(texts: &[String], wanted: &[&str]) {
    for text in wanted {
        assert!(
            texts.iter().any(|own| own == text),
            "no {text:?} in {texts:?}"
        );
    }
}

#[track_caller]
fn lacks(texts: &[String], unwanted: &[&str]) {
    for text in unwanted {
        assert!(
            !texts.iter().any(|own| own == text),
            "{text:?} in {texts:?}"
        );
    }
}

#[test]
fn a_run_is_drawn_again_with_the_columns_that_it_draws() {
    let workshop = run(OSCILLATOR, &[]);
    let outcome = workshop.run(&["plot", "out"]);
    outcome.succeeds();
    assert_eq!(outcome.stdout, "out/plot.svg\nout/plot.png\n");
    assert_eq!(
        workshop.read("out/plot.svg"),
        workshop.read("out/results.svg")
    );
    let png = |name: &str| std::fs::read(workshop.path().join(name)).unwrap();
    assert!(png("out/plot.png") == png("out/results.png"));
}

#[test]
fn columns_times_and_files_are_chosen() {
    let workshop = run(OSCILLATOR, &[]);
    let columns = ["--columns", "mass?.v,link.lambda", "--columns", "mass1.x"];
    let times = ["--from", "0.25", "--to", "0.5", "--file", "two.svg"];
    workshop
        .run(&[&["plot", "out"], &columns[..], &times].concat())
        .succeeds();
    let drawn = texts(&workshop, "two.svg");
    has(
        &drawn,
        &[
            "velocity in m/s",
            "mass1.v",
            "mass2.v",
            "joint force in N",
            "link.lambda",
        ],
    );
    has(
        &drawn,
        &["position in m", "mass1.x", "0.25", "0.50", "t in s"],
    );
    lacks(&drawn, &["mass2.x", "residual in m", "0.00", "0.2", "0.6"]);
    assert!(!workshop.path().join("out/plot.svg").exists());
}

#[test]
fn where_steps_vary_their_length_their_error_and_their_repetition_are_drawn() {
    let settings = set(&["coupling.method=hermite", "coupling.tolerance=1e-6"]);
    let workshop = run(DOUBLE_PENDULUM, &settings);
    let told: Value = serde_json::from_str(&workshop.read("out/run.json")).unwrap();
    let rejected = told["statistics"]["steps"]["rejected"].as_u64().unwrap();
    assert!(rejected > 0);
    let table = workshop.read("out/results.csv");
    let place = table
        .lines()
        .next()
        .unwrap()
        .split(',')
        .position(|own| own == "rejected")
        .unwrap();
    let last = table.lines().last().unwrap().split(',').nth(place).unwrap();
    assert_eq!(last.parse(), Ok(rejected as f64));
    workshop.run(&["plot", "out"]).succeeds();
    let drawn = texts(&workshop, "out/plot.svg");
    has(
        &drawn,
        &[
            "macro step H in s",
            "estimated error / motion",
            "step repeated",
        ],
    );
    let fixed = run(DOUBLE_PENDULUM, &[]);
    let drawn = texts(&fixed, "out/results.svg");
    lacks(
        &drawn,
        &[
            "macro step H in s",
            "estimated error / motion",
            "step repeated",
        ],
    );
}

#[test]
fn quaternions_are_drawn_as_turns() {
    let workshop = run(GIMBAL, &[]);
    let files = ["--file", "turns.svg"];
    workshop
        .run(&[&["plot", "out", "--columns", "*_q?"], &files[..]].concat())
        .succeeds();
    let drawn = texts(&workshop, "turns.svg");
    has(
        &drawn,
        &["turn since the start in rad", "gimbal.bearing", "top.start"],
    );
    lacks(&drawn, &["top.start_qw", "top.start_qx"]);
}

#[test]
fn a_run_that_failed_is_drawn_with_its_reason() {
    let workshop = Workshop::new();
    workshop.write("scene.toml", OSCILLATOR);
    let settings = set(&["coupling.method=penalty", "coupling.stiffness=1e9"]);
    let arguments = [
        "run",
        "scene.toml",
        "--out",
        "out",
        "--in-process",
        "--no-plots",
    ];
    workshop
        .run(&[&arguments[..], &settings].concat())
        .fails(1, &["diverged"]);
    workshop.run(&["plot", "out"]).succeeds();
    let drawn = texts(&workshop, "out/plot.svg");
    assert!(
        drawn[0].starts_with("oscillator: the run diverged at t = "),
        "{}",
        drawn[0]
    );
}

#[test]
fn cases_are_drawn_together() {
    let cases = "\n[[case]]\nname = \"soft\"\nset = { \"subsystem.*.parameters.c\" = 1e3 }\n\
                 [[case]]\nname = \"hard\"\nset = { \"subsystem.*.parameters.c\" = 1e5 }\n";
    let workshop = run(&(OSCILLATOR.to_owned() + cases), &[]);
    workshop
        .run(&["plot", "out", "--columns", "mass?.x"])
        .succeeds();
    let drawn = texts(&workshop, "out/plot.svg");
    has(
        &drawn,
        &[
            "mass1.x: soft",
            "mass2.x: soft",
            "mass1.x: hard",
            "mass2.x: hard",
        ],
    );
}

#[test]
fn columns_are_listed_and_described() {
    let workshop = run(DOUBLE_PENDULUM, &[]);
    let listed = workshop.run(&["plot", "out", "--list"]);
    listed.succeeds();
    let told: Value = serde_json::from_str(&workshop.read("out/run.json")).unwrap();
    let columns = told["columns"].as_array().unwrap();
    assert_eq!(listed.stdout.lines().count(), columns.len());
    for column in columns {
        for key in ["name", "unit", "description", "quantity"] {
            assert!(
                !column[key].as_str().unwrap().is_empty(),
                "{key} of {column}"
            );
        }
    }
    let of = |name: &str| columns.iter().find(|own| own["name"] == name).unwrap();
    assert_eq!(of("hinge.lambda.x")["unit"], "N");
    assert_eq!(of("link1.tip_angle")["quantity"], "position");
    assert_eq!(of("link1.tip_angle")["marker"]["name"], "link1.tip");
    assert_eq!(of("link2.start_vy")["quantity"], "velocity");
}

#[test]
fn mistakes_are_told() {
    let workshop = run(OSCILLATOR, &[]);
    let plot = |more: &[&str]| workshop.run(&[&["plot", "out"], more].concat());
    plot(&["--columns", "mas.x"]).fails(2, &["mas.x", "mass1.x", "--list"]);
    plot(&["--columns", "a[x"]).fails(2, &["a[x", "pattern"]);
    plot(&["--from", "0.5", "--to", "0.5"]).fails(2, &["--from 0.5", "--to 0.5"]);
    plot(&["--from", "7", "--to", "8"]).fails(2, &["nothing to draw", "t = 7 s"]);
    plot(&["--from", "soon"]).fails(2, &["soon", "time in s"]);
    plot(&["--file", "picture.pdf"]).fails(2, &["picture.pdf", ".svg or .png"]);
    plot(&["--file", "no/picture.svg"]).fails(1, &["no/picture.svg", "directory"]);
    workshop
        .run(&["plot", "nowhere"])
        .fails(2, &["nowhere", "run.json", "linchpin run"]);
    workshop.write("out/run.json", "{\"study\": \"converge\"}");
    plot(&[]).fails(2, &["out/run.json", "not that of a run"]);
}

#[test]
fn tables_that_do_not_fit_are_refused() {
    let workshop = run(OSCILLATOR, &[]);
    let table = workshop.read("out/results.csv");
    let plot = || workshop.run(&["plot", "out"]);
    let broken = table.replacen("\n0.001,", "\n0.001s,", 1);
    assert_ne!(broken, table);
    workshop.write("out/results.csv", broken);
    plot().fails(2, &["out/results.csv:3", "column t", "0.001s"]);
    workshop.write("out/results.csv", table.replacen("mass1.x", "mass1.y", 1));
    plot().fails(2, &["other columns"]);
    workshop.write("out/results.csv", table.lines().next().unwrap());
    plot().fails(2, &["no rows"]);
    std::fs::remove_file(workshop.path().join("out/results.csv")).unwrap();
    plot().fails(2, &["cannot read out/results.csv"]);
}
