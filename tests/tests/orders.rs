//! Observed orders of convergence of every stable method, index and degree against the closed form (S1 Figs. 6, 11).

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_tests::convergence::{LAMBDA_ROUNDING, Study, assert_orders};
use linchpin_tests::errors::{Errors, closed_form};
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::oscillator_with;

const MACRO_STEPS: [f64; 5] = [1e-3, 5e-4, 2.5e-4, 1.25e-4, 6.25e-5];

/// Tells integer from half orders.
const TOLERANCE: f64 = 0.15;

/// Settings and the orders of position, state and multiplier.
///
/// Half orders come from the first steps, in which the multipliers settle: an error of order q that the constraint damps
/// out within a few macro steps enters a root mean square as q + 1/2. With fixed beta and gamma the error of the start
/// lasts, so degree 3 has there the order of degree 2 (`start.rs`).
const ORDERS: [(&str, [f64; 3]); 25] = [
    ("index=1 beta=2e-1 gamma=1e-2 degree=0", [1.0, 1.0, 1.0]),
    ("index=1 beta=2e-1 gamma=1e-2 degree=1", [2.0, 2.0, 2.0]),
    ("index=1 beta=2e-1 gamma=1e-2 degree=2", [3.0, 3.0, 3.0]),
    ("index=1 beta=2e-1 gamma=1e-2 degree=3", [3.0, 3.0, 3.0]),
    ("index=1 beta=2e-3 gamma=1e-6 degree=0", [1.0, 1.0, 1.0]),
    ("index=1 beta=2e-3 gamma=1e-6 degree=1", [2.0, 2.0, 2.0]),
    ("index=1 beta=2e-3 gamma=1e-6 degree=2", [3.0, 3.0, 3.0]),
    ("index=1 beta=2e-3 gamma=1e-6 degree=3", [3.0, 3.0, 3.0]),
    ("index=1 beta=2H gamma=H^2 degree=0", [3.0, 2.0, 1.0]),
    ("index=1 beta=2H gamma=H^2 degree=1", [4.0, 3.5, 2.0]),
    ("index=1 beta=2H gamma=H^2 degree=2", [4.5, 3.5, 2.5]),
    ("index=1 beta=2H gamma=H^2 degree=3", [4.5, 3.5, 2.5]),
    ("index=2 beta=2e-1 degree=0", [2.0, 2.0, 1.0]),
    ("index=2 beta=2e-1 degree=1", [4.0, 4.0, 2.0]),
    ("index=2 beta=2e-3 degree=0", [2.0, 2.0, 1.0]),
    ("index=3 beta=0 degree=0", [4.0, 2.0, 1.0]),
    ("method=weighted index=1 a=1 b=1 degree=0", [3.0, 2.0, 1.0]),
    ("method=weighted index=1 a=1 b=1 degree=1", [4.0, 3.5, 2.0]),
    (
        "method=weighted index=1 a=2 b=2.6 degree=0",
        [3.0, 2.0, 1.0],
    ),
    (
        "method=weighted index=1 a=2 b=2.6 degree=1",
        [4.0, 3.5, 2.0],
    ),
    (
        "method=weighted index=1 a=2 b=2.6 degree=2",
        [4.5, 3.5, 2.5],
    ),
    (
        "method=weighted index=1 a=2 b=2.6 degree=3",
        [4.5, 3.5, 2.5],
    ),
    ("method=weighted index=2 a=1 degree=0", [3.0, 2.0, 1.0]),
    ("method=weighted index=3 degree=0", [4.0, 2.0, 1.0]),
    ("method=explicit mu=1e-2", [1.0, 1.0, 1.0]),
];

#[test]
fn every_stable_combination_has_its_order() {
    assert_orders(&ORDERS, TOLERANCE, |coupling| {
        Study::new(&MACRO_STEPS, |h| {
            Errors::against_closed_form(&scene(coupling, h))
        })
    });
}

fn scene(coupling: &str, h: f64) -> Scene {
    let coupling = format!("{coupling} macro_step={h:e}");
    let velocities = "output.variables=[\"mass1.v\", \"mass2.v\"]";
    oscillator_with(&coupling, &["scene.t_end=0.5", velocities])
}

