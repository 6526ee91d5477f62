//! `linchpin models`, and `linchpin describe --json` of the same models behind a worker.

use linchpin_tests::process::Workshop;

use crate::{json, typed};

#[test]
fn every_model_has_a_line() {
    let outcome = typed(&["models"]);
    outcome.succeeds();
    for model in linchpin_models::models() {
        let name = model.describe().name;
        let is_listed = outcome
            .stdout
            .lines()
            .any(|line| line.split_whitespace().next() == Some(&name));
        assert!(is_listed, "{name}\n{}", *outcome);
    }
}

#[test]
fn a_model_is_shown_with_parameters_variables_and_markers() {
    let outcome = typed(&["models", "pendulum", "dc-motor"]);
    outcome.succeeds();
    let (pendulum, motor) = outcome.stdout.split_once("\nmodel dc-motor").unwrap();
    for piece in [
        "angle0",
        "rad",
        "tip_x",
        "radau5",
        "tip                  planar",
        "default 9.81",
        "greater than 0",
    ] {
        assert!(pendulum.contains(piece), "{piece}\n{pendulum}");
    }
    assert!(
        motor.contains("resistance") && motor.contains("ohm"),
        "{motor}"
    );
}

#[test]
fn json_is_what_a_worker_describes() {
    let all = json(&typed(&["models", "--json"]));
    let workshop = Workshop::new();
    let socket = format!("unix:{}", workshop.path().join("w.sock").display());
    let mut worker = workshop.start(&["worker", "--listen", &socket]);
    worker.wait_until("the worker listens", |own| {
        own.stdout().contains("listening on")
    });
    let outcome = workshop.run(&["describe", &socket, "--json"]);
    outcome.exits_with(0);
    let described = json(&outcome);
    assert_eq!(described["protocol"], "1.4");
    let models = described["models"].as_array().unwrap();
    for own in all.as_array().unwrap() {
        let same = models
            .iter()
            .find(|other| other["name"] == own["name"])
            .unwrap();
        assert_eq!(own, same);
    }
}

#[test]
fn parameters_change_what_is_described() {
    let mistakes = [
        (
            &["models", "pendulun"][..],
            "no built-in model \"pendulun\"; there are: block, ",
        ),
        (
            &["models", "planar-multibody", "-p", "formulation=minimal"],
            "parameters.body",
        ),
        (&["models", "pendulum", "-p", "masss=1"], "masss"),
        (&["models", "pendulum", "-p", "m"], "NAME=VALUE"),
        (&["models", "-p", "m=1"], "NAME"),
    ];
    for (arguments, piece) in mistakes {
        typed(arguments).fails(2, &[piece]);
    }
    typed(&["models", "pendulum", "-p", "m=1"]).succeeds();
}
