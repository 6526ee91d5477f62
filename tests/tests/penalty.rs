//! Penalty coupling (force/force): converges to bodies with springs and dampers between them, not to rigid joints.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::setup::Options;
use linchpin_tests::convergence::{Study, assert_orders};
use linchpin_tests::errors::{Errors, closed_form};
use linchpin_tests::evidence;
use linchpin_tests::in_space::joints;
use linchpin_tests::in_space::pair::Pair;
use linchpin_tests::masses::{FOUR, scene_text};
use linchpin_tests::runs::{run, try_run};
use linchpin_tests::scenes::{oscillator_with, with_settings};
use linchpin_tests::spring_pair::SpringPair;
use linchpin_tests::tuning::{OSCILLATOR, TABLE_HEAD, tune};

const STIFFNESS: f64 = 3.1e4;
const DAMPING: f64 = 43.0;

/// Settings and the orders of position, state and spring force. In the first step the force is held, an error of order 2 that
/// stays.
const ORDERS: [(&str, [f64; 3]); 7] = [
    ("degree=0", [1.0, 1.0, 1.0]),
    ("degree=1", [2.0, 2.0, 2.0]),
    ("degree=2", [2.0, 2.0, 2.0]),
    ("degree=3", [2.0, 2.0, 2.0]),
    ("order=gauss-seidel degree=0", [1.0, 1.0, 1.0]),
    ("order=gauss-seidel degree=1", [2.0, 2.0, 2.0]),
    ("order=gauss-seidel degree=2", [2.0, 2.0, 2.0]),
];

#[test]
fn orders_against_masses_with_a_spring_and_a_damper() {
    let pair = SpringPair::new(&FOUR[0], &FOUR[1], STIFFNESS, DAMPING);
    let exact = |column: &str, t: f64| {
        let states = ["mass1.x", "mass1.v", "mass2.x", "mass2.v"];
        match states.iter().position(|name| *name == column) {
            Some(place) => Some(pair.state(t)[place]),
            None => (column == "link1.lambda").then(|| pair.force(t)),
        }
    };
    assert_orders(&ORDERS, 0.15, |coupling| {
        Study::new(&[4e-4, 2e-4, 1e-4, 5e-5], |h| {
            let text = scene_text(&FOUR[..2], &[(0, 1)], &[0, 1]);
            let springs = format!("stiffness={STIFFNESS:e} damping={DAMPING:e}");
            let coupling = format!("method=penalty {coupling} {springs} macro_step={h:e}");
            Errors::of(
                &run(&with_settings(&text, &coupling, &[]), Place::InProcess),
                exact,
            )
        })
    });
}

/// Without damping the kinetic energy and that of the springs, K g^2/2, stay together: only loads that pull a condition shut do
/// that. Every joint, and the load evaluated by the worker or sent as force and moment.
#[test]
fn springs_store_the_work_of_every_joint() {
    for joint in joints::all() {
        for loads in ["worker", "master"] {
            let stiffness = 2e3;
            let pair = Pair::floating(joint);
            let scene = pair.scene(
                &format!(
                    "method=penalty stiffness={stiffness} angular_stiffness={stiffness} degree=2 loads={loads} macro_step=1e-4"
                ),
                0.1,
            );
            let trajectory = run(&scene, Place::InProcess);
            let openings: Vec<_> = trajectory
                .columns
                .iter()
                .filter(|name| name.starts_with("joint.residual.position"))
                .map(|name| trajectory.column(name))
                .collect();
            let stored = |row: usize| {
                let squares = openings.iter().map(|opening| opening[row] * opening[row]);
                0.5 * stiffness * squares.sum::<f64>()
            };
            let kinetic = pair.energies(&trajectory);
            let most_stored = (0..kinetic.len()).map(stored).fold(0.0, f64::max);
            let changes = kinetic.iter().enumerate();
            let changes = changes.map(|(row, energy)| (energy + stored(row) - kinetic[0]).abs());
            let change = changes.fold(0.0, f64::max);
            println!(
                "{} {loads}: {change:e} of {most_stored:e}",
                joints::name(&joint)
            );
            assert!(
                most_stored > 1e-5 && change < 1e-3 * most_stored,
                "{} {loads}: {change:e} of {most_stored:e}",
                joints::name(&joint)
            );
        }
    }
}

