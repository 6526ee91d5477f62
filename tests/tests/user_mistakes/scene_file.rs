//! Mistakes in the scene: told with the line, by `check` and by `run` alike, before any worker is left behind.

use linchpin_tests::process::Workshop;

use crate::{check, exists, oscillator, place, run, workshop};

/// `check` and `run` both refuse the changed scene, at the line with `piece`.
#[track_caller]
fn refused(changes: &[(&str, &str)], piece: &str, words: &[&str]) {
    let workshop = workshop(changes);
    let place = place(&workshop, piece);
    let words = [&[place.as_str()], words].concat();
    workshop.run(&check(&[])).fails(2, &words);
    workshop.run(&run(&[])).fails(2, &words);
    assert!(
        !exists(&workshop, "out/results.csv"),
        "a scene that cannot run leaves no table"
    );
}

#[test]
fn an_unknown_key() {
    refused(
        &[("degree = 0", "degre = 0")],
        "degre =",
        &["degre", "did you mean `degree`?"],
    );
}

#[test]
fn a_wrong_type() {
    refused(
        &[("t_end = 1.0", "t_end = \"1\"")],
        "t_end",
        &["scene.t_end", "a finite number", "\"1\""],
    );
}

#[test]
fn several_mistakes_at_once_in_the_order_of_the_lines() {
    let workshop = workshop(&[
        ("t_end = 1.0", "t_ned = 1.0"),
        ("degree = 0", "degree = 4"),
        ("a = \"mass1\"", "a = \"mas1\""),
    ]);
    let outcome = workshop.run(&check(&[]));
    let places = [
        place(&workshop, "t_ned"),
        place(&workshop, "degree"),
        place(&workshop, "mas1"),
    ];
    outcome.fails(
        2,
        &[
            &places[0], &places[1], &places[2], "`t_end`", "0 to 3", "`mass1`",
        ],
    );
    let found: Vec<_> = places
        .iter()
        .map(|place| outcome.stderr.find(place))
        .collect();
    assert!(found.is_sorted(), "{outcome}");
}

#[test]
fn an_unknown_subsystem_in_a_joint() {
    refused(
        &[("b = \"mass2\"", "b = \"mass3\"")],
        "mass3",
        &["mass3", "mass1, mass2", "did you mean"],
    );
}

#[test]
fn an_unknown_marker() {
    refused(
        &[("b = \"mass2\"", "b = \"mass2.mas\"")],
        "mass2.mas",
        &["mas", "did you mean \"mass\""],
    );
}

#[test]
fn a_joint_that_cannot_hold_its_markers() {
    refused(
        &[("kind = \"rigid-link\"", "kind = \"atpoint\"   ")],
        "\"atpoint\"",
        &[
            "cannot hold scalar markers",
            "scalar markers take a rigid-link",
        ],
    );
}

#[test]
fn too_many_initial_multipliers() {
    refused(
        &[("a = \"mass1\"", "a = \"mass1\"\nmultiplier = [1.0, 2.0]")],
        "[1.0, 2.0]",
        &["2 multipliers, this joint has 1"],
    );
}

#[test]
fn the_initial_multiplier_of_only_one_joint() {
    let third = "[[subsystem]]\nname = \"mass3\"\nmodel = \"oscillator\"\n\
                 parameters = { m = 3.0, v0 = 100.0 }\n\
                 [[joint]]\nname = \"second\"\nkind = \"rigid-link\"\na = \"mass2\"\nb = \"mass3\"\n\
                 multiplier = 1.0\n[output]";
    refused(
        &[("[output]", third)],
        "[[joint]]",
        &["joint.link", "no initial multiplier", "all joints, or none"],
    );
}

#[test]
fn an_unknown_model() {
    refused(
        &[("model = \"oscillator\"  ", "model = \"oscilator\"  ")],
        "oscilator",
        &["no model \"oscilator\"", "did you mean \"oscillator\""],
    );
}

#[test]
fn an_unknown_solver() {
    refused(
        &[("kind = \"exact\" }  ", "kind = \"exakt\" }  ")],
        "exakt",
        &[
            "no solver \"exakt\"",
            "exact, radau5, rk4",
            "did you mean `exact`?",
        ],
    );
}

#[test]
fn an_unknown_option_of_a_solver() {
    let changed = "kind = \"radau5\", rtoll = 1e-9 }  ";
    refused(
        &[("kind = \"exact\" }  ", changed)],
        "rtoll",
        &["rtoll", "did you mean `rtol`?"],
    );
}

#[test]
fn an_option_of_a_solver_that_has_none() {
    let changed = "kind = \"exact\", rtol = 1e-9 }  ";
    refused(
        &[("kind = \"exact\" }  ", changed)],
        "kind = \"exact\", rtol",
        &["rtol", "known: none"],
    );
}

#[test]
fn an_unknown_parameter() {
    refused(
        &[("c = 1000.0", "cc = 1000.0")],
        "cc =",
        &["parameters.cc", "m, c, d", "did you mean `c`?"],
    );
}

