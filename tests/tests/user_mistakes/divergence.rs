//! Runs that diverge.

use crate::{check, exists, rows, run, workshop};

#[test]
fn an_unstable_method_is_warned_about_and_stopped() {
    let changes = [
        ("beta = 2e-3", ""),
        ("index = 2", "index = 3"),
        ("degree = 0", "degree = 1"),
    ];
    let workshop = workshop(&changes);
    let warning = [
        "warning:",
        "scene.toml:",
        "index 3 with degree 1 is unstable",
        "degree = 0, or index = 1",
    ];
    workshop.run(&check(&[])).succeeds().says(&warning);
    let outcome = workshop.run(&run(&[]));
    outcome
        .fails(
            1,
            &[
                "diverged at t = 0.0",
                "link",
                "coupling.degree",
                "out/results.csv",
            ],
        )
        .says(&warning);
    let rows = rows(&workshop);
    assert!(rows.len() > 5, "{outcome}");
    let last = rows.last().unwrap()[0];
    assert!(
        last > 0.0 && outcome.stderr.contains("diverged at t ="),
        "{outcome}"
    );
    let report = workshop.read("out/run.json");
    assert!(report.contains("\"status\": \"failed\""), "{report}");
}

#[test]
fn springs_that_are_too_stiff() {
    let workshop = workshop(&[]);
    let settings = [
        "coupling.method=penalty",
        "coupling.stiffness=1e9",
        "coupling.damping=0",
    ];
    let settings = settings.map(|setting| ["--set", setting]).concat();
    let outcome = workshop.run(&run(&settings));
    outcome.fails(
        1,
        &[
            "diverged at t =",
            "coupling.macro_step",
            "coupling.stiffness",
        ],
    );
    assert!(rows(&workshop).len() > 1, "{outcome}");
}

#[test]
fn a_case_that_diverges_is_named_and_the_others_keep_their_results() {
    let cases = "[[case]]\nname = \"sound\"\nset = { \"coupling.degree\" = 0 }\n\n[[case]]\nname = \"unsound\"\n\
                 set = { \"coupling.degree\" = 1 }\n\n[output]";
    let changes = [
        ("beta = 2e-3", ""),
        ("index = 2", "index = 3"),
        ("[output]", cases),
    ];
    let workshop = workshop(&changes);
    let outcome = workshop.run(&run(&[]));
    outcome.fails(
        1,
        &["case \"unsound\"", "diverged", "out/unsound/results.csv"],
    );
    assert!(exists(&workshop, "out/sound/run.json"), "{outcome}");
}
