//! The tolerance is met, relative to the problem that the method solves: bodies with springs and dampers between them, or rigid joints.
//!
//! `cargo test --release -p linchpin-tests --test uncorrected_steps -- --ignored --nocapture table` prints the table of docs/evidence/step-size.md.

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_tests::errors::closed_form;
use linchpin_tests::masses::{FOUR, scene_text};
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::{oscillator_with, with_settings};
use linchpin_tests::spring_pair::SpringPair;

const STIFFNESS: f64 = 3.1e4;
const DAMPING: f64 = 43.0;

/// Two of the four masses with a spring and a damper between them.
fn pair(method: &str) -> Scene {
    let text = scene_text(&FOUR[..2], &[(0, 1)], &[0, 1]);
    let springs = format!("stiffness={STIFFNESS:e} damping={DAMPING:e}");
    with_settings(&text, &format!("{method} {springs}"), &[])
}

/// The largest error of these columns over all rows, relative to the largest value of any.
fn error(trajectory: &Trajectory, columns: &[&str], exact: impl Fn(&str, f64) -> f64) -> f64 {
    let times = trajectory.column("t");
    let (mut most, mut size) = (0.0f64, 0.0f64);
    for column in columns {
        for (t, found) in times.iter().zip(trajectory.column(column)) {
            let exact = exact(column, *t);
            most = most.max((found - exact).abs());
            size = size.max(exact.abs());
        }
    }
    most / size
}

fn error_of_pair(trajectory: &Trajectory) -> f64 {
    let exact = SpringPair::new(&FOUR[0], &FOUR[1], STIFFNESS, DAMPING);
    error(trajectory, &["mass1.x", "mass2.x"], |column, t| {
        exact.state(t)[if column == "mass1.x" { 0 } else { 2 }]
    })
}

/// How much smaller than its tolerance an error may be: a run that is more accurate does too much.
const TOO_CAREFUL: f64 = 1e-3;

fn assert_met(error: f64, tolerance: f64, context: &str) {
    let share = error / tolerance;
    assert!(share < 10.0, "{context}: {error:e} for {tolerance:e}");
    assert!(share > TOO_CAREFUL, "{context}: too careful, {error:e}");
}

/// Methods with the loosest of three tolerances that lie a decade apart. Held loads have an error of order 1, which makes tight ones
/// expensive.
const METHODS: [(&str, f64); 10] = [
    ("method=penalty degree=0", 1e-3),
    ("method=penalty degree=1", 1e-4),
    ("method=penalty degree=2", 1e-4),
    ("method=penalty degree=3", 1e-4),
    ("method=penalty order=gauss-seidel degree=1", 1e-4),
    ("method=penalty order=gauss-seidel degree=2", 1e-4),
    ("method=jacobi degree=1", 1e-3),
    ("method=jacobi degree=2", 1e-4),
    ("method=gauss-seidel degree=1", 1e-3),
    ("method=gauss-seidel degree=2", 1e-4),
];

#[test]
fn masses_with_a_spring_between_them() {
    for (method, loosest) in METHODS {
        for tolerance in [loosest, 1e-1 * loosest, 1e-2 * loosest] {
            let trajectory = run(
                &pair(&format!("{method} tolerance={tolerance:e}")),
                Place::InProcess,
            );
            assert_met(error_of_pair(&trajectory), tolerance, method);
        }
    }
}

/// A rigid joint, with a closing time that follows the step and with one that is fixed.
#[test]
fn explicit_against_the_closed_form() {
    for mu in ["10H", "1e-3"] {
        for tolerance in [1e-3, 1e-4, 1e-5] {
            let coupling = format!("method=explicit mu={mu} tolerance={tolerance:e}");
            let scene = oscillator_with(&coupling, &["scene.t_end=0.5"]);
            let trajectory = run(&scene, Place::InProcess);
            let exact = closed_form(&scene);
            let error = error(&trajectory, &["mass1.x", "mass2.x"], |column, t| {
                exact(column, t).unwrap()
            });
            assert_met(error, tolerance, &coupling);
        }
    }
}

