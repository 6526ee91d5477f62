//! Compositions of the multibody models, with numbers that are not round.

use std::collections::BTreeMap;

use linchpin_proto::v1;

use super::number;

/// A value of a composition.
#[derive(Debug, Clone, Copy)]
pub enum Given {
    Number(f64),
    Text(&'static str),
    List(&'static [f64]),
}

use Given::{List as L, Number as N, Text as T};

/// A list of values that are computed.
pub fn list(values: &[f64]) -> Given {
    L(Vec::leak(values.to_vec()))
}

/// Dotted names with their values.
pub type Composition = &'static [(&'static str, Given)];

/// As a request has them.
pub fn values(composition: &[(&str, Given)]) -> BTreeMap<String, v1::Value> {
    let value = |given: &Given| match *given {
        Given::Number(value) => number(value),
        Given::Text(text) => v1::Value {
            kind: Some(v1::value::Kind::Text(text.to_owned())),
        },
        Given::List(values) => v1::Value {
            kind: Some(v1::value::Kind::Numbers(v1::NumberList {
                values: values.to_vec(),
            })),
        },
    };
    let pairs = composition.iter();
    pairs
        .map(|(name, given)| ((*name).to_owned(), value(given)))
        .collect()
}

/// Two compositions as one; the second one prevails.
pub fn with<'a>(
    composition: &[(&'a str, Given)],
    more: &[(&'a str, Given)],
) -> Vec<(&'a str, Given)> {
    let is_altered = |name: &str| more.iter().any(|(other, _)| *other == name);
    let kept = composition.iter().filter(|(name, _)| !is_altered(name));
    kept.chain(more).copied().collect()
}

/// A slider-crank in the plane: a loop, from rest.
pub const SLIDER_CRANK: Composition = &[
    ("gravity", L(&[1.3, -9.7])),
    ("body.crank.m", N(1.3)),
    ("body.crank.inertia", N(0.17)),
    ("body.crank.position", L(&[0.4, 0.3])),
    ("body.crank.angle", N(0.9)),
    ("body.rod.m", N(0.7)),
    ("body.rod.inertia", N(0.23)),
    ("body.rod.position", L(&[1.4, 0.5])),
    ("body.rod.angle", N(-0.4)),
    ("body.slider.m", N(2.1)),
    ("body.slider.inertia", N(0.31)),
    ("body.slider.position", L(&[2.2, -0.15])),
    ("joint.hinge.kind", T("revolute")),
    ("joint.hinge.a", T("ground")),
    ("joint.hinge.b", T("crank")),
    ("joint.hinge.point", L(&[0.1, -0.2])),
    ("joint.pin.kind", T("revolute")),
    ("joint.pin.a", T("rod")),
    ("joint.pin.b", T("crank")),
    ("joint.pin.point", L(&[0.8, 0.7])),
    ("joint.wrist.kind", T("revolute")),
    ("joint.wrist.a", T("rod")),
    ("joint.wrist.b", T("slider")),
    ("joint.wrist.point", L(&[2.1, -0.1])),
    ("joint.guide.kind", T("prismatic")),
    ("joint.guide.a", T("slider")),
    ("joint.guide.b", T("ground")),
    ("joint.guide.point", L(&[2.3, -0.2])),
    ("joint.guide.axis", L(&[1.0, 0.2])),
    ("spring.s.a", T("ground")),
    ("spring.s.b", T("rod")),
    ("spring.s.point_a", L(&[0.3, 1.9])),
    ("spring.s.point_b", L(&[0.2, 0.1])),
    ("spring.s.stiffness", N(41.0)),
    ("spring.s.rest_length", N(1.1)),
    ("torsion-spring.t.a", T("rod")),
    ("torsion-spring.t.b", T("crank")),
    ("torsion-spring.t.stiffness", N(2.3)),
    ("torsion-spring.t.rest_angle", N(0.8)),
    ("marker.tip.body", T("rod")),
    ("marker.tip.point", L(&[0.3, -0.2])),
    ("marker.tip.angle", N(0.6)),
    ("marker.block.body", T("slider")),
    ("marker.post.body", T("ground")),
    ("marker.post.point", L(&[-0.7, 0.4])),
];

/// A tree in the plane: a crank on the ground, a rod on it, a weight that slides on the rod, a plate welded to that, and
/// a ball on a spring. The tree turns about its hinge at 2 rad/s.
pub const PLANAR_TREE: Composition = &[
    ("gravity", N(9.7)),
    ("body.crank.m", N(1.3)),
    ("body.crank.inertia", N(0.17)),
    ("body.crank.position", L(&[0.4, 0.3])),
    ("body.crank.angle", N(0.9)),
    ("body.crank.velocity", L(&[-1.0, 0.6])),
    ("body.crank.rate", N(2.0)),
    ("body.rod.m", N(0.7)),
    ("body.rod.inertia", N(0.23)),
    ("body.rod.position", L(&[1.4, 0.5])),
    ("body.rod.angle", N(-0.4)),
    ("body.rod.velocity", L(&[-1.4, 2.6])),
    ("body.rod.rate", N(2.0)),
    ("body.weight.m", N(2.1)),
    ("body.weight.inertia", N(0.31)),
    ("body.weight.position", L(&[2.2, -0.15])),
    ("body.weight.velocity", L(&[-0.1, 4.2])),
    ("body.weight.rate", N(2.0)),
    ("body.plate.m", N(0.4)),
    ("body.plate.inertia", N(0.05)),
    ("body.plate.position", L(&[2.5, 0.1])),
    ("body.plate.angle", N(7.0)),
    ("body.plate.velocity", L(&[-0.6, 4.8])),
    ("body.plate.rate", N(2.0)),
    ("body.ball.m", N(0.9)),
    ("body.ball.inertia", N(0.8)),
    ("body.ball.position", L(&[-0.3, 0.8])),
    ("body.ball.velocity", L(&[0.7, 1.1])),
    ("body.ball.rate", N(-3.0)),
    ("joint.hinge.kind", T("revolute")),
    ("joint.hinge.a", T("ground")),
    ("joint.hinge.b", T("crank")),
    ("joint.hinge.point", L(&[0.1, -0.2])),
    ("joint.pin.kind", T("revolute")),
    ("joint.pin.a", T("rod")),
    ("joint.pin.b", T("crank")),
    ("joint.pin.point", L(&[0.8, 0.7])),
    ("joint.guide.kind", T("prismatic")),
    ("joint.guide.a", T("weight")),
    ("joint.guide.b", T("rod")),
    ("joint.guide.point", L(&[2.3, -0.2])),
    ("joint.guide.axis", L(&[1.0, 0.2])),
    ("joint.bolt.kind", T("weld")),
    ("joint.bolt.a", T("weight")),
    ("joint.bolt.b", T("plate")),
    ("joint.bolt.point", L(&[2.4, 0.0])),
    ("spring.s.a", T("ball")),
    ("spring.s.b", T("rod")),
    ("spring.s.point_a", L(&[0.3, 0.1])),
    ("spring.s.point_b", L(&[0.2, 0.1])),
    ("spring.s.stiffness", N(41.0)),
    ("spring.s.rest_length", N(1.1)),
    ("torsion-spring.t.a", T("rod")),
    ("torsion-spring.t.b", T("crank")),
    ("torsion-spring.t.stiffness", N(2.3)),
    ("torsion-spring.t.rest_angle", N(0.8)),
    ("marker.tip.body", T("plate")),
    ("marker.tip.point", L(&[0.3, -0.2])),
    ("marker.tip.angle", N(0.6)),
    ("marker.ball.body", T("ball")),
];

/// A loop in space with one degree of freedom, from rest: revolute, spherical, universal and prismatic joints.
pub const SPATIAL_LOOP: Composition = &[
    ("gravity", L(&[0.7, -1.1, -9.7])),
    ("body.crank.m", N(1.3)),
    ("body.crank.inertia", L(&[0.17, 0.29, 0.23])),
    ("body.crank.position", L(&[0.4, 0.3, 0.1])),
    ("body.crank.attitude", L(&[0.9, 0.1, -0.2, 0.3])),
    ("body.rod.m", N(0.7)),
    ("body.rod.inertia", L(&[0.27, 0.31, 0.33])),
    ("body.rod.position", L(&[1.4, 0.5, -0.3])),
    ("body.slider.m", N(2.1)),
    ("body.slider.inertia", L(&[0.31, 0.27, 0.4])),
    ("body.slider.position", L(&[2.2, -0.15, -0.5])),
    ("body.slider.attitude", L(&[0.2, 0.9, 0.3, 0.4])),
    ("joint.hinge.kind", T("revolute")),
    ("joint.hinge.a", T("ground")),
    ("joint.hinge.b", T("crank")),
    ("joint.hinge.point", L(&[0.1, -0.2, 0.3])),
    ("joint.hinge.axis", L(&[0.3, -0.5, 1.0])),
    ("joint.ball.kind", T("spherical")),
    ("joint.ball.a", T("rod")),
    ("joint.ball.b", T("crank")),
    ("joint.ball.point", L(&[0.8, 0.7, -0.1])),
    ("joint.cross.kind", T("universal")),
    ("joint.cross.a", T("rod")),
    ("joint.cross.b", T("slider")),
    ("joint.cross.point", L(&[2.1, -0.1, -0.4])),
    ("joint.cross.axis", L(&[1.0, 0.0, 0.0])),
    ("joint.cross.second_axis", L(&[0.0, 0.6, 0.8])),
    ("joint.guide.kind", T("prismatic")),
    ("joint.guide.a", T("slider")),
    ("joint.guide.b", T("ground")),
    ("joint.guide.point", L(&[2.3, -0.2, -0.6])),
    ("joint.guide.axis", L(&[1.0, 0.2, -0.3])),
    ("spring.s.a", T("ground")),
    ("spring.s.b", T("rod")),
    ("spring.s.point_a", L(&[0.3, 1.9, 0.4])),
    ("spring.s.point_b", L(&[0.2, 0.1, -0.1])),
    ("spring.s.stiffness", N(41.0)),
    ("spring.s.rest_length", N(1.1)),
    ("torsion-spring.t.joint", T("hinge")),
    ("torsion-spring.t.stiffness", N(2.3)),
    ("torsion-spring.t.rest_angle", N(0.8)),
    ("marker.tip.body", T("rod")),
    ("marker.tip.point", L(&[0.3, -0.2, 0.1])),
    ("marker.tip.attitude", L(&[0.7, 0.1, 0.5, -0.2])),
    ("marker.block.body", T("slider")),
    ("marker.post.body", T("ground")),
    ("marker.post.point", L(&[-0.7, 0.4, 0.2])),
];

/// A tree in space with every kind of joint. It turns about its tilted hinge at 2 rad/s as if it were one body.
pub const SPATIAL_TREE: Composition = &[
    ("gravity", N(9.7)),
    ("body.arm.m", N(1.3)),
    ("body.arm.inertia", L(&[0.17, 0.29, 0.23])),
    ("body.arm.position", L(&[0.5, 0.1, 0.1])),
    ("body.arm.attitude", L(&[0.9, 0.1, -0.2, 0.3])),
    (
        "body.arm.velocity",
        L(&[-0.3455473702325442, 0.7947589515348514, 0.501043686837189]),
    ),
    (
        "body.arm.omega",
        L(&[0.6856387293561534, -0.8893298107563897, 1.6549900363769217]),
    ),
    ("body.rod.m", N(0.7)),
    ("body.rod.inertia", L(&[0.27, 0.31, 0.33])),
    ("body.rod.position", L(&[1.1, 0.4, -0.2])),
    ("body.rod.attitude", L(&[0.7, -0.4, 0.3, 0.2])),
    (
        "body.rod.velocity",
        L(&[-0.6047078979069523, 1.9868973788371285, 1.17486105879065]),
    ),
    (
        "body.rod.omega",
        L(&[
            -0.9834809768157025,
            -1.741027134633203,
            0.039870850411447556,
        ]),
    ),
    ("body.bob.m", N(0.9)),
    ("body.bob.inertia", L(&[0.11, 0.13, 0.19])),
    ("body.bob.position", L(&[1.5, 0.9, -0.6])),
    ("body.bob.attitude", L(&[0.5, 0.5, -0.6, 0.1])),
    (
        "body.bob.velocity",
        L(&[-1.1230289532557687, 2.885320541441743, 1.779568956697602]),
    ),
    (
        "body.bob.omega",
        L(&[
            1.9640594779309546,
            -0.009929522133118901,
            -0.37732184105852506,
        ]),
    ),
    ("body.block.m", N(0.6)),
    ("body.block.inertia", L(&[0.07, 0.08, 0.09])),
    ("body.block.position", L(&[1.7, 1.2, -0.9])),
    ("body.block.attitude", L(&[1.0, 0.0, 0.2, -0.1])),
    (
        "body.block.velocity",
        L(&[-1.3821894809301762, 3.3863642282789317, 2.107838958418519]),
    ),
    (
        "body.block.omega",
        L(&[
            -0.02468195501661022,
            -0.8145045155481396,
            1.8264646712291617,
        ]),
    ),
    ("body.cap.m", N(0.3)),
    ("body.cap.inertia", L(&[0.02, 0.03, 0.04])),
    ("body.cap.position", L(&[1.8, 1.3, -1.2])),
    ("body.cap.attitude", L(&[0.2, 0.9, 0.3, 0.4])),
    (
        "body.cap.velocity",
        L(&[-1.2958026383720402, 3.714634229999849, 2.2460579065115365]),
    ),
    (
        "body.cap.omega",
        L(&[0.6753880418181544, 1.7811396265622954, -0.6094199075010316]),
    ),
    ("joint.hinge.kind", T("revolute")),
    ("joint.hinge.a", T("arm")),
    ("joint.hinge.b", T("ground")),
    ("joint.hinge.point", L(&[0.1, -0.2, 0.3])),
    ("joint.hinge.axis", L(&[0.3, -0.5, 1.0])),
    ("joint.cross.kind", T("universal")),
    ("joint.cross.a", T("rod")),
    ("joint.cross.b", T("arm")),
    ("joint.cross.point", L(&[0.8, 0.3, 0.0])),
    ("joint.cross.axis", L(&[1.0, 0.0, 0.0])),
    ("joint.cross.second_axis", L(&[0.0, 0.6, 0.8])),
    ("joint.ball.kind", T("spherical")),
    ("joint.ball.a", T("rod")),
    ("joint.ball.b", T("bob")),
    ("joint.ball.point", L(&[1.3, 0.7, -0.3])),
    ("joint.guide.kind", T("prismatic")),
    ("joint.guide.a", T("block")),
    ("joint.guide.b", T("bob")),
    ("joint.guide.point", L(&[1.6, 1.1, -0.7])),
    ("joint.guide.axis", L(&[0.2, 1.0, -0.4])),
    ("joint.bolt.kind", T("weld")),
    ("joint.bolt.a", T("block")),
    ("joint.bolt.b", T("cap")),
    ("joint.bolt.point", L(&[1.7, 1.3, -1.0])),
    ("spring.s.a", T("ground")),
    ("spring.s.b", T("bob")),
    ("spring.s.point_a", L(&[0.3, 1.9, 0.4])),
    ("spring.s.point_b", L(&[0.2, 0.1, -0.1])),
    ("spring.s.stiffness", N(41.0)),
    ("spring.s.rest_length", N(1.1)),
    ("torsion-spring.t.joint", T("hinge")),
    ("torsion-spring.t.stiffness", N(2.3)),
    ("torsion-spring.t.rest_angle", N(0.8)),
    ("marker.tip.body", T("cap")),
    ("marker.tip.point", L(&[0.3, -0.2, 0.1])),
    ("marker.tip.attitude", L(&[0.7, 0.1, 0.5, -0.2])),
    ("marker.block.body", T("block")),
];

/// A crank in the plane that is shaken by its hinge, and a rod on it against a spring and dampers.
pub const SHAKEN_CRANK: Composition = &[
    ("body.crank.m", N(1.3)),
    ("body.crank.inertia", N(0.17)),
    ("body.crank.position", L(&[0.4, 0.3])),
    ("body.rod.m", N(0.7)),
    ("body.rod.inertia", N(0.23)),
    ("body.rod.position", L(&[1.4, 0.5])),
    ("joint.hinge.kind", T("revolute")),
    ("joint.hinge.a", T("crank")),
    ("joint.hinge.b", T("ground")),
    ("joint.hinge.point", L(&[0.1, -0.2])),
    ("joint.pin.kind", T("revolute")),
    ("joint.pin.a", T("crank")),
    ("joint.pin.b", T("rod")),
    ("joint.pin.point", L(&[0.8, 0.7])),
    ("motion.shake.joint", T("hinge")),
    ("motion.shake.amplitude", N(0.3)),
    ("motion.shake.frequency", N(1.7)),
    ("motion.shake.phase", N(std::f64::consts::FRAC_PI_2)),
    ("spring.s.a", T("ground")),
    ("spring.s.b", T("rod")),
    ("spring.s.point_a", L(&[0.3, 1.9])),
    ("spring.s.stiffness", N(41.0)),
    ("spring.s.damping", N(3.0)),
    ("torsion-spring.t.a", T("rod")),
    ("torsion-spring.t.b", T("crank")),
    ("torsion-spring.t.damping", N(0.7)),
    ("marker.tip.body", T("rod")),
    ("marker.tip.point", L(&[0.3, -0.2])),
];