#[test]
fn a_negative_mass() {
    refused(
        &[("m = 2.0", "m = -2.0")],
        "m = -2.0",
        &["parameters.m", "-2", "greater than 0"],
    );
}

#[test]
fn mistakes_in_several_subsystems_are_told_together() {
    let workshop = workshop(&[("m = 1.0", "m = 0.0"), ("m = 2.0", "mm = 2.0")]);
    let places = [place(&workshop, "m = 0.0"), place(&workshop, "mm = 2.0")];
    workshop
        .run(&check(&[]))
        .fails(2, &[&places[0], &places[1], "mass1", "mass2"]);
}

#[test]
fn a_negative_mass_beside_a_worker_elsewhere() {
    let workshop = workshop(&[
        (
            "model = \"oscillator\"  ",
            "address = \"http://127.0.0.1:9\"\n#",
        ),
        ("m = 2.0", "m = -2.0"),
    ]);
    let place = place(&workshop, "m = -2.0");
    workshop
        .run(&check(&[]))
        .fails(2, &[&place, "greater than 0"]);
}

#[test]
fn a_macro_step_longer_than_the_run() {
    refused(
        &[("macro_step = 1e-3", "macro_step = 1.5")],
        "macro_step",
        &["1.5", "t_end - t_start = 1 s", "smaller macro step"],
    );
}

#[test]
fn a_degree_that_does_not_exist() {
    refused(
        &[("degree = 0", "degree = 4")],
        "degree = 4",
        &["0 to 3", "found 4"],
    );
}

#[test]
fn a_joint_that_is_open_at_the_start() {
    let changes = [(
        "c = 1000.0, d = 10.0, x0 = 0.0",
        "c = 1000.0, d = 10.0, x0 = 0.25",
    )];
    refused(
        &changes,
        "[[joint]]",
        &["joint.link", "residual.position is -0.25", "initial values"],
    );
}

/// They are no mistake, but how they share their load is not determined: the run says so, however quiet it is to be.
#[test]
fn two_joints_that_demand_the_same() {
    let again = "[[joint]] # again\nname = \"again\"\nkind = \"rigid-link\"\na = \"mass2\"\nb = \"mass1\"\n\n[output]";
    let workshop = workshop(&[("[output]", again)]);
    workshop.run(&check(&[])).exits_with(0);
    let outcome = workshop.run(&run(&["-q"]));
    outcome.exits_with(0);
    for words in [
        "warning: the joints again, link",
        "1 redundant condition",
        "least norm",
    ] {
        assert!(outcome.stderr.contains(words), "{}", outcome.stderr);
        assert!(words.starts_with("warning") || workshop.read("out/run.json").contains(words));
    }
}

#[test]
fn a_joint_of_a_subsystem_with_itself() {
    refused(
        &[("b = \"mass2\"", "b = \"mass1\"")],
        "b = \"mass1\"",
        &["both sides on subsystem \"mass1\""],
    );
}

#[test]
fn an_output_that_does_not_exist() {
    let variables = |name: &str| format!("variables = [\"{name}\"]\nevery = 1");
    refused(
        &[("every = 1", &variables("mass1.acc"))],
        "variables = ",
        &["mass1.acc", "x, v, a"],
    );
    refused(
        &[("every = 1", &variables("mas1.a"))],
        "variables = ",
        &["mas1", "did you mean `mass1`?"],
    );
    refused(
        &[("every = 1", &variables("a"))],
        "variables = ",
        &["\"a\"", "SUBSYSTEM.OUTPUT"],
    );
}

#[test]
fn cases_whose_results_would_go_to_one_folder() {
    let case =
        |name: &str| format!("[[case]]\nname = \"{name}\"\nset = {{ \"coupling.degree\" = 1 }}\n");
    let cases = [case("k = 1"), case("k: 1"), "[output]".to_owned()].concat();
    refused(
        &[("[output]", &cases)],
        "k: 1",
        &["folder k-1", "case \"k = 1\""],
    );
    let cases = [case("!?"), "[output]".to_owned()].concat();
    refused(&[("[output]", &cases)], "!?", &["no folder can be named"]);
}

#[test]
fn a_file_that_is_no_scene() {
    let workshop = Workshop::new();
    workshop
        .run(&check(&[]))
        .fails(2, &["no scene file scene.toml", "current folder"]);
    workshop
        .run(&["run", "."])
        .fails(2, &["scene file . cannot be read", "directory"]);
    workshop.write("scene.toml", "[scene\nname = 1");
    workshop
        .run(&check(&[]))
        .fails(2, &["scene.toml:1:7", "not TOML"]);
    workshop.write("scene.toml", b"[scene]\nname = \"\xff\"");
    workshop
        .run(&check(&[]))
        .fails(2, &["scene.toml", "not UTF-8", "byte 16"]);
    workshop.write("scene.toml", "");
    workshop
        .run(&check(&[]))
        .fails(2, &["lacks `scene`", "[scene]"]);
}

#[test]
fn a_sound_scene_is_sound() {
    let workshop = Workshop::new();
    workshop.write("scene.toml", oscillator(&[]));
    workshop
        .run(&check(&[]))
        .succeeds()
        .prints(&["scene.toml: ok"]);
}
