//! Combinations that are unstable for any small H: the run stops with the place, and `check` knows before.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::RunError;
use linchpin_master::scene::{Scene, warnings};
use linchpin_master::setup::Options;
use linchpin_tests::runs::try_run;
use linchpin_tests::scenes::oscillator;

const UNSTABLE: [&str; 10] = [
    "index=2 beta=2e-3 degree=1",
    "index=2 beta=2e-1 degree=2",
    "index=2 beta=2e-1 degree=3",
    "method=weighted index=2 a=1 degree=1",
    "method=weighted index=2 a=1 degree=2",
    "method=weighted index=1 a=1 b=1 degree=2",
    "method=weighted index=1 a=1 b=1 degree=3",
    "index=1 beta=2e-3 gamma=1e-6 degree=1 macro_step=4e-3",
    "index=1 beta=2e-3 gamma=1e-6 degree=2 macro_step=2.9e-3",
    "index=1 beta=2e-3 gamma=1e-6 degree=3 macro_step=2.1e-3",
];

/// Index 3 closes the joint at every macro point whatever happens in between: only the multiplier grows.
const UNSTABLE_MULTIPLIER: [&str; 4] = [
    "index=3 beta=0 degree=1",
    "index=3 beta=0 degree=2",
    "index=3 beta=0 degree=3",
    "method=weighted index=3 degree=1",
];

fn failure(scene: &Scene) -> RunError {
    match try_run(scene, Place::InProcess, &Options::default()) {
        Ok(_) => panic!("{:?} reached its end", scene.coupling),
        Err(error) => error,
    }
}

#[test]
fn joints_that_come_apart_stop_the_run_with_joint_and_time() {
    for coupling in UNSTABLE {
        let scene = oscillator(coupling);
        let error = failure(&scene);
        let message = error.to_string();
        let RunError::Diverged {
            t,
            step,
            joint,
            opening,
            motion,
        } = error
        else {
            panic!("{coupling}: {error}");
        };
        assert!(
            joint == "link" && step == scene.coupling.macro_step,
            "{message}"
        );
        assert!(
            0.0 < t && t < scene.t_end && opening > 0.5 * motion,
            "{message}"
        );
        assert!(message.contains("joint \"link\""), "{message}");
    }
}

#[test]
fn multipliers_that_grow_stop_the_run_with_joint_and_time() {
    for coupling in UNSTABLE_MULTIPLIER {
        let scene = oscillator(coupling);
        let error = failure(&scene);
        let message = error.to_string();
        let RunError::Grown {
            t,
            step,
            variable,
            value,
            ..
        } = error
        else {
            panic!("{coupling}: {error}");
        };
        assert!(variable == "link.lambda" && value.abs() > 1e12, "{message}");
        assert!(
            0.0 < t && t < scene.t_end && step == scene.coupling.macro_step,
            "{message}"
        );
    }
}

#[test]
fn check_warns_of_all_of_them_and_of_no_stable_one() {
    for coupling in UNSTABLE.into_iter().chain(UNSTABLE_MULTIPLIER) {
        assert_eq!(warnings(&oscillator(coupling)).len(), 1, "{coupling}");
    }
    for coupling in [
        "index=3 beta=0 degree=0",
        "method=weighted index=1 a=1 b=1 degree=1",
        "method=weighted index=1 a=2 b=2.6 degree=3",
        "index=1 beta=2H gamma=H^2 degree=3",
        "index=1 beta=2e-3 gamma=1e-6 degree=1 macro_step=3.4e-3",
        "method=explicit mu=1e-2",
    ] {
        assert_eq!(warnings(&oscillator(coupling)), [], "{coupling}");
    }
}
