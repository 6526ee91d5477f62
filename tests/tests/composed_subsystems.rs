//! Systems of bodies that a scene composes inside one subsystem.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::setup::Options;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;

const DOUBLE_PENDULUM: &str = include_str!("../../scenes/double-pendulum.toml");

/// The first link of the example, composed.
const LINK: &str = r#"
[[subsystem]]
name = "link1"
model = "planar-multibody"
[subsystem.parameters]
formulation = "FORMULATION"
[subsystem.parameters.body.link]
m = 1.0
inertia = 0.08333333333333333
position = [0.3535533905932738, 0.3535533905932738]
angle = 0.7853981633974483
[subsystem.parameters.joint.hinge]
kind = "revolute"
a = "ground"
b = "link"
point = [0.0, 0.0]
[subsystem.parameters.torsion-spring.hinge]
a = "ground"
b = "link"
stiffness = 500.0
damping = 50.0
rest_angle = 0.7853981633974483
[subsystem.parameters.marker.tip]
body = "link"
point = [0.5, 0.0]

[[subsystem]]
name = "link2""#;

/// The example with its first link composed, and outputs that both have.
fn composed(formulation: &str) -> String {
    let start = DOUBLE_PENDULUM.find("[[subsystem]]").unwrap();
    let end = "[[subsystem]]\nname = \"link2\"";
    let rest = DOUBLE_PENDULUM.find(end).unwrap() + end.len();
    let link = LINK.replace("FORMULATION", formulation);
    let text = [&DOUBLE_PENDULUM[..start], &link, &DOUBLE_PENDULUM[rest..]].concat();
    without_own_outputs(&text)
}

fn without_own_outputs(text: &str) -> String {
    let text = text.replace("\"link1.angle\", \"link1.rate\", ", "");
    assert!(!text.contains("link1.rate\""));
    text
}

fn trajectory(text: &str) -> Trajectory {
    let coupling = "macro_step=2e-3";
    run(
        &with_settings(text, coupling, &["scene.t_end=0.5"]),
        Place::InProcess,
    )
}

/// The master cannot tell a composed link from the one of the pendulum model.
#[test]
fn a_composed_link_couples_like_the_pendulum_model() {
    let expected = trajectory(&without_own_outputs(DOUBLE_PENDULUM));
    for formulation in ["absolute", "minimal"] {
        let own = trajectory(&composed(formulation));
        for column in [
            "link1.tip_x",
            "link1.tip_vy",
            "link1.energy",
            "link2.angle",
            "link2.rate",
            "hinge.lambda.x",
            "hinge.lambda.y",
        ] {
            let (own, expected) = (own.column(column), expected.column(column));
            assert_eq!(own.len(), expected.len());
            let size = expected.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            let pairs = own.iter().zip(&expected);
            let largest = pairs.fold(0.0, |a: f64, (own, other)| a.max((own - other).abs()));
            println!("{formulation} {column}: {largest:e} of {size}");
            assert!(
                size > 0.0 && largest < 1e-8 * size,
                "{formulation} {column}: {largest:e}"
            );
        }
    }
}

#[test]
fn a_mistake_in_a_composition_is_shown_at_its_key() {
    for (old, new, words) in [
        (
            "b = \"link\"\npoint",
            "b = \"lnk\"\npoint",
            [
                "link1.parameters.joint.hinge.b",
                "no body \"lnk\"",
                "ground, link",
            ],
        ),
        (
            "angle = 0.785",
            "angel = 0.785",
            [
                "link1.parameters.body.link.angel",
                "known: m, position",
                "`body.link.angle`",
            ],
        ),
        (
            "point = [0.0, 0.0]\n",
            "point_a = [0.0, 0.01]\npoint_b = [-0.5, 0.0]\n",
            ["link1.parameters.joint.hinge", "open by", "at the start"],
        ),
    ] {
        let text = composed("absolute");
        assert!(text.contains(old));
        let text = text.replacen(old, new, 1);
        let scene = with_settings(&text, "macro_step=2e-3", &[]);
        let refused = try_run(&scene, Place::InProcess, &Options::default());
        let error = format!("{:#}", refused.err().unwrap());
        for word in words {
            assert!(error.contains(word), "{word:?} is missing in\n{error}");
        }
    }
}
