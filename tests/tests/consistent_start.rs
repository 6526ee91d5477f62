//! Initial velocities that meet the joints, on request, and starts that are refused.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::scene::{Scene, parse};
use linchpin_master::setup::Options;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;

const DOUBLE_PENDULUM: &str = include_str!("../../scenes/double-pendulum.toml");
const SLIDER_CRANK: &str = include_str!("../../scenes/slider-crank.toml");

/// The double pendulum whose link 1 turns at `rate`; link 2 turns at -1.3 rad/s, and its start may move as it has to.
fn double_pendulum(rate: f64, more: &[&str]) -> Scene {
    let rate = format!("subsystem.link1.parameters.rate0={rate}");
    let settings = [
        &[
            rate.as_str(),
            "subsystem.link2.parameters.rate0=-1.3",
            "scene.t_end=0.01",
        ],
        more,
    ]
    .concat();
    with_settings(DOUBLE_PENDULUM, "degree=0", &settings)
}

const FREE: &str = "subsystem.link2.free_velocities=[\"vx0\", \"vy0\"]";

fn refusal(scene: &Scene) -> String {
    try_run(scene, Place::InProcess, &Options::default())
        .unwrap_err()
        .to_string()
}

#[track_caller]
fn assert_told(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "no {word:?} in: {message}");
    }
}

/// The tip of link 1 moves across its axis, which stands at 45 degrees.
#[test]
fn free_velocities_meet_the_joint() {
    for index in [
        "index=1",
        "index=2 beta=1e-2 gamma=0",
        "index=3 beta=0 gamma=0",
    ] {
        let settings: Vec<String> = index.split(' ').map(|s| format!("coupling.{s}")).collect();
        let mut settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        settings.extend([
            FREE,
            "output.variables=[\"link2.start_vx\", \"link2.start_vy\", \"link2.rate\"]",
        ]);
        let trajectory = run(&double_pendulum(2.0, &settings), Place::InProcess);
        let start = |column: &str| trajectory.column(column)[0];
        let across = 2.0 * 0.5_f64.sqrt();
        assert!((start("link2.start_vx") + across).abs() < 1e-14);
        assert!((start("link2.start_vy") - across).abs() < 1e-14);
        assert_eq!(start("link2.rate"), -1.3, "what is not free stays");
    }
}

/// Three free velocities and two conditions: the change is the smallest one.
#[test]
fn of_many_choices_the_nearest_is_taken() {
    let free = "subsystem.link2.free_velocities=[\"vx0\", \"vy0\"]";
    let both = "subsystem.link1.free_velocities=[\"rate0\"]";
    let outputs = "output.variables=[\"link1.rate\", \"link2.start_vx\", \"link2.start_vy\"]";
    let trajectory = run(
        &double_pendulum(2.0, &[free, both, outputs]),
        Place::InProcess,
    );
    let start = |column: &str| trajectory.column(column)[0];
    // Of (rate, vx, vy) = (2, 0, 0) + change with vx = -rate/sqrt(2), vy = rate/sqrt(2), the smallest change has rate = 1.
    assert!((start("link1.rate") - 1.0).abs() < 1e-14);
    assert!((start("link2.start_vx") + 0.5_f64.sqrt()).abs() < 1e-14);
    assert!((start("link2.start_vy") - 0.5_f64.sqrt()).abs() < 1e-14);
}

#[test]
fn velocities_that_do_not_meet_are_refused_with_the_residual() {
    let message = refusal(&double_pendulum(2.0, &[]));
    assert_told(
        &message,
        &[
            "joint",
            "open at t = 0",
            "hinge.residual.velocity.x is -1.41",
            "initial values",
        ],
    );
    let along_x = "subsystem.link2.free_velocities=[\"vx0\"]";
    let message = refusal(&double_pendulum(2.0, &[along_x]));
    assert_told(&message, &["hinge.residual.velocity.y is 1.41"]);
}

#[test]
fn what_is_no_velocity_is_refused() {
    let message = refusal(&double_pendulum(
        0.0,
        &["subsystem.link2.free_velocities=[\"x0\"]"],
    ));
    assert_told(
        &message,
        &["\"x0\" is no initial velocity", "velocities at the start"],
    );
    let message = refusal(&double_pendulum(
        0.0,
        &["subsystem.link2.free_velocities=[\"vx\"]"],
    ));
    assert_told(&message, &["\"vx\" is no parameter", "vx0"]);
}

fn slider_crank(change: (&str, &str)) -> Result<Scene, String> {
    assert!(SLIDER_CRANK.contains(change.0), "{}", change.0);
    let text = SLIDER_CRANK.replace(change.0, change.1);
    parse(&text, "slider-crank.toml", &[]).map_err(|errors| errors.to_string())
}

