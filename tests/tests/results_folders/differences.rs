//! `linchpin diff`.

use serde_json::Value;

use super::{DOUBLE_PENDULUM, OSCILLATOR, run, run_again, set};

#[test]
fn a_run_is_like_itself_and_like_its_repetition() {
    let workshop = run(OSCILLATOR, &[]);
    run_again(&workshop, "again", &[]);
    for other in ["out", "again"] {
        let outcome = workshop.run(&["diff", "out", other]);
        outcome.succeeds();
        for line in ["settings: the same", "all 8 columns are the same"] {
            assert!(outcome.stdout.contains(line), "{outcome}");
        }
    }
}

/// A mass that is a millionth heavier: what differs, and by how much.
#[test]
fn settings_and_columns_that_differ_are_told() {
    let workshop = run(OSCILLATOR, &[]);
    let settings = set(&[
        "subsystem.mass2.parameters.m=2.000002",
        "coupling.macro_step=0.001",
    ]);
    run_again(&workshop, "other", &settings);
    let outcome = workshop.run(&["diff", "out", "other"]);
    outcome.exits_with(1);
    assert!(outcome.stderr.contains("the runs differ: "), "{outcome}");
    let line = |start: &str| {
        let line = outcome
            .stdout
            .lines()
            .find(|line| line.trim_start().starts_with(start));
        line.unwrap_or_else(|| panic!("no {start:?}\n{outcome}"))
            .split_whitespace()
            .collect::<Vec<_>>()
    };
    assert_eq!(
        line("subsystem.mass2.parameters.m"),
        ["subsystem.mass2.parameters.m", "2", "|", "2.000002"]
    );
    assert!(!outcome.stdout.contains("macro_step"), "{outcome}");
    let position = line("mass1.x");
    assert_eq!(position[1], "m");
    let share: f64 = position[3].parse().unwrap();
    assert!((1e-8..1e-4).contains(&share), "{share}");
    workshop
        .run(&["diff", "out", "other", "--tolerance", "0.1"])
        .exits_with(0);
}

#[test]
fn other_times_are_interpolated_and_json_has_everything() {
    let workshop = run(DOUBLE_PENDULUM, &set(&["coupling.method=hermite"]));
    run_again(
        &workshop,
        "fine",
        &set(&["coupling.method=hermite", "coupling.macro_step=7e-4"]),
    );
    let told = workshop.run(&["diff", "out", "fine", "--json"]);
    told.exits_with(1);
    let told: Value = serde_json::from_str(&told.stdout).unwrap();
    assert_eq!(told["equal"], false);
    let run = &told["runs"][0];
    assert_eq!(run["grid"]["is_common"], false);
    assert_eq!(run["grid"]["is_whole"], true);
    let setting = &run["settings"][0];
    assert_eq!(setting["key"], "coupling.macro_step");
    assert_eq!([&setting["a"], &setting["b"]], ["0.001", "0.0007"]);
    // Both runs are right to far below what straight lines miss.
    for column in run["columns"].as_array().unwrap() {
        if column["quantity"] == "position" {
            let of = |key: &str| column[key].as_f64().unwrap();
            assert!(of("largest") > 0.0);
            assert!(
                of("largest") <= 1.1 * of("interpolation") + 1e-9,
                "{column}"
            );
        }
    }
    let text = workshop.run(&["diff", "out", "fine"]);
    assert!(
        text.stdout.contains("straight lines") && text.stdout.contains("missed"),
        "{text}"
    );
}

#[test]
fn a_run_that_is_shorter_or_has_other_columns_differs() {
    let workshop = run(OSCILLATOR, &[]);
    let shorter = set(&["scene.t_end=0.5", "output.variables=[\"mass1.v\"]"]);
    run_again(&workshop, "short", &shorter);
    let outcome = workshop.run(&["diff", "out", "short"]);
    outcome.exits_with(1);
    for piece in [
        "scene.t_end",
        "compared from t = 0 s to 0.5 s",
        "all 8 columns are the same",
    ] {
        assert!(outcome.stdout.contains(piece), "{piece}\n{outcome}");
    }
    run_again(
        &workshop,
        "explicit",
        &set(&["coupling.method=explicit", "coupling.mu=10H"]),
    );
    let outcome = workshop.run(&["diff", "out", "explicit"]);
    assert!(
        outcome
            .stdout
            .contains("only a has the columns error_estimate"),
        "{outcome}"
    );
}

#[test]
fn cases_are_compared_by_their_names() {
    let case = |name: &str, c: &str| {
        format!("\n[[case]]\nname = \"{name}\"\nset = {{ \"subsystem.*.parameters.c\" = {c} }}\n")
    };
    let text =
        |of_hard: &str| OSCILLATOR.to_owned() + &case("soft", "1e3") + &case("hard", of_hard);
    let workshop = run(&text("1e5"), &[]);
    workshop.write("scene.toml", text("2e5") + &case("more", "1e2"));
    run_again(&workshop, "other", &[]);
    let outcome = workshop.run(&["diff", "out", "other"]);
    outcome.exits_with(1);
    let (soft, hard) = outcome.stdout.split_once("case hard").unwrap();
    assert!(
        soft.contains("case soft") && soft.contains("are the same"),
        "{outcome}"
    );
    assert!(
        hard.contains("subsystem.mass1.parameters.c") && hard.contains("200000"),
        "{outcome}"
    );
    assert!(hard.contains("only b has the run more"), "{outcome}");
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let workshop = run(OSCILLATOR, &[]);
    run_again(
        &workshop,
        "later",
        &set(&["scene.t_start=5", "scene.t_end=6"]),
    );
    workshop
        .run(&["diff", "out", "later"])
        .fails(2, &["t = 0 s to 1 s", "later from 5 s to 6 s"]);
    workshop
        .run(&["diff", "out", "nowhere"])
        .fails(2, &["nowhere", "no results"]);
    workshop
        .run(&["diff", "out", "out", "--tolerance", "2"])
        .fails(2, &["from 0 to 1"]);
    let table = workshop.read("out/results.csv");
    let mut lines: Vec<&str> = table.lines().collect();
    lines.swap(3, 4);
    workshop.write("out/results.csv", lines.join("\n"));
    workshop
        .run(&["diff", "out", "later"])
        .fails(2, &["t = 0.002 s follows t = 0.003 s"]);
}