/// Errors of position and multiplier that the prototypes of `golden/s1/README.md` found for H = 1e-3 over 0.5 s, with
/// two figures.
const ERRORS: [(&str, f64, f64); 17] = [
    ("index=1 beta=2e-1 gamma=1e-2 degree=0", 5.3e-3, 1.2e-2),
    ("index=1 beta=2e-1 gamma=1e-2 degree=1", 3.7e-5, 9.0e-5),
    ("index=1 beta=2e-1 gamma=1e-2 degree=2", 4.0e-7, 8.6e-7),
    ("index=1 beta=2e-3 gamma=1e-6 degree=0", 5.8e-6, 1.2e-2),
    ("index=1 beta=2e-3 gamma=1e-6 degree=1", 1.9e-8, 5.7e-5),
    ("index=1 beta=2e-3 gamma=1e-6 degree=2", 5.7e-10, 3.8e-6),
    ("index=1 beta=2H gamma=H^2 degree=2", 5.7e-10, 3.8e-6),
    ("index=2 beta=2e-1 degree=0", 2.5e-5, 1.2e-2),
    ("index=2 beta=2e-1 degree=1", 2.0e-9, 7.9e-5),
    ("index=3 beta=0 degree=0", 5.7e-10, 1.4e-2),
    ("method=weighted index=1 a=1 b=1 degree=0", 2.5e-6, 1.2e-2),
    ("method=weighted index=1 a=1 b=1 degree=1", 3.2e-9, 5.7e-5),
    ("method=weighted index=1 a=2 b=2.6 degree=0", 6.4e-6, 1.2e-2),
    ("method=weighted index=1 a=2 b=2.6 degree=1", 8.3e-9, 5.7e-5),
    ("method=weighted index=1 a=2 b=2.6 degree=2", 3.9e-10, 4e-6),
    ("method=weighted index=1 a=2 b=2.6 degree=3", 3.8e-10, 4e-6),
    ("method=weighted index=2 a=1 degree=0", 3.6e-7, 1.2e-2),
];

/// Rounding to two figures, and one to one figure.
const FIGURES: f64 = 0.06;

#[test]
fn errors_at_one_macro_step_are_those_of_the_prototypes() {
    for (coupling, x, lambda) in ERRORS {
        let errors = Errors::against_closed_form(&scene(coupling, 1e-3));
        let differ = |found: f64, noted: f64| (found / noted - 1.0).abs() > FIGURES;
        let is_right = !differ(errors.x, x) && !differ(errors.lambda, lambda);
        assert!(
            is_right,
            "{coupling}: {errors:?}, expected x {x:e}, lambda {lambda:e}"
        );
    }
}

/// With degree 0 the multiplier is the mean over a step: of order 2 in its middle, of order 1 at its end.
#[test]
fn constant_multipliers_belong_to_the_middle_of_their_step() {
    for coupling in [
        "index=1 beta=2H gamma=H^2 degree=0",
        "index=2 beta=2e-1 degree=0",
        "method=weighted index=1 a=1 b=1 degree=0",
        "method=weighted index=1 a=2 b=2.6 degree=0",
        "method=weighted index=2 a=1 degree=0",
    ] {
        let study = Study::new(&MACRO_STEPS, |h| {
            let scene = scene(coupling, h);
            let exact = closed_form(&scene);
            let steps = run(&scene, Place::InProcess).settled();
            Errors::of(&steps, |column, t| exact(column, t - h / 2.0))
        });
        assert_order_2(coupling, &study);
    }
}

/// At index 3 the multiplier alternates about its mean over two steps, which belongs to the point between them.
#[test]
fn at_index_3_the_mean_of_two_steps_has_order_2() {
    for coupling in [
        "index=3 beta=0 degree=0",
        "method=weighted index=3 degree=0",
    ] {
        let study = Study::new(&MACRO_STEPS, |h| {
            let scene = scene(coupling, h);
            let steps = run(&scene, Place::InProcess);
            Errors::of(&means_of_two_steps(&steps), closed_form(&scene))
        });
        assert_order_2(coupling, &study);
    }
}

fn means_of_two_steps(trajectory: &Trajectory) -> Trajectory {
    let place = trajectory
        .columns
        .iter()
        .position(|name| name == "link.lambda")
        .unwrap();
    let mut means = trajectory.clone();
    for n in 0..trajectory.rows.len() - 1 {
        means.rows[n][place] = (trajectory.rows[n][place] + trajectory.rows[n + 1][place]) / 2.0;
    }
    means.rows.pop();
    means.settled()
}

fn assert_order_2(coupling: &str, study: &Study) {
    let order = study.order(|errors| errors.lambda, LAMBDA_ROUNDING);
    assert!(
        (order - 2.0).abs() < 0.1,
        "{coupling}: order {order:.2}\n{study}"
    );
}