#[test]
fn a_joint_without_its_spring_is_refused() {
    let universal = joints::all()[1];
    for (given, joint, words) in [
        (
            "stiffness=1e3",
            universal,
            ["holds angles", "angular_stiffness = 1e4"],
        ),
        (
            "angular_stiffness=1e3",
            universal,
            ["holds lengths", "stiffness = 1e6"],
        ),
    ] {
        let scene = Pair::floating(joint).scene(&format!("method=penalty {given}"), 0.1);
        let error = try_run(&scene, Place::InProcess, &Options::default()).unwrap_err();
        let message = error.to_string();
        for word in ["coupling.method", "joint \"joint\""].iter().chain(&words) {
            assert!(message.contains(word), "no {word:?} in {message}");
        }
    }
}

/// As with a rigid joint: the spring would shoot the bodies together.
#[test]
fn a_joint_that_is_open_at_the_start_is_refused() {
    let coupling = "method=penalty stiffness=1e5 damping=200";
    let scene = oscillator_with(coupling, &["subsystem.mass2.parameters.x0=0.07"]);
    let error = try_run(&scene, Place::InProcess, &Options::default()).unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("link.residual.position is 0.07"),
        "{message}"
    );
    let options = Options {
        accept_open_joints: true,
        ..Options::default()
    };
    let force = try_run(&scene, Place::InProcess, &options).unwrap();
    assert!((force.column("link.lambda")[0] - 7e3).abs() < 1e-9);
}

/// Stiffness goes with 1/H^2 and damping with 1/H, the error with H^2; index 1 of degree 1 has 8.3e-9 at H = 1e-3.
#[test]
fn tuned_springs_reach_their_errors() {
    for tuned in OSCILLATOR {
        let springs = [tuned.stiffness, tuned.damping];
        let error = oscillator_error("jacobi", tuned.degree, springs, tuned.macro_step);
        assert!(
            (error / tuned.error - 1.0).abs() < 0.05,
            "{error:e} {tuned:?}"
        );
    }
}

const COMMAND: &str =
    "cargo test --release -p linchpin-tests --test penalty -- --ignored --nocapture";

/// What penalty coupling can reach on S1's oscillator if stiffness and damping are tuned with the solution known.
#[test]
#[ignore = "prints a table of docs/evidence/methods.md, and writes it with LINCHPIN_WRITE=1"]
fn best_springs_of_the_oscillator() {
    let mut table = TABLE_HEAD.to_owned();
    for h in [1e-2_f64, 5e-3, 2e-3, 1e-3, 5e-4] {
        for order in ["jacobi", "gauss-seidel"] {
            for degree in 0..=3 {
                let best = tune([-2.0 * h.log10(), -h.log10()], 3, |values| {
                    oscillator_error(order, degree, values, h)
                });
                table += &best.row(h, order, degree);
            }
        }
    }
    evidence::show("methods.md", "springs of the oscillator", COMMAND, &table);
}

/// NRMS of the position of the first mass.
fn oscillator_error(order: &str, degree: usize, [stiffness, damping]: [f64; 2], h: f64) -> f64 {
    let coupling = format!(
        "method=penalty order={order} degree={degree} stiffness={stiffness:e} damping={damping:e} macro_step={h:e}"
    );
    let scene = oscillator_with(&coupling, &["scene.t_end=0.5"]);
    match try_run(&scene, Place::InProcess, &Options::default()) {
        Ok(trajectory) => Errors::of(&trajectory, closed_form(&scene)).x,
        Err(_) => f64::INFINITY,
    }
}
