//! Subsystems with impacts behind the worker protocol: bits, statistics, coupling.

#![allow(clippy::unwrap_used)]

use linchpin::connect::Place;
use linchpin_master::scene::{Override, Scene, parse};
use linchpin_tests::process::assert_same_bytes_in_processes;
use linchpin_tests::runs::{Trajectory, run};

const ALONE: &str = include_str!("../../scenes/s2/slider-crank.toml");
const CONTROLLED: &str = include_str!("../../scenes/s2/speed-control.toml");
const BALL: &str = include_str!("../../scenes/s2/bouncing-ball.toml");
const INCLINE: &str = include_str!("../../scenes/s2/incline.toml");
const ROCKING: &str = include_str!("../../scenes/s2/rocking-block.toml");
const WOODPECKER: &str = include_str!("../../scenes/s2/woodpecker.toml");

/// A flexible rod with impacts and friction; the notch is reached within some hundred steps.
const FLEXIBLE: [&str; 5] = [
    "subsystem.mechanism.parameters.elements=4",
    "subsystem.mechanism.parameters.c=5e-5",
    "subsystem.mechanism.parameters.friction=0.1",
    "subsystem.mechanism.solver={ kind = \"ed-alpha\", step = 1e-5 }",
    "scene.t_end=0.01",
];

fn scene(text: &str, overrides: &[&str]) -> Scene {
    let overrides: Vec<Override> = overrides.iter().map(|own| own.parse().unwrap()).collect();
    parse(text, "scene.toml", &overrides).unwrap_or_else(|errors| panic!("{errors}"))
}

fn scenes() -> [(&'static str, Vec<&'static str>); 7] {
    [
        (ALONE, vec!["scene.t_end=0.012"]),
        (ALONE, FLEXIBLE.to_vec()),
        (CONTROLLED, vec!["scene.t_end=0.05"]),
        (BALL, vec!["scene.t_end=2.7", "coupling.macro_step=1e-2"]),
        (INCLINE, vec!["scene.t_end=1.0"]),
        (ROCKING, vec!["scene.t_end=0.7"]),
        (WOODPECKER, vec!["scene.t_end=0.13"]),
    ]
}

/// The state holds all that later steps depend on, warm starts of contact forces included: single calls go back and
/// forth by snapshots, also in the middle of contacts.
#[test]
fn threads_and_single_calls_change_no_bit() {
    for (text, overrides) in scenes() {
        let expected = run(&scene(text, &overrides), Place::InProcess).bits();
        assert_eq!(
            run(&scene(text, &overrides), Place::Threads).bits(),
            expected
        );
        let unary = [&overrides[..], &["subsystem.*.calls=unary"]].concat();
        assert_eq!(run(&scene(text, &unary), Place::InProcess).bits(), expected);
    }
}

#[test]
fn worker_processes_change_no_byte() {
    for (text, overrides) in scenes() {
        assert_same_bytes_in_processes(text, &overrides);
    }
}

/// Rows at other times are integrations of their own: the macro steps and their impacts stay as they are.
#[test]
fn samples_between_macro_points_change_no_macro_step() {
    let plain = run(&scene(ALONE, &[]), Place::InProcess);
    let sampled = scene(ALONE, &["output.interval=3e-3"]);
    let sampled = run(&sampled, Place::InProcess);
    assert_eq!(impacts(&plain), impacts(&sampled));
    let last = |run: &Trajectory| run.column("mechanism.omega1").last().unwrap().to_bits();
    assert_eq!(last(&plain), last(&sampled));
}

fn impacts(run: &Trajectory) -> u64 {
    run.statistics.subsystems[0].contacts.unwrap().impacts
}

#[test]
fn impacts_are_in_outputs_and_statistics() {
    let run = run(&scene(ALONE, &[]), Place::InProcess);
    let contacts = run.statistics.subsystems[0].contacts.unwrap();
    let counted: f64 = run.column("mechanism.impacts").iter().sum();
    assert_eq!(counted, contacts.impacts as f64);
    let impulse: f64 = run.column("mechanism.impulse").iter().sum();
    assert!((impulse - contacts.impulse).abs() < 1e-12);
    // Event-driven reference: 2.6925 ms; the step is 1e-5 s.
    let first = contacts.first_impact.unwrap();
    assert!((first - 2.6925e-3).abs() <= 1e-5, "{first}");
    assert!(contacts.residual < 1e-11 && contacts.problems > 100);
    assert!(contacts.penetration < 0.842 * 1e-5);
    assert_eq!((contacts.robust, contacts.ambiguous), (0, 0));
}

