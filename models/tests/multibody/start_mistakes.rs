//! Users' mistakes in the start and the structure of a composition.

use crate::common::body::model;
use crate::common::mechanisms::Given::{List as L, Number as N, Text as T};
use crate::common::mechanisms::{Composition, values, with};
use crate::common::{RADAU5, build_values};
use crate::mistakes::{PLANAR, assert_planar, assert_refused, assert_spatial, without};

#[test]
fn joints_must_be_closed_at_the_start() {
    let mut open = without("joint.pin.point");
    open.extend([
        ("joint.pin.point_a", L(&[0.5, 0.0])),
        ("joint.pin.point_b", L(&[-0.4, -0.53])),
    ]);
    assert_refused(
        "planar-multibody",
        &open,
        "joint.pin",
        &["open by 0.03", " m at the start"],
    );
    assert_spatial(
        &[("joint.cross.second_axis", L(&[0.1, 1.0, 0.0]))],
        "joint.cross.second_axis",
        &["84.28", "right angles"],
    );
    assert_planar(
        &[("motion.x.joint", T("pin")), ("motion.x.offset", N(0.3))],
        "motion.x",
        &["open by 0.", " rad"],
    );
    assert_planar(
        &[
            ("motion.x.body", T("rod")),
            ("motion.x.direction", L(&[0.0, 2.0])),
            ("motion.x.offset", N(0.7)),
        ],
        "motion.x",
        &["open by 0.2 m"],
    );
}

#[test]
fn velocities_at_the_start_must_be_those_that_joints_allow() {
    assert_planar(
        &[("body.crank.velocity", L(&[0.0, 0.25]))],
        "joint.hinge",
        &["by 0.25 m/s", "allows"],
    );
    assert_planar(&[("body.crank.rate", N(2.0))], "joint.hinge", &["by 1 m/s"]);
    assert_planar(
        &[("motion.x.joint", T("pin")), ("motion.x.speed", N(0.3))],
        "motion.x",
        &["rad/s"],
    );
    assert_spatial(
        &[("body.slider.omega", L(&[0.0, 0.0, 3.0]))],
        "joint.guide",
        &["rad/s"],
    );
}

#[test]
fn joints_that_repeat_others_are_named() {
    let twice: Composition = &[
        ("joint.second.kind", T("revolute")),
        ("joint.second.a", T("rod")),
        ("joint.second.b", T("crank")),
        ("joint.second.point_a", L(&[-0.4, -0.5])),
        ("joint.second.point_b", L(&[0.5, 0.0])),
    ];
    assert_planar(
        twice,
        "joint.second",
        &["joint.hinge, joint.pin", "remove it"],
    );
    let plain: Composition = &[
        ("joint.wrist.kind", T("weld")),
        ("joint.wrist.a", T("rod")),
        ("joint.wrist.b", T("ground")),
        ("joint.wrist.point", L(&[1.4, 0.5])),
        ("motion.x.joint", T("hinge")),
    ];
    assert_planar(plain, "joint.wrist", &["joint.hinge, joint.pin"]);
    let driven: Composition = &[("motion.x.joint", T("pin")), ("motion.y.joint", T("pin"))];
    assert_planar(
        driven,
        "motion.y.joint",
        &["\"pin\"", "parameters.motion.x"],
    );
    // 20 conditions on 18 freedoms.
    assert_spatial(
        &[("joint.ball.kind", T("weld"))],
        "joint.hinge",
        &["undetermined"],
    );
}

#[test]
fn minimal_coordinates_refuse_what_they_cannot_express() {
    assert_spatial(
        &[("formulation", T("minimal"))],
        "joint.ball",
        &["loop", "formulation = \"absolute\""],
    );
    assert_planar(
        &[
            ("formulation", T("minimal")),
            ("motion.x.body", T("rod")),
            ("motion.x.direction", L(&[1.0, 0.0])),
        ],
        "motion.x",
        &["the motion of a point", "formulation = \"absolute\""],
    );
}

#[test]
fn a_spring_needs_a_direction() {
    let spring: Composition = &[
        ("spring.s.a", T("ground")),
        ("spring.s.b", T("crank")),
        ("spring.s.point_a", L(&[0.5, 0.0])),
    ];
    let mut damped = spring.to_vec();
    damped.push(("spring.s.damping", N(1.0)));
    assert_planar(&damped, "spring.s", &["same point", "damping"]);
    let mut relaxed = spring.to_vec();
    relaxed.extend([
        ("spring.s.stiffness", N(1.0)),
        ("spring.s.rest_length", N(0.2)),
    ]);
    assert_planar(&relaxed, "spring.s", &["same point", "rest_length"]);
    let mut plain = spring.to_vec();
    plain.push(("spring.s.stiffness", N(1.0)));
    assert!(
        build_values(
            &*model("planar-multibody"),
            values(&with(PLANAR, &plain)),
            RADAU5
        )
        .is_ok()
    );
}
