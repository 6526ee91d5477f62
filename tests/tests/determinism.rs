//! The same scene gives the same bits: anywhere in this process, over single calls, again, at the same time, in any
//! order of the subsystems.

#![allow(clippy::unwrap_used, missing_docs)]

use std::thread;

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_tests::masses::{FOUR, scene_text};
use linchpin_tests::runs::run;
use linchpin_tests::scenes::{RADAU5, with_settings};

/// Every method, with every degree at which it is stable.
const COUPLINGS: [&str; 30] = [
    "method=hermite variant=apv",
    "method=hermite variant=c0pv",
    "method=hermite variant=c0pv jacobian=every-step",
    "method=hermite tolerance=1e-7",
    "method=hermite increment=derivatives",
    "method=hermite degree=3",
    "method=hermite degree=4 moments=integrals",
    "method=hermite degree=4 moments=integrals increment=derivatives",
    "method=hermite degree=automatic tolerance=1e-9",
    "method=baumgarte index=1 beta=2H gamma=H^2 degree=0",
    "method=baumgarte index=1 beta=2H gamma=H^2 degree=1",
    "method=baumgarte index=1 beta=2H gamma=H^2 degree=2",
    "method=baumgarte index=1 beta=2H gamma=H^2 degree=3",
    "method=baumgarte index=2 beta=2e-1 degree=0",
    "method=baumgarte index=2 beta=2e-1 degree=1",
    "method=baumgarte index=3 degree=0",
    "method=weighted index=1 degree=0",
    "method=weighted index=1 degree=1",
    "method=weighted index=1 degree=2",
    "method=weighted index=1 degree=3",
    "method=weighted index=1 degree=automatic",
    "method=weighted index=2 a=1 degree=0",
    "method=weighted index=3 degree=0",
    "method=explicit mu=1e-2",
    "method=penalty stiffness=1.3e4 damping=57 degree=0",
    "method=penalty stiffness=1.3e4 damping=57 degree=2",
    "method=penalty order=gauss-seidel stiffness=1.3e4 damping=57 degree=1",
    "method=penalty stiffness=1.3e4 damping=57 degree=3",
    "method=penalty order=gauss-seidel stiffness=1.3e4 damping=57 degree=0",
    "method=penalty order=gauss-seidel stiffness=1.3e4 damping=57 degree=3",
];

/// 1e-3 does not divide it: the last two steps are shorter.
const T_END: &str = "scene.t_end=0.04337";

const EXACT: &str = "subsystem.*.solver={ kind = \"exact\" }";

/// The links meet at mass 1. A force on it is the sum of three.
const STAR: [(usize, usize); 3] = [(0, 1), (2, 0), (0, 3)];

fn star(order: [usize; 4], coupling: &str, others: &[&str]) -> Scene {
    let text = scene_text(&FOUR, &STAR, &order);
    let others = [others, &["scene.name=star", T_END]].concat();
    with_settings(&text, coupling, &others)
}

fn for_all_scenes(check: impl Fn(&str, &str)) {
    for coupling in COUPLINGS {
        for solver in [EXACT, RADAU5] {
            check(coupling, solver);
        }
    }
}

const WRITTEN: [usize; 4] = [0, 1, 2, 3];

#[test]
fn threads_single_calls_and_repetition_change_no_bit() {
    for_all_scenes(|coupling, solver| {
        let scene = star(WRITTEN, coupling, &[solver]);
        let all_unary = star(WRITTEN, coupling, &[solver, "subsystem.*.calls=unary"]);
        let one_unary = star(WRITTEN, coupling, &[solver, "subsystem.mass3.calls=unary"]);
        let expected = run(&scene, Place::InProcess).bits();
        let runs = [
            ("again", &scene, Place::InProcess),
            ("threads", &scene, Place::Threads),
            ("single calls", &all_unary, Place::InProcess),
            ("single calls and threads", &all_unary, Place::Threads),
            ("single calls to one worker", &one_unary, Place::Threads),
        ];
        for (what, scene, place) in runs {
            assert!(
                run(scene, place).bits() == expected,
                "{what}: {coupling} {solver}"
            );
        }
    });
}

/// Gauss-Seidel steps the subsystems in the order of the scene, so its results depend on it.
#[test]
fn the_order_of_the_subsystems_changes_no_bit() {
    for_all_scenes(|coupling, solver| {
        let bits = |order| run(&star(order, coupling, &[solver]), Place::InProcess).bits();
        let expected = bits(WRITTEN);
        for order in [[3, 2, 1, 0], [1, 0, 3, 2], [2, 3, 0, 1]] {
            let is_equal = bits(order) == expected;
            assert!(
                is_equal != coupling.contains("gauss-seidel"),
                "{order:?}: {coupling} {solver}"
            );
        }
    });
}

#[test]
fn runs_at_the_same_time_do_not_touch_each_other() {
    for solver in [EXACT, RADAU5] {
        let scenes =
            ["degree=1", "degree=3", "degree=0"].map(|degree| star(WRITTEN, degree, &[solver]));
        let expected = scenes
            .each_ref()
            .map(|scene| run(scene, Place::InProcess).bits());
        thread::scope(|scope| {
            for place in [Place::InProcess, Place::Threads] {
                for (scene, expected) in scenes.iter().zip(&expected) {
                    scope.spawn(move || {
                        for _ in 0..5 {
                            assert!(
                                run(scene, place).bits() == *expected,
                                "{place:?} {:?}",
                                scene.coupling
                            );
                        }
                    });
                }
            }
        });
    }
}

#[test]
fn the_last_steps_are_shorter_and_end_at_the_end() {
    let t = run(&star(WRITTEN, "degree=1", &[]), Place::InProcess).column("t");
    let [.., before, last] = t[..] else {
        panic!("{t:?}")
    };
    assert!(
        t.len() == 45 && last == 0.04337,
        "{} points to {last}",
        t.len()
    );
    assert!(
        (last - before - 0.685e-3).abs() < 1e-12,
        "last step {}",
        last - before
    );
}
