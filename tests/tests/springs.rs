//! Force/displacement coupling converges to masses with a spring and a damper between them, not to rigid joints.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::cosimulation::Options;
use linchpin_master::scene::Scene;
use linchpin_tests::convergence::{Study, assert_orders};
use linchpin_tests::errors::{Errors, closed_form};
use linchpin_tests::masses::{FOUR, scene_text};
use linchpin_tests::runs::{run, try_run};
use linchpin_tests::scenes::{oscillator_with, with_settings};
use linchpin_tests::spring_pair::SpringPair;
use linchpin_tests::tuning::{Tuned, tune};

/// Springs at one marker add up: two joints with end a at mass 1 couple as the same joints with their ends exchanged,
/// which sit in masses 2 and 3.
#[test]
fn joints_may_share_a_marker_at_either_end() {
    let x = |links: &[(usize, usize)]| {
        let text = scene_text(&FOUR[..3], links, &[0, 1, 2]);
        let coupling = "method=jacobi stiffness=3.1e4 damping=43 degree=1 macro_step=5e-5";
        let scene = with_settings(&text, coupling, &["scene.t_end=0.1"]);
        run(&scene, Place::InProcess).column("mass1.x")
    };
    let (inside, outside) = (x(&[(0, 1), (0, 2)]), x(&[(1, 0), (2, 0)]));
    let largest = inside.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let pairs = inside.iter().zip(&outside);
    let difference = pairs
        .map(|(one, other)| (one - other).abs())
        .fold(0.0, f64::max);
    assert!(difference < 1e-4 * largest, "{difference:e} of {largest:e}");
}

const STIFFNESS: f64 = 3.1e4;
const DAMPING: f64 = 43.0;

/// Settings and the orders of position, state and spring force. The first step extrapolates the motion of the partner
/// by its initial position alone, an error of order 2 that stays: degree 2 and 3 gain no order.
const ORDERS: [(&str, [f64; 3]); 8] = [
    ("method=jacobi degree=0", [1.0, 1.0, 1.0]),
    ("method=jacobi degree=1", [2.0, 2.0, 2.0]),
    ("method=jacobi degree=2", [2.0, 2.0, 2.0]),
    ("method=jacobi degree=3", [2.0, 2.0, 2.0]),
    ("method=gauss-seidel degree=0", [1.0, 1.0, 1.0]),
    ("method=gauss-seidel degree=1", [2.0, 2.0, 2.0]),
    ("method=gauss-seidel degree=2", [2.0, 2.0, 2.0]),
    ("method=gauss-seidel degree=3", [2.0, 2.0, 2.0]),
];

#[test]
fn orders_against_the_model_with_springs() {
    let pair = SpringPair::new(&FOUR[0], &FOUR[1], STIFFNESS, DAMPING);
    let exact = |column: &str, t: f64| {
        let place = ["mass1.x", "mass1.v", "mass2.x", "mass2.v"]
            .iter()
            .position(|name| *name == column);
        match (place, column) {
            (Some(place), _) => Some(pair.state(t)[place]),
            (None, "link1.lambda") => Some(pair.force(t)),
            _ => None,
        }
    };
    assert_orders(&ORDERS, 0.15, |coupling| {
        Study::new(&[4e-4, 2e-4, 1e-4, 5e-5], |h| {
            let text = scene_text(&FOUR[..2], &[(0, 1)], &[0, 1]);
            let springs = format!("stiffness={STIFFNESS:e} damping={DAMPING:e}");
            let scene = with_settings(
                &text,
                &format!("{coupling} {springs} macro_step={h:e}"),
                &[],
            );
            Errors::of(&run(&scene, Place::InProcess), exact)
        })
    });
}

/// S1's masses with rigid and with penalty coupling, at the same number of integrations. The degrees are those with the smallest
/// errors in the table of [`best_springs`].
#[test]
fn a_rigid_joint_of_degree_1_is_far_better_at_equal_integrations() {
    let rigid = rigid_scene(
        "method=weighted index=1 a=2 b=2.6 degree=1 macro_step=1e-3 jacobian=every-step",
    );
    let rigid_run = run(&rigid, Place::InProcess);
    let rigid_error = Errors::of(&rigid_run, closed_form(&rigid)).x;
    // Prediction, perturbed step and correction against one step.
    let h = 1e-3 / 3.0;
    for (method, best_degree) in [("jacobi", 1), ("gauss-seidel", 3)] {
        let best = best_of_degree(method, best_degree, h);
        let scene = springs(method, best_degree, best.values(), h);
        let integrations = run(&scene, Place::InProcess).integrations;
        assert_eq!(integrations, rigid_run.integrations, "{best:?}");
        assert!(
            best.error > 2e4 * rigid_error,
            "rigid {rigid_error:e}, {best:?}"
        );
    }
}

/// What penalty coupling can reach if stiffness and damping are tuned with the solution known. It asserts nothing and
/// only prints, for the comparison in the documentation.
#[test]
#[ignore = "prints a table"]
fn best_springs() {
    for h in [2e-3, 1e-3, 5e-4, 2.5e-4] {
        for method in ["jacobi", "gauss-seidel"] {
            for degree in 0..=3 {
                let best = best_of_degree(method, degree, h);
                println!("H = {h:e} {method} k = {degree}: {best:?}");
            }
        }
    }
}

fn rigid_scene(coupling: &str) -> Scene {
    oscillator_with(coupling, &["scene.t_end=0.5"])
}

fn springs(method: &str, degree: usize, [stiffness, damping]: [f64; 2], h: f64) -> Scene {
    rigid_scene(&format!(
        "method={method} degree={degree} stiffness={stiffness:e} damping={damping:e} macro_step={h:e}"
    ))
}

/// The smallest error in the position of the first mass against the rigid joint.
fn best_of_degree(method: &str, degree: usize, h: f64) -> Tuned {
    tune([4.0, 1.5], 6, |values| {
        let scene = springs(method, degree, values, h);
        match try_run(&scene, Place::InProcess, &Options::default()) {
            Ok(trajectory) => Errors::of(&trajectory, closed_form(&scene)).x,
            Err(_) => f64::INFINITY,
        }
    })
}
