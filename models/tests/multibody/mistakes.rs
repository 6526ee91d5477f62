//! Users' mistakes in a composition: place, value, what is allowed, what to do.

use linchpin_worker::setup::SetupError;

use crate::common::body::model;
use crate::common::mechanisms::Given::{List as L, Number as N, Text as T};
use crate::common::mechanisms::{Composition, Given, SPATIAL_LOOP, values, with};
use crate::common::{RADAU5, Solver, build_values};

/// A double pendulum.
pub const PLANAR: Composition = &[
    ("body.crank.m", N(1.3)),
    ("body.crank.inertia", N(0.17)),
    ("body.crank.position", L(&[0.5, 0.0])),
    ("body.rod.m", N(0.7)),
    ("body.rod.inertia", N(0.23)),
    ("body.rod.position", L(&[1.4, 0.5])),
    ("joint.hinge.kind", T("revolute")),
    ("joint.hinge.a", T("ground")),
    ("joint.hinge.b", T("crank")),
    ("joint.hinge.point", L(&[0.0, 0.0])),
    ("joint.pin.kind", T("revolute")),
    ("joint.pin.a", T("crank")),
    ("joint.pin.b", T("rod")),
    ("joint.pin.point", L(&[1.0, 0.0])),
];

fn refused(model_name: &str, composition: &[(&str, Given)]) -> SetupError {
    match build_values(&*model(model_name), values(composition), RADAU5) {
        Ok(_) => panic!("{composition:?} is allowed"),
        Err(error) => error,
    }
}

/// Asserts that the composition is refused at `field` with all the words.
pub fn assert_refused(
    model_name: &str,
    composition: &[(&str, Given)],
    field: &str,
    words: &[&str],
) {
    let error = refused(model_name, composition);
    let message = error.to_string();
    assert_eq!(error.field(), format!("parameters.{field}"), "{message}");
    assert!(message.starts_with(error.field()), "{message}");
    for word in words {
        assert!(message.contains(word), "{word:?} is missing in\n{message}");
    }
}

pub fn assert_planar(more: &[(&str, Given)], field: &str, words: &[&str]) {
    assert_refused("planar-multibody", &with(PLANAR, more), field, words);
}

pub fn assert_spatial(more: &[(&str, Given)], field: &str, words: &[&str]) {
    assert_refused("spatial-multibody", &with(SPATIAL_LOOP, more), field, words);
}

pub fn without(name: &str) -> Vec<(&'static str, Given)> {
    let kept = PLANAR.iter().filter(|(own, _)| *own != name);
    kept.copied().collect()
}

#[test]
fn the_base_is_allowed() {
    for (name, composition) in [
        ("planar-multibody", PLANAR),
        ("spatial-multibody", SPATIAL_LOOP),
    ] {
        assert!(build_values(&*model(name), values(composition), RADAU5).is_ok());
    }
}

#[test]
fn tables_and_keys_that_do_not_exist_are_told_with_those_that_do() {
    assert_planar(
        &[("bodies.x.m", N(1.0))],
        "bodies.x.m",
        &["known", "body.NAME.m", "gravity"],
    );
    assert_planar(
        &[("body.crank.mass", N(1.0))],
        "body.crank.mass",
        &["m, position", "inertia", "rate"],
    );
    assert_planar(
        &[("body.crank.omega", N(1.0))],
        "body.crank.omega",
        &["known"],
    );
    assert_planar(&[("gravty", N(1.0))], "gravty", &["gravity", "formulation"]);
    assert_planar(&[("body.m", N(1.0))], "body.m", &["body.NAME.m"]);
    assert_planar(
        &[("body.crank.m.x", N(1.0))],
        "body.crank.m.x",
        &["body.NAME.m"],
    );
    assert_planar(
        &[("joint.pin.axis", L(&[1.0, 0.0]))],
        "joint.pin.axis",
        &["known: kind, a, b, point, point_a, point_b"],
    );
    assert_spatial(
        &[("joint.ball.axis", L(&[1.0, 0.0, 0.0]))],
        "joint.ball.axis",
        &["known"],
    );
    assert_spatial(&[("body.rod.rate", N(1.0))], "body.rod.rate", &["omega"]);
    assert_planar(
        &[
            ("motion.x.joint", T("pin")),
            ("motion.x.direction", L(&[1.0, 0.0])),
        ],
        "motion.x.direction",
        &["known: joint, offset, speed, amplitude, frequency, phase"],
    );
}

#[test]
fn what_is_missing_is_named() {
    let planar = |name: &str| refused("planar-multibody", &without(name));
    for name in [
        "body.crank.m",
        "body.rod.inertia",
        "joint.pin.kind",
        "joint.hinge.b",
    ] {
        let error = planar(name);
        assert_eq!(error.field(), format!("parameters.{name}"));
        assert!(error.to_string().contains("missing"), "{error}");
    }
    let error = refused("planar-multibody", &[("gravity", N(1.0))]);
    assert_eq!(error.field(), "parameters.body");
    assert_refused(
        "planar-multibody",
        &without("joint.pin.point"),
        "joint.pin",
        &["either `point`", "both `point_a` and `point_b`"],
    );
    assert_planar(
        &[("joint.pin.point_a", L(&[0.5, 0.0]))],
        "joint.pin",
        &["either `point`"],
    );
    assert_planar(
        &[("marker.tip.point", L(&[0.5, 0.0]))],
        "marker.tip.body",
        &["missing"],
    );
    assert_planar(
        &[("motion.x.speed", N(1.0))],
        "motion.x",
        &["either `joint`, or `body`"],
    );
    assert_planar(
        &[("motion.x.joint", T("pin")), ("motion.x.body", T("rod"))],
        "motion.x",
        &["either `joint`, or `body`"],
    );
}

