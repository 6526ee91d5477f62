//! Rejected steps leave no trace.

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_tests::runs::run;
use linchpin_tests::scenes::{RADAU5, with_settings};
use linchpin_tests::traces::{assert_equal_bits_everywhere, assert_no_trace};

const STIFF: &str = include_str!("../../../scenes/hard/stiff-spring.toml");
const HEAVY: &str = include_str!("../../../scenes/hard/heavy-end.toml");
const CRANK: &str = include_str!("../../../scenes/slider-crank.toml");

/// Scenes in which steps are rejected: exact and adaptive solvers, loads of fixed and of turning direction.
fn scenes() -> Vec<(&'static str, Scene)> {
    let stiff = |coupling, others: &[&str]| {
        with_settings(STIFF, coupling, &[others, &["scene.t_end=0.02"]].concat())
    };
    let crank = "method=weighted degree=1 tolerance=1e-5 macro_step=1e-2";
    vec![
        ("exact", stiff("tolerance=1e-5 degree=1", &[])),
        (
            "radau5",
            stiff("tolerance=1e-4 degree=2 macro_step=1e-3", &[RADAU5]),
        ),
        (
            "single calls",
            stiff(
                "tolerance=1e-5 degree=3 macro_step=1e-3",
                &["subsystem.mass1.calls=unary"],
            ),
        ),
        (
            "plane",
            with_settings(
                HEAVY,
                "tolerance=1e-6 macro_step=1e-2",
                &["scene.t_end=0.2"],
            ),
        ),
        ("hermite", stiff("method=hermite tolerance=1e-6", &[])),
        (
            "hermite in the plane",
            with_settings(
                HEAVY,
                "method=hermite tolerance=1e-7 macro_step=2e-2",
                &["scene.t_end=0.4"],
            ),
        ),
        (
            "turning loads",
            with_settings(CRANK, crank, &["scene.t_end=0.3"]),
        ),
        (
            "automatic degree",
            stiff("tolerance=1e-5 degree=automatic macro_step=1e-3", &[]),
        ),
        (
            "automatic degrees of loads and motion",
            with_settings(
                CRANK,
                "method=baumgarte index=1 beta=2H gamma=H^2 degree=automatic exchanged_degree=automatic tolerance=1e-5 macro_step=1e-2",
                &["scene.t_end=0.3"],
            ),
        ),
    ]
}

#[test]
fn a_run_with_the_accepted_steps_from_the_beginning_has_equal_bits() {
    for (name, scene) in scenes() {
        assert_no_trace(name, &scene);
    }
}

#[test]
fn threads_and_single_calls_change_no_bit() {
    for (name, scene) in scenes() {
        assert_equal_bits_everywhere(name, &scene);
    }
}

/// Every macro point follows from the one before and the length of the step; the last one is the end.
#[test]
fn steps_lead_to_the_end() {
    for (name, scene) in scenes() {
        let run = run(&scene, Place::InProcess);
        let (t, steps) = (run.column("t"), run.column("step"));
        for (n, pair) in t.windows(2).enumerate() {
            let error = pair[1] - pair[0] - steps[n + 1];
            assert!(error.abs() <= 1e-15 * scene.t_end.max(1.0), "{name}: {n}");
        }
        assert_eq!(t.last(), Some(&scene.t_end), "{name}");
    }
}
