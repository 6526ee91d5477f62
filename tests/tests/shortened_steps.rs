//! Macro steps that do not divide the time span: the shorter steps at the end keep the order.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_tests::convergence::{Study, assert_orders};
use linchpin_tests::errors::{Errors, closed_form};
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::oscillator_with;

const MACRO_STEPS: [f64; 5] = [2.8e-3, 1.4e-3, 7e-4, 3.5e-4, 1.75e-4];

/// Full steps of the largest H up to the ends of eight runs, spread over a period of the motion so that no error is
/// taken where it changes its sign. Even numbers: an index-2 multiplier of degree 1 alternates.
const FULL_STEPS: [usize; 8] = [108, 120, 132, 144, 156, 168, 180, 192];

/// Settings and the orders of position, state and multiplier at the last macro point, right after the shorter steps.
/// Errors of the first steps have died out there.
const ORDERS: [(&str, [f64; 3]); 21] = [
    ("index=1 beta=2e-1 gamma=1e-2 degree=0", [1.0, 1.0, 1.0]),
    ("index=1 beta=2e-1 gamma=1e-2 degree=1", [2.0, 2.0, 2.0]),
    ("index=1 beta=2e-1 gamma=1e-2 degree=2", [3.0, 3.0, 3.0]),
    ("index=1 beta=2e-1 gamma=1e-2 degree=3", [3.0, 3.0, 3.0]),
    ("index=1 beta=2H gamma=H^2 degree=0", [3.0, 2.0, 1.0]),
    ("index=1 beta=2H gamma=H^2 degree=1", [4.0, 3.0, 2.0]),
    ("index=1 beta=2H gamma=H^2 degree=2", [5.0, 4.0, 3.0]),
    ("index=1 beta=2H gamma=H^2 degree=3", [5.0, 5.0, 4.0]),
    ("index=2 beta=2e-1 degree=0", [2.0, 2.0, 1.0]),
    ("index=2 beta=2e-1 degree=1", [4.0, 4.0, 2.0]),
    ("index=2 beta=2e-3 degree=0", [2.0, 2.0, 1.0]),
    ("index=3 beta=0 degree=0", [4.0, 2.0, 1.0]),
    ("method=weighted index=1 a=1 b=1 degree=0", [3.0, 2.0, 1.0]),
    ("method=weighted index=1 a=1 b=1 degree=1", [4.0, 3.0, 2.0]),
    (
        "method=weighted index=1 a=2 b=2.6 degree=0",
        [3.0, 2.0, 1.0],
    ),
    (
        "method=weighted index=1 a=2 b=2.6 degree=1",
        [4.0, 3.0, 2.0],
    ),
    (
        "method=weighted index=1 a=2 b=2.6 degree=2",
        [5.0, 4.0, 3.0],
    ),
    (
        "method=weighted index=1 a=2 b=2.6 degree=3",
        [5.0, 5.0, 4.0],
    ),
    ("method=weighted index=2 a=1 degree=0", [3.0, 2.0, 1.0]),
    ("method=weighted index=3 degree=0", [4.0, 2.0, 1.0]),
    ("method=explicit mu=1e-2", [1.0, 1.0, 1.0]),
];

const TOLERANCE: f64 = 0.2;

#[test]
fn one_shorter_step_keeps_the_order() {
    assert_orders_at_the_end(0.7);
}

#[test]
fn two_shorter_steps_keep_the_order() {
    assert_orders_at_the_end(0.3);
}

/// The same remainder in units of H for every H, since the error constants depend on it.
fn assert_orders_at_the_end(remainder: f64) {
    assert_orders(&ORDERS, TOLERANCE, |coupling| {
        Study::new(&MACRO_STEPS, |h| {
            errors_of_last_points(coupling, h, remainder)
        })
    });
}

fn errors_of_last_points(coupling: &str, h: f64, remainder: f64) -> Errors {
    let refined = (MACRO_STEPS[0] / h).round();
    let end = |full_steps: usize| (full_steps as f64 * refined + remainder) * h;
    let scenes = FULL_STEPS.map(|full_steps| scene(coupling, h, end(full_steps)));
    let mut last_points = Trajectory::default();
    for scene in &scenes {
        let Trajectory {
            columns, mut rows, ..
        } = run(scene, Place::InProcess);
        last_points.columns = columns;
        last_points.rows.extend(rows.pop());
    }
    Errors::of(&last_points, closed_form(&scenes[0]))
}

fn scene(coupling: &str, h: f64, t_end: f64) -> Scene {
    let coupling = format!("{coupling} macro_step={h:e}");
    let velocities = "output.variables=[\"mass1.v\", \"mass2.v\"]";
    oscillator_with(&coupling, &[&format!("scene.t_end={t_end:?}"), velocities])
}
