//! Steps that were taken back leave no trace.

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_tests::runs::run;
use linchpin_tests::scenes::{RADAU5, oscillator_with, with_settings};
use linchpin_tests::traces::{assert_equal_bits_everywhere, assert_no_trace};

const CRANK: &str = include_str!("../../../scenes/slider-crank.toml");
const UNIVERSAL: &str = include_str!("../../../scenes/spatial/universal-pendulum.toml");

/// Scenes in which steps are rejected: every method, exact and adaptive solvers, loads that turn in the plane and in space, unary calls.
fn scenes() -> Vec<(&'static str, Scene)> {
    let oscillator = |coupling: &str, others: &[&str]| {
        let settings = [others, &["scene.t_end=0.2"]].concat();
        oscillator_with(
            &format!("{coupling} tolerance=1e-4 macro_step=7e-3"),
            &settings,
        )
    };
    let springs = "stiffness=2.7e4 damping=31";
    let all = "stiffness=2.7e4 damping=71 angular_stiffness=2.3e3 angular_damping=7 tolerance=1e-3 macro_step=1e-2";
    let unary = "subsystem.mass1.calls=unary";
    let radau5 = oscillator(&format!("method=penalty degree=2 {springs}"), &[RADAU5]);
    let mut scenes = vec![
        ("explicit", oscillator("method=explicit mu=10H", &[])),
        (
            "explicit, fixed mu",
            oscillator("method=explicit mu=1e-3", &[RADAU5, unary]),
        ),
        ("penalty, radau5", radau5),
        (
            "crank",
            with_settings(
                CRANK,
                &format!("method=penalty {all}"),
                &["scene.t_end=0.2"],
            ),
        ),
        (
            "crank, one after the other",
            with_settings(
                CRANK,
                &format!("method=penalty order=gauss-seidel {all}"),
                &["scene.t_end=0.2"],
            ),
        ),
        (
            "space",
            with_settings(
                UNIVERSAL,
                &format!("method=penalty order=gauss-seidel {all}"),
                &["scene.t_end=0.1"],
            ),
        ),
    ];
    for (name, method, others) in [
        ("penalty", "method=penalty degree=1", vec![unary]),
        (
            "penalty, one after the other",
            "method=penalty order=gauss-seidel degree=2",
            vec![unary],
        ),
        ("jacobi", "method=jacobi degree=1", vec![RADAU5, unary]),
        ("gauss-seidel", "method=gauss-seidel degree=2", vec![RADAU5]),
    ] {
        scenes.push((name, oscillator(&format!("{method} {springs}"), &others)));
    }
    scenes
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

/// Every integration has its cause, also those of steps that were taken back; the workers count as many.
#[test]
fn integrations_that_were_taken_back_are_counted() {
    for (name, scene) in scenes() {
        let found = run(&scene, Place::InProcess);
        let causes = found.statistics.integrations_by_cause;
        assert_eq!(causes.sum(), found.integrations, "{name}: {causes:?}");
        let subsystems = scene.subsystems.len() as u64;
        let steps = found.rows.len() as u64 - 1;
        assert_eq!(causes.corrector, subsystems * steps, "{name}: {causes:?}");
        assert_eq!(
            causes.taken_back,
            subsystems * found.rejected,
            "{name}: {causes:?}"
        );
        let statistics = found.statistics.steps.unwrap();
        assert_eq!(statistics.rejected, found.rejected, "{name}");
        assert!(statistics.shortest.unwrap().length < statistics.longest.unwrap().length);
    }
}
