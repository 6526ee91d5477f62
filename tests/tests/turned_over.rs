//! A joint whose conditions hold at the start, but with a body turned over, is refused with the name of the joint.

#![allow(clippy::unwrap_used, missing_docs)]

use std::f64::consts::PI;

use linchpin::connect::Place;
use linchpin_master::setup::Options;
use linchpin_models::reference::CompositeJoint;
use linchpin_tests::in_space::joints;
use linchpin_tests::in_space::pair::Pair;
use linchpin_tests::runs::{run, try_run};
use linchpin_tests::scenes::with_settings;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

fn message(text: &str, change: &str) -> String {
    let scene = with_settings(text, "", &[change]);
    match try_run(&scene, Place::InProcess, &Options::default()) {
        Ok(_) => panic!("{change} is accepted"),
        Err(error) => error.to_string(),
    }
}

fn assert_refused(message: &str) {
    let wanted = [
        "joint.joint",
        "turned over",
        "marker a",
        "marker b",
        "do not point to the same side",
        "help: turn one of the bodies",
    ];
    for wanted in wanted {
        assert!(message.contains(wanted), "no {wanted:?} in: {message}");
    }
}

/// An axis of the joint the other way round meets the same conditions.
#[test]
fn axes_that_point_to_opposite_sides() {
    let has_common_axis = |joint: &CompositeJoint| {
        matches!(
            joint,
            CompositeJoint::Revolute(_)
                | CompositeJoint::Cylindrical(_)
                | CompositeJoint::Planar(_)
        )
    };
    for joint in joints::all().into_iter().filter(has_common_axis) {
        let pair = Pair::floating(joint);
        let text = pair.scene_text(4e-3);
        run(&with_settings(&text, "", &[]), Place::InProcess);
        let axis = -pair.frame().axes[0];
        let change = format!("joint.joint.axis_a={:?}", axis.as_slice());
        assert_refused(&message(&text, &change));
    }
}

/// What keeps an attitude meets its conditions also half a turn about an axis away from it, and a third of a turn about
/// every second diagonal.
fn other_attitudes() -> [UnitQuaternion<f64>; 7] {
    let turn = |x: f64, y, z| UnitQuaternion::from_quaternion(Quaternion::new(0.5, x, y, z));
    let half = |axis| UnitQuaternion::from_axis_angle(&axis, PI);
    [
        half(Vector3::x_axis()),
        half(Vector3::y_axis()),
        half(Vector3::z_axis()),
        turn(0.5, 0.5, 0.5),
        turn(0.5, -0.5, -0.5),
        turn(-0.5, 0.5, -0.5),
        turn(-0.5, -0.5, 0.5),
    ]
}

#[test]
fn attitudes_other_than_the_kept_one() {
    for joint in &joints::all()[8..] {
        let awkward = Pair::floating(*joint);
        // Here nothing is rounded: the axes that should point to one side are exactly at right angles after a third turn.
        let mut exact = Pair::floating(*joint);
        exact.chain.coordinates.fill(0.0);
        exact.chain.bodies[1].joint.attitude = UnitQuaternion::identity();
        for pair in [awkward, exact] {
            let text = pair.scene_text(4e-3);
            run(&with_settings(&text, "", &[]), Place::InProcess);
            for turn in other_attitudes() {
                let q = pair.frame().attitude * turn;
                let change = format!("joint.joint.attitude={:?}", [q.w, q.i, q.j, q.k]);
                assert_refused(&message(&text, &change));
            }
        }
    }
}