const PENDULUM: &str = include_str!("../../../scenes/double-pendulum.toml");
const CRANK: &str = include_str!("../../../scenes/slider-crank.toml");
const UNIVERSAL: &str = include_str!("../../../scenes/spatial/universal-pendulum.toml");

const SPRINGS: &str =
    "degree=1 stiffness=3.1e4 damping=71 angular_stiffness=2.3e3 angular_damping=7";

/// Mechanisms with loads that turn, against a run of the same scene with a far smaller tolerance; the smallest share of the tolerance that the
/// error may have. On the pendulums the spring and damper of the ground hinge take up what Gauss-Seidel leaves unbalanced, which the master
/// cannot know.
#[test]
fn mechanisms_against_finer_runs() {
    let of_springs = |order: &str| format!("method=penalty order={order} {SPRINGS}");
    let explicit = || "method=explicit mu=10H degree=0 exchanged_degree=0".to_owned();
    let angles = &["link1.angle", "link2.angle"][..];
    let in_space = &["lower.x", "lower.y", "lower.z"][..];
    for (text, columns, method, [finest, middle, loosest], least) in [
        (
            PENDULUM,
            angles,
            of_springs("jacobi"),
            [1e-7, 1e-4, 1e-3],
            1e-3,
        ),
        (
            PENDULUM,
            angles,
            of_springs("gauss-seidel"),
            [1e-5, 1e-3, 1e-2],
            1e-4,
        ),
        (PENDULUM, angles, explicit(), [1e-7, 1e-4, 1e-3], 1e-3),
        (
            CRANK,
            angles,
            of_springs("jacobi"),
            [1e-7, 1e-4, 1e-3],
            1e-3,
        ),
        (
            CRANK,
            angles,
            of_springs("gauss-seidel"),
            [1e-6, 1e-4, 1e-3],
            1e-3,
        ),
        (CRANK, angles, explicit(), [1e-4, 3e-3, 3e-2], 1e-3),
        (
            UNIVERSAL,
            in_space,
            of_springs("jacobi"),
            [1e-7, 1e-4, 1e-3],
            1e-3,
        ),
        (
            UNIVERSAL,
            in_space,
            of_springs("gauss-seidel"),
            [1e-6, 1e-4, 1e-3],
            1e-4,
        ),
        (UNIVERSAL, in_space, explicit(), [1e-4, 3e-3, 3e-2], 1e-3),
    ] {
        let sampled = |tolerance: f64| {
            let coupling = format!("{method} tolerance={tolerance:e}");
            let others = ["scene.t_end=0.7", "output.interval=0.05"];
            run(&with_settings(text, &coupling, &others), Place::InProcess)
        };
        let fine = sampled(finest);
        let times = fine.column("t");
        for tolerance in [middle, loosest] {
            let trajectory = sampled(tolerance);
            let error = error(&trajectory, columns, |column, t| {
                let place = times.iter().position(|time| *time == t).unwrap();
                fine.column(column)[place]
            });
            let share = error / tolerance;
            assert!(
                share < 10.0 && share > least,
                "{method}: {error:e} for {tolerance:e}"
            );
        }
    }
}

/// Rows of the table of docs/evidence/step-size.md: a run with variable steps, and one with as many integrations and a fixed step.
#[test]
#[ignore = "prints the table of docs/evidence/step-size.md"]
fn table() {
    for (method, loosest) in METHODS {
        for tolerance in [loosest, 1e-1 * loosest, 1e-2 * loosest] {
            let scene = pair(&format!("{method} tolerance={tolerance:e}"));
            let own = run(&scene, Place::InProcess);
            let mut fixed = scene.clone().with_fixed_steps();
            let steps = own.integrations as f64 / fixed.subsystems.len() as f64;
            fixed.coupling.macro_step = fixed.t_end / steps;
            println!(
                "| {method} | {tolerance:.0e} | {:.1e} | {} | {} | {} | {:.1e} |",
                error_of_pair(&own),
                own.rows.len() - 1,
                own.rejected,
                own.integrations,
                error_of_pair(&run(&fixed, Place::InProcess)),
            );
        }
    }
}