/// What the comments on top of the scenes tell.
#[test]
fn scenes_do_what_their_comments_tell() {
    let first = |times: &[f64], is: &dyn Fn(usize) -> bool| {
        let row = (0..times.len()).find(|&row| is(row));
        times[row.unwrap()]
    };
    let ball = run(&scene(BALL, &[]), Place::InProcess);
    let (time, force) = (ball.column("t"), ball.column("ball.normal_ball"));
    let rest = first(&time, &|row| force[row] > 9.8);
    assert!((rest - 2.5587).abs() < 3e-3, "{rest}");
    assert!(force.last().is_some_and(|last| (last - 9.81).abs() < 1e-9));

    let incline = run(&scene(INCLINE, &[]), Place::InProcess);
    let (time, speed) = (incline.column("t"), incline.column("block.speed"));
    let stop = first(&time, &|row| speed[row].abs() < 1e-9);
    assert!((stop - 0.937).abs() <= 5.1e-3, "{stop}");
    let end = *incline.column("block.way").last().unwrap();
    assert!((end - 0.7026107).abs() < 1e-6, "{end}");

    let rocking = run(&scene(ROCKING, &[]), Place::InProcess);
    let rates = rocking.column("block.centre_rate");
    let hit = rocking.column("block.impacts");
    let struck = hit.iter().position(|&impacts| impacts > 0.0).unwrap();
    let ratio = rates[struck] / rates[struck - 1];
    // Between the rows it gains some speed.
    assert!((ratio - 0.883).abs() < 0.02, "{ratio}");
    assert!(rates.last().is_some_and(|last| last.abs() < 1e-12));

    let toy = run(&scene(WOODPECKER, &[]), Place::InProcess);
    let (time, beak) = (toy.column("t"), toy.column("toy.impulse_beak"));
    let strokes: Vec<f64> = (0..time.len())
        .filter(|&row| beak[row] > 0.0)
        .map(|row| time[row])
        .collect();
    assert_eq!(strokes.len(), 5, "{strokes:?}");
    let period = strokes[4] - strokes[3];
    assert!((period - 0.146).abs() < 6e-4, "{period}");
}

/// A flywheel on the shaft of the mechanism, as a subsystem of its own behind a rigid joint, is the same as a crank of
/// more inertia. The slider is guided, so that nothing jumps.
#[test]
fn a_flywheel_behind_a_joint_is_a_heavier_crank() {
    const COUPLED: &str = r#"
[scene]
name = "flywheel"
t_end = 0.06
[coupling]
method = "hermite"
macro_step = 5e-4
[[subsystem]]
name = "flywheel"
model = "pendulum"
parameters = { m = 1.0, inertia = 3.1e-3, length = 0.2, offset = -0.1, gravity = 0.0, rate0 = 70.0 }
[[subsystem]]
name = "mechanism"
model = "slider-crank"
parameters = { guide = "bilateral", friction = 0.0, omega1_0 = 70.0, omega2_0 = -35.0 }
solver = { kind = "bathe", step = 1e-5 }
[[joint]]
name = "shaft"
kind = "orientation"
a = "flywheel.centre"
b = "mechanism.crank"
[output]
variables = ["mechanism.theta1"]
"#;
    const ALONE: &str = r#"
[scene]
name = "heavy-crank"
t_end = 0.06
[coupling]
method = "weighted"
macro_step = 5e-4
[[subsystem]]
name = "mechanism"
model = "slider-crank"
parameters = { guide = "bilateral", friction = 0.0, j1 = 3.174e-3, omega1_0 = 70.0, omega2_0 = -35.0 }
solver = { kind = "bathe", step = 1e-5 }
[output]
variables = ["mechanism.theta1"]
"#;
    let [coupled, alone] = [COUPLED, ALONE].map(|text| {
        let run = run(&scene(text, &[]), Place::InProcess);
        run.column("mechanism.theta1")
    });
    let differences = coupled.iter().zip(&alone).map(|(a, b)| (a - b).abs());
    let largest = differences.fold(0.0, f64::max);
    assert!(*alone.last().unwrap() > 3.0);
    assert!(largest < 1e-6, "{largest:e}");
}