#[test]
fn wrong_types_and_ranges_are_told() {
    assert_planar(
        &[("body.crank.m", N(0.0))],
        "body.crank.m",
        &["= 0", "greater than 0"],
    );
    assert_planar(
        &[("body.crank.m", N(f64::NAN))],
        "body.crank.m",
        &["NaN", "finite"],
    );
    assert_planar(
        &[("body.crank.inertia", N(-0.1))],
        "body.crank.inertia",
        &["-0.1", "greater than 0"],
    );
    assert_planar(
        &[("body.crank.m", T("heavy"))],
        "body.crank.m",
        &["a number"],
    );
    assert_planar(
        &[("body.crank.position", L(&[1.0, 2.0, 3.0]))],
        "body.crank.position",
        &["a list of 2 numbers"],
    );
    assert_planar(
        &[("body.crank.position", L(&[1.0, f64::INFINITY]))],
        "body.crank.position[1]",
        &["inf", "finite"],
    );
    assert_planar(&[("gravity", T("down"))], "gravity", &["a number"]);
    assert_planar(
        &[("gravity", L(&[1.0, 2.0, 3.0]))],
        "gravity",
        &["a list of 2 numbers"],
    );
    assert_spatial(
        &[("body.rod.attitude", L(&[1.0, 0.0, 0.0]))],
        "body.rod.attitude",
        &["a list of 4 numbers"],
    );
    assert_spatial(
        &[("body.rod.attitude", L(&[0.0; 4]))],
        "body.rod.attitude",
        &["length is 0"],
    );
    assert_spatial(
        &[("body.rod.inertia", N(1.0))],
        "body.rod.inertia",
        &["a list of numbers"],
    );
    assert_spatial(
        &[("body.rod.inertia", L(&[0.1, 0.0, 0.1]))],
        "body.rod.inertia[1]",
        &["= 0", "greater than 0"],
    );
    assert_spatial(
        &[("body.rod.inertia", L(&[0.1, 0.2, 0.4]))],
        "body.rod.inertia[2]",
        &["0.4", "other two"],
    );
    assert_spatial(
        &[("joint.hinge.axis", L(&[0.0; 3]))],
        "joint.hinge.axis",
        &["length is 0"],
    );
    for (key, value) in [
        ("stiffness", -1.0),
        ("damping", -0.5),
        ("rest_length", -0.1),
    ] {
        let field = format!("spring.s.{key}");
        assert_spatial(
            &[(&field, N(value))],
            &field,
            &[&format!("{value}"), "0 or greater"],
        );
    }
    assert_spatial(
        &[("torsion-spring.t.damping", N(-2.0))],
        "torsion-spring.t.damping",
        &["0 or greater"],
    );
    assert_planar(
        &[
            ("motion.x.joint", T("pin")),
            ("motion.x.frequency", N(-2.0)),
        ],
        "motion.x.frequency",
        &["0 or greater"],
    );
    assert!(matches!(
        build_values(
            &*model("planar-multibody"),
            values(PLANAR),
            Solver("radau5", &[("rtol", 0.0)])
        ),
        Err(SetupError::OutOfRange { .. })
    ));
}

#[test]
fn flat_bodies_are_allowed() {
    let flat = with(SPATIAL_LOOP, &[("body.rod.inertia", L(&[0.7, 0.1, 0.8]))]);
    assert!(build_values(&*model("spatial-multibody"), values(&flat), RADAU5).is_ok());
}

#[test]
fn names_and_words_are_told_with_those_that_there_are() {
    assert_planar(
        &[("joint.pin.b", T("rot"))],
        "joint.pin.b",
        &["no body \"rot\"", "ground, crank, rod"],
    );
    assert_planar(
        &[("joint.pin.b", T("crank"))],
        "joint.pin.b",
        &["both ends are on \"crank\""],
    );
    assert_planar(
        &[("joint.pin.kind", T("hinge"))],
        "joint.pin.kind",
        &["\"hinge\"", "revolute, prismatic, inline, weld"],
    );
    assert_planar(
        &[("joint.pin.kind", T("spherical"))],
        "joint.pin.kind",
        &["revolute, prismatic, inline, weld"],
    );
    assert_planar(
        &[
            ("formulation", T("minimal")),
            ("joint.pin.kind", T("inline")),
            ("joint.pin.axis", L(&[0.0, 1.0])),
        ],
        "joint.pin",
        &["inline", "\"absolute\""],
    );
    assert_planar(
        &[("formulation", T("relative"))],
        "formulation",
        &["\"relative\"", "absolute, minimal"],
    );
    assert_planar(
        &[("marker.tip.body", T("bar"))],
        "marker.tip.body",
        &["no body \"bar\""],
    );
    assert_planar(
        &[("motion.x.joint", T("pim"))],
        "motion.x.joint",
        &["no joint \"pim\"", "hinge, pin"],
    );
    assert_planar(
        &[("body.ground.m", N(1.0)), ("body.ground.inertia", N(1.0))],
        "body.ground",
        &["taken by the ground"],
    );
    assert_spatial(
        &[("torsion-spring.t.joint", T("ball"))],
        "torsion-spring.t.joint",
        &["\"ball\" is spherical", "revolute"],
    );
    assert_spatial(
        &[("motion.x.joint", T("cross"))],
        "motion.x.joint",
        &["universal", "revolute, prismatic"],
    );
    assert_planar(
        &[("marker.pin.body", T("rod"))],
        "joint.pin",
        &["\"pin_angle\"", "another name"],
    );
}
