//! Joints whose bodies are given with a few digits: `coupling.start_tolerance`.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_proto::v1::value::Kind;
use linchpin_tests::in_space::joints;
use linchpin_tests::in_space::pair::Pair;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;

const DOUBLE_PENDULUM: &str = include_str!("../../scenes/double-pendulum.toml");
const OSCILLATOR: &str = include_str!("../../scenes/oscillator.toml");

const HERMITE: &str = "method=hermite degree=3 macro_step=5e-3";

/// The double pendulum whose link 2 starts where the tip of link 1 is, up to the fifth digit.
fn rounded(more: &[&str]) -> Scene {
    let settings = [
        &[
            "subsystem.link2.parameters.x0=0.70712",
            "subsystem.link2.parameters.y0=0.70709",
            "scene.t_end=0.1",
        ],
        more,
    ]
    .concat();
    with_settings(DOUBLE_PENDULUM, HERMITE, &settings)
}

fn refusal(scene: &Scene) -> String {
    try_run(scene, Place::InProcess, &Options::default())
        .unwrap_err()
        .to_string()
}

/// Largest residual of all joints on position level.
fn gap(trajectory: &Trajectory) -> f64 {
    let names = trajectory.columns.iter();
    let of_positions = names.filter(|name| name.contains("residual.position"));
    let all = of_positions.flat_map(|name| trajectory.column(name));
    all.fold(0.0, |most, value| value.abs().max(most))
}

/// The gap in the axes of link 2, which start at -45 degrees.
fn gap_in_axes_of_link_2() -> [f64; 2] {
    let root = 0.5_f64.sqrt();
    let [x, y] = [root - 0.70712, root - 0.70709];
    [root * (x - y), root * (x + y)]
}

#[test]
fn without_a_tolerance_the_scene_is_refused_and_the_advice_serves() {
    let message = refusal(&rounded(&[]));
    assert!(
        message.contains("the joint is open at t = 0 s"),
        "{message}"
    );
    let advised = message.split("coupling.start_tolerance = ").nth(1);
    let advised: String = { advised.unwrap().chars() }
        .take_while(|&c| c.is_ascii_digit() || "e-.".contains(c))
        .collect();
    let setting = format!("coupling.start_tolerance={advised}");
    assert!(gap(&run(&rounded(&[&setting]), Place::InProcess)) < 1e-9);
}

#[test]
fn the_joint_is_shifted_by_the_gap() {
    let fitted = run(
        &rounded(&["coupling.start_tolerance=1e-4"]),
        Place::InProcess,
    );
    let [x, y] = gap_in_axes_of_link_2();
    let [told] = &fitted.statistics.fitted_joints[..] else {
        panic!("{:?}", fitted.statistics.fitted_joints);
    };
    assert_eq!(told.joint, "hinge");
    assert!((told.shift / x.hypot(y) - 1.0).abs() < 1e-6, "{told:?}");
    assert_eq!(told.turn, 0.0);
    assert!(gap(&fitted) < 1e-10, "{}", gap(&fitted));
    // It is the run of a scene that says the same.
    let point = format!("joint.hinge.point_b=[{x:e}, {y:e}]");
    let explicit = run(&rounded(&[&point]), Place::InProcess);
    for column in ["link1.angle", "link2.angle", "hinge.lambda.x"] {
        let pairs = fitted
            .column(column)
            .into_iter()
            .zip(explicit.column(column));
        let off = pairs.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        let size = explicit.column(column)[0].abs();
        assert!(off < 1e-9 * size.max(1.0), "{column}: {off:e}");
    }
}

#[test]
fn what_is_closed_is_not_touched() {
    let scene = |more: &[&str]| with_settings(DOUBLE_PENDULUM, HERMITE, more);
    let given = run(&scene(&["scene.t_end=0.1"]), Place::InProcess);
    let tolerant = ["scene.t_end=0.1", "coupling.start_tolerance=1e-3"];
    let tolerant = run(&scene(&tolerant), Place::InProcess);
    assert!(tolerant.statistics.fitted_joints.is_empty());
    assert_eq!(given.bits(), tolerant.bits());
}