/// What is wrong with the joint of the slider-crank after a change, with the line.
#[track_caller]
fn refused(change: (&str, &str), words: &[&str]) {
    let message = match slider_crank(change) {
        Ok(scene) => refusal(&scene),
        Err(message) => message,
    };
    assert_told(&message, words);
    assert_told(&message, &["slider-crank.toml:"]);
}

#[test]
fn points_and_axes_of_a_joint_are_checked() {
    let axis = "axis_b = [0.0, 1.0]";
    refused((axis, ""), &["needs `axis_b`", "axis_b = [0.0, 1.0]"]);
    refused((axis, "axis_b = [0.0, 0.0]"), &["length 0"]);
    refused(
        (axis, "axis_b = [0.0, 1.0, 0.0]"),
        &["3 components", "have 2"],
    );
    refused((axis, "axis_b = 1.0"), &["axis_b", "a list of numbers"]);
    refused((axis, "axis_b = [0.0, inf]"), &["axis_b", "finite"]);
    refused(
        (axis, "axis_b = [0.0, 1.0]\naxis_a = [1.0, 0.0]"),
        &["no `axis_a`", "point_a, point_b, axis_b"],
    );
    refused((axis, "axis_b = [0.0, 1.0]\nangle = 0.3"), &["no `angle`"]);
    refused(
        (axis, "axes_b = [0.0, 1.0]"),
        &["axes_b", "did you mean `axis_b`?"],
    );
    let kind = "kind = \"inplane\"";
    refused(
        (kind, "kind = \"universal\""),
        &["cannot hold planar markers", "translational"],
    );
    refused(
        (kind, "kind = \"rigid-link\""),
        &["cannot hold planar markers"],
    );
    refused((kind, "kind = \"inplan\""), &["did you mean `inplane`?"]);
    let point = "point_a = [0.7071067811865476, 0.0]";
    refused(
        (point, "point_a = [0.7, 0.0]"),
        &["open at t = 0", "slider.residual.position"],
    );
}

#[test]
fn a_joint_that_is_turned_over_is_refused() {
    let weld = "kind = \"orientation\"\nangle = 2.356194490192345";
    let change = ("kind = \"inplane\"", weld);
    let text = SLIDER_CRANK
        .replace(change.0, change.1)
        .replace("axis_b = [0.0, 1.0]", "")
        .replace("point_a = [0.7071067811865476, 0.0]", "");
    let scene = parse(&text, "slider-crank.toml", &[]).unwrap();
    assert_told(
        &refusal(&scene),
        &["turned over at t = 0", "same side", "reverse an axis"],
    );
    // Link 1 stands at 45, link 2 at 90 degrees.
    let closed = text.replace("2.356194490192345", "-0.7853981633974483");
    run(
        &parse(&closed, "slider-crank.toml", &[]).unwrap(),
        Place::InProcess,
    );
}

#[test]
fn who_evaluates_a_load_must_be_able_to() {
    let text = SLIDER_CRANK.replace("degree = 0  ", "loads = \"everybody\"\ndegree = 0  ");
    let errors = parse(&text, "slider-crank.toml", &[])
        .unwrap_err()
        .to_string();
    assert_told(&errors, &["loads", "automatic", "worker", "master"]);
    let text = SLIDER_CRANK.replace("exchanged_degree = 2", "exchanged_degree = 4");
    let errors = parse(&text, "slider-crank.toml", &[])
        .unwrap_err()
        .to_string();
    assert_told(&errors, &["exchanged_degree", "0 to 3"]);
}

/// The same hinge twice: four conditions for two freedoms, each hinge takes half of the load.
#[test]
fn redundant_joints_share_their_loads() {
    let second = "[[joint]]\nname = \"again\"\nkind = \"atpoint\"\na = \"link1.tip\"\nb = \"link2.start\"\n\n[output]";
    let text = DOUBLE_PENDULUM.replace("[output]", second);
    let of = |text: &str| {
        run(
            &parse(text, "double-pendulum.toml", &[]).unwrap(),
            Place::InProcess,
        )
    };
    let (one, two) = (of(DOUBLE_PENDULUM), of(&text));
    let start = |run: &Trajectory, joint: &str| run.column(&format!("{joint}.lambda.y"))[0];
    for joint in ["hinge", "again"] {
        let (share, whole) = (start(&two, joint), start(&one, "hinge"));
        assert!(
            (2.0 * share - whole).abs() < 1e-9 * whole.abs(),
            "{joint}: {share} {whole}"
        );
    }
    assert_told(
        &two.statistics.warnings()[0].to_string(),
        &["again, hinge", "2 redundant conditions"],
    );
}
