//! What impacts across joints are not possible with is refused by name.

use linchpin::connect::Place;
use linchpin_master::setup::Options;
use linchpin_tests::runs::try_run;

use crate::{SPLIT, scene};

fn refused(text: &str, overrides: &[&str], words: &[&str]) {
    let refused = try_run(
        &scene(text, overrides),
        Place::InProcess,
        &Options::default(),
    );
    let message = refused.unwrap_err().to_string();
    for word in words {
        assert!(message.contains(word), "{word} is not in: {message}");
    }
    let forces = [overrides, &["coupling.impacts=forces", "scene.t_end=1e-3"]].concat();
    assert!(try_run(&scene(text, &forces), Place::InProcess, &Options::default()).is_ok());
}

#[test]
fn methods_that_do_not_correct() {
    let penalty = ["coupling.method=penalty", "coupling.stiffness=1e5"];
    refused(
        SPLIT,
        &penalty,
        &["coupling.method", "\"slider\" has impacts", "hermite"],
    );
}

#[test]
fn an_index_without_velocities() {
    let index_3 = [
        "coupling.method=weighted",
        "coupling.index=3",
        "coupling.degree=0",
    ];
    refused(
        SPLIT,
        &index_3,
        &["coupling.index", "\"slider\"", "index 2 or 1"],
    );
}

#[test]
fn a_variant_that_keeps_the_last_load() {
    let words = ["coupling.variant", "\"slider\"", "variant \"apv\""];
    refused(SPLIT, &["coupling.variant=c0pv"], &words);
}

#[test]
fn a_solver_that_does_not_tell_impacts_from_forces() {
    let moreau = ["subsystem.slider.solver={ kind = \"moreau\", step = 1e-5 }"];
    let words = [
        "subsystem.slider.solver.kind",
        "moreau",
        "generalized-alpha",
        "bathe",
    ];
    refused(SPLIT, &moreau, &words);
}

/// Two sliders at one crank, which meet at its pin and at another one.
#[test]
fn two_that_collide_in_one_mechanism() {
    let second = "\n[[subsystem]]\nname = \"other\"\nmodel = \"rod-slider\"\n\
                  parameters = { x_0 = 0.153, vy_0 = 22.95, omega2_0 = -75.0 }\n\
                  [[joint]]\nname = \"second\"\nkind = \"revolute\"\na = \"crank.tip\"\nb = \"other.pin\"\n";
    let text = format!("{SPLIT}{second}");
    refused(
        &text,
        &[],
        &[
            "subsystem.other.model",
            "\"slider\" and \"other\"",
            "into one subsystem",
        ],
    );
}
