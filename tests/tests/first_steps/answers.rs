//! Answers for scripts: `--json` of `run` and `check`.

use linchpin_tests::process::Workshop;

use crate::json;

const OSCILLATOR: &str = include_str!("../../../scenes/oscillator.toml");

fn workshop(text: &str) -> Workshop {
    let workshop = Workshop::new();
    workshop.write("scene.toml", text);
    workshop
}

const RUN: [&str; 6] = [
    "run",
    "scene.toml",
    "--in-process",
    "--json",
    "--out",
    "out",
];

#[test]
fn a_run_tells_how_it_ended() {
    let workshop = workshop(OSCILLATOR);
    let outcome = workshop.run(&RUN);
    outcome.succeeds();
    let told = json(&outcome);
    assert_eq!(
        (&told["status"], &told["folder"]),
        (&"done".into(), &"out".into())
    );
    assert_eq!(told["statistics"]["macro_steps"], 1000);
    assert!(told["scene_text"].is_null());
    let diverging = [
        "--set",
        "coupling.method=penalty",
        "--set",
        "coupling.stiffness=1e9",
    ];
    let outcome = workshop.run(&[&RUN[..], &diverging].concat());
    outcome.fails(1, &["diverged"]);
    let told = json(&outcome);
    assert_eq!(told["status"], "failed");
    assert!(
        told["reason"]
            .as_str()
            .unwrap()
            .contains("diverged at t = ")
    );
    // What an earlier run has left is no answer.
    let outcome = workshop.run(&[&RUN[..], &["--set", "subsystem.mass2.parameters.m=-1"]].concat());
    outcome.fails(2, &["-1"]);
    assert_eq!(outcome.stdout, "");
}

#[test]
fn a_run_of_cases_tells_of_each() {
    let cases = "\n[[case]]\nname = \"soft\"\nset = { \"subsystem.*.parameters.c\" = 1e3 }\n\
                 [[case]]\nname = \"hard\"\nset = { \"subsystem.*.parameters.c\" = 1e5 }\n";
    let told = json(&workshop(&(OSCILLATOR.to_owned() + cases)).run(&RUN));
    let runs = told["runs"].as_array().unwrap();
    let of_runs: Vec<_> = runs
        .iter()
        .map(|own| own["case"].as_str().unwrap())
        .collect();
    assert_eq!(of_runs, ["soft", "hard"]);
    assert!(
        runs.iter()
            .all(|own| own["statistics"]["macro_steps"] == 1000)
    );
}

#[test]
fn a_check_tells_mistakes_and_warnings_with_their_places() {
    let workshop = workshop(OSCILLATOR);
    let check = |more: &[&str]| workshop.run(&[&["check", "scene.toml", "--json"], more].concat());
    let outcome = check(&[]);
    outcome.succeeds();
    let told = json(&outcome);
    assert_eq!(
        (&told["ok"], &told["kind"]),
        (&true.into(), &"scene".into())
    );
    let told = json(check(&["--set", "coupling.degree=2"]).exits_with(0));
    assert_eq!(told["warnings"].as_array().unwrap().len(), 1);
    let outcome = check(&["--set", "coupling.degree=17"]);
    outcome.fails(2, &["degree"]);
    let told = json(&outcome);
    assert_eq!(told["ok"], false);
    assert_eq!(told["errors"][0]["origin"], "--set coupling.degree=17");
    workshop.write(
        "scene.toml",
        OSCILLATOR.replace("macro_step", "macro_stepp"),
    );
    let outcome = check(&[]);
    outcome.fails(2, &["macro_stepp"]);
    let told = json(&outcome);
    let mut lines = OSCILLATOR.lines();
    let line = lines.position(|line| line.starts_with("macro_step"));
    let line = line.unwrap() + 1;
    let errors = told["errors"].as_array().unwrap();
    let unknown = errors.iter().find(|own| own["line"] == line).unwrap();
    assert_eq!(unknown["origin"], "scene.toml");
    assert!(unknown["message"].as_str().unwrap().contains("macro_stepp"));
    assert!(unknown["help"].as_str().unwrap().contains("macro_step"));
    assert!(
        json(&workshop.run(&["check", "nowhere.toml", "--json"]))["errors"][0]["message"]
            .is_string()
    );
}
