//! Runs that ask for too much.

use linchpin::connect::Place;
use linchpin_master::setup::Options;
use linchpin_tests::runs::try_run;
use linchpin_tests::scenes::with_settings;

const STIFF: &str = include_str!("../../../scenes/hard/stiff-spring.toml");

fn refusal(coupling: &str) -> String {
    let scene = with_settings(STIFF, coupling, &[]);
    let error = try_run(&scene, Place::InProcess, &Options::default()).unwrap_err();
    error.to_string()
}

#[test]
fn a_least_step_that_is_too_long_is_told_with_place_and_variable() {
    let error = refusal("least_step=1e-3 macro_step=2e-3");
    for part in [
        "t = 0 s",
        "H = 0.001 s",
        "coupling.least_step",
        "mass",
        "coupling.tolerance = 1e-6",
        "absolute_tolerance",
    ] {
        assert!(error.contains(part), "{part}: {error}");
    }
}