/// A study that starts from a state with open joints means that state.
#[test]
fn where_open_joints_are_accepted_none_is_fitted() {
    let options = Options {
        accept_open_joints: true,
        ..Options::default()
    };
    let scene = rounded(&["coupling.start_tolerance=1e-4"]);
    let open = try_run(&scene, Place::InProcess, &options).unwrap();
    assert!(open.statistics.fitted_joints.is_empty());
    let found = open.column("hinge.residual.position.y")[0];
    let expected = 0.5_f64.sqrt() - 0.70709;
    assert!((found - expected).abs() < 1e-12, "{found:e}");
}

#[test]
fn more_than_the_tolerance_is_refused() {
    let message = refusal(&rounded(&["coupling.start_tolerance=1e-7"]));
    assert!(message.contains("the joint is open"), "{message}");
    let wide = rounded(&[
        "coupling.start_tolerance=1e-2",
        "subsystem.link2.parameters.y0=0.75",
    ]);
    let message = refusal(&wide);
    assert!(message.contains("the joint is open"), "{message}");
    assert!(!message.contains("coupling.start_tolerance"), "{message}");
}

/// A rigid link between scalar markers has no geometry.
#[test]
fn a_joint_without_geometry_has_to_be_closed() {
    let settings = [
        "coupling.start_tolerance=1e-2",
        "subsystem.mass2.parameters.x0=1.00001",
    ];
    let scene = with_settings(OSCILLATOR, "method=hermite", &settings);
    let message = refusal(&scene);
    assert!(message.contains("the joint is open"), "{message}");
    assert!(!message.contains("coupling.start_tolerance"), "{message}");
}

/// A weld in the plane keeps an angle, which takes up what the bodies are turned.
#[test]
fn an_angle_is_turned_by_what_it_misses() {
    let settings = [
        "joint.hinge.kind=\"weld\"",
        "joint.hinge.angle=1.57081",
        "coupling.start_tolerance=1e-4",
        "scene.t_end=0.1",
    ];
    let fitted = run(
        &with_settings(DOUBLE_PENDULUM, HERMITE, &settings),
        Place::InProcess,
    );
    let told = &fitted.statistics.fitted_joints[0];
    let missed = 1.57081 - std::f64::consts::FRAC_PI_2;
    assert!((told.turn / missed - 1.0).abs() < 1e-6, "{told:?}");
    assert!(told.shift < 1e-12, "{told:?}");
    assert!(gap(&fitted) < 1e-9, "{}", gap(&fitted));
}

/// All numbers of a scene's second body with so many digits behind the point.
fn with_digits(mut scene: Scene, digits: i32) -> Scene {
    let power = 10.0_f64.powi(digits);
    for value in scene.subsystems[1].parameters.values_mut() {
        match &mut value.kind {
            Some(Kind::Number(number)) => *number = (*number * power).round() / power,
            Some(Kind::Numbers(list)) => list
                .values
                .iter_mut()
                .for_each(|number| *number = (*number * power).round() / power),
            _ => {}
        }
    }
    scene
}

#[test]
fn every_joint_in_space_meets_rounded_bodies() {
    for joint in joints::all() {
        let name = joints::name(&joint);
        let pair = Pair::floating(joint);
        let scene = |more: &str| {
            let coupling = format!("method=hermite degree=2 macro_step=1e-2{more}");
            with_digits(pair.scene(&coupling, 0.1), 5)
        };
        let message = refusal(&scene(""));
        assert!(message.contains("the joint is open"), "{name}: {message}");
        let fitted = run(&scene(" start_tolerance=1e-4"), Place::InProcess);
        let [told] = &fitted.statistics.fitted_joints[..] else {
            panic!("{name}: {:?}", fitted.statistics.fitted_joints);
        };
        let moved = told.shift.max(told.turn);
        assert!(moved > 1e-7 && moved < 5e-5, "{name}: {told:?}");
        assert!(gap(&fitted) < 1e-9, "{name}: {:e}", gap(&fitted));
        let errors = pair.errors(&fitted);
        let off = errors.position.max(errors.attitude);
        assert!(off < 1e-3, "{name}: {errors:?}");
    }
}
