//! Against references with joint coordinates: chains in space, and a linkage in the plane.

use linchpin_models::reference::{
    Bar, FourBar, FourBarMotion, Freedom, Shake, Side, SpatialChain, SpatialChainMotion,
};
use nalgebra::{Rotation2, Vector2, Vector3};

use crate::common::body::{Body, TIGHT, difference};
use crate::common::mechanisms::Given::{Number as N, Text as T};
use crate::common::mechanisms::{Given, list};
use crate::common::spatial::{attitude, place};
use crate::{FORMULATIONS, planar, spatial};

const BODIES: [&str; 2] = ["first", "second"];

/// A chain of two bodies as a composition that starts where the chain does.
fn composition(chain: &SpatialChain) -> Vec<(String, Given)> {
    let start = chain.motions(&[0.0]).unwrap().remove(0);
    let mut all = vec![("gravity".to_owned(), list(chain.gravity.as_slice()))];
    for (number, name) in BODIES.into_iter().enumerate() {
        let (own, motion) = (&chain.bodies[number], &start.bodies[number]);
        let q = motion.attitude;
        let body = [
            ("m", N(own.body.m)),
            ("inertia", list(own.body.moments.as_slice())),
            ("position", list(motion.position.as_slice())),
            ("attitude", list(&[q.w, q.i, q.j, q.k])),
            ("velocity", list(motion.velocity.as_slice())),
            ("omega", list(motion.omega.as_slice())),
        ];
        all.extend(body.map(|(key, given)| (format!("body.{name}.{key}"), given)));
        all.push((format!("marker.{name}.body"), T(name)));
        let joint = joint(chain, &start, number);
        let joint = joint.into_iter();
        all.extend(joint.map(|(key, given)| (format!("joint.at-{name}.{key}"), given)));
    }
    all
}

/// Keys of a revolute or a universal joint.
fn joint(
    chain: &SpatialChain,
    start: &SpatialChainMotion,
    number: usize,
) -> Vec<(&'static str, Given)> {
    let joint = &chain.bodies[number].joint;
    let outer = &start.bodies[number];
    let axes = joint.freedoms.iter().map(|freedom| match freedom {
        Freedom::Turn(axis) => axis.into_inner(),
        Freedom::Slide(axis) => panic!("a slide along {axis:?}"),
    });
    let axes: Vec<Vector3<f64>> = axes.collect();
    let (inner, axis) = match number {
        0 => ("ground", axes[0]),
        _ => (BODIES[0], attitude(&start.bodies[0]) * axes[0]),
    };
    let mut keys = vec![
        ("a", T(inner)),
        ("b", T(BODIES[number])),
        ("point", list(place(outer, &joint.outer_point).as_slice())),
        ("axis", list(axis.as_slice())),
    ];
    match axes[1..] {
        [] => keys.push(("kind", T("revolute"))),
        [second] => {
            let held = attitude(outer) * (joint.attitude.inverse() * second);
            keys.extend([
                ("kind", T("universal")),
                ("second_axis", list(held.as_slice())),
            ]);
        }
        _ => panic!("{} turns", axes.len()),
    }
    keys
}

/// Motion, reactions and energy of a composition less those of its chain.
fn error(own: &mut Body, motion: &SpatialChainMotion) -> f64 {
    let mut largest: f64 = (own.read_one("energy") - motion.energy).abs();
    for (number, name) in BODIES.into_iter().enumerate() {
        let (body, reaction) = (&motion.bodies[number], &motion.reactions[number]);
        let read = |own: &mut Body, parts: [&str; 3]| {
            Vector3::from_vec(own.read(&parts.map(|part| format!("{name}_{part}"))))
        };
        let position = read(own, ["x", "y", "z"]);
        let velocity = read(own, ["vx", "vy", "vz"]);
        let omega = read(own, ["omega_x", "omega_y", "omega_z"]);
        let force = ["fx", "fy", "fz"].map(|part| format!("at-{name}_{part}"));
        let moment = ["x", "y", "z"].map(|part| format!("at-{name}_moment_{part}"));
        let force = Vector3::from_vec(own.read(&force));
        let moment = Vector3::from_vec(own.read(&moment));
        for error in [
            position - body.position,
            velocity - body.velocity,
            omega - attitude(body) * body.omega,
            force - reaction.force,
            moment - reaction.moment,
        ] {
            largest = largest.max(error.norm());
        }
    }
    largest
}

#[test]
fn double_pendulums_in_space_are_those_of_the_reference() {
    let times: Vec<f64> = (0..=30).map(|i| 0.07 * f64::from(i)).collect();
    for chain in [
        SpatialChain::universal_double_pendulum(),
        SpatialChain::revolute_double_pendulum(),
    ] {
        let composition = composition(&chain);
        let composition: Vec<_> = composition
            .iter()
            .map(|(name, given)| (name.as_str(), *given))
            .collect();
        for formulation in FORMULATIONS {
            let mut own = spatial(&composition, formulation, TIGHT);
            let mut largest: f64 = 0.0;
            for motion in chain.motions(&times).unwrap() {
                largest = largest.max(error(&mut own, &motion));
                own.advance(0.07);
            }
            println!("{formulation}: {largest:e}");
            assert!(largest < 1e-7, "{formulation}: {largest:e}");
        }
    }
}

const BARS: [&str; 3] = ["crank", "coupler", "rocker"];
const HINGES: [[&str; 3]; 4] = [
    ["frame-crank", "frame", "crank"],
    ["crank-coupler", "crank", "coupler"],
    ["coupler-rocker", "coupler", "rocker"],
    ["rocker-frame", "rocker", "frame"],
];

fn linkage() -> FourBar {
    let bar = |m, inertia, length, centre| Bar {
        m,
        inertia,
        length,
        centre,
    };
    FourBar {
        bars: [
            bar(0.9, 0.02, 0.4, [0.17, 0.05]),
            bar(1.4, 0.13, 1.3, [0.6, -0.11]),
            bar(1.1, 0.07, 0.9, [0.5, 0.07]),
        ],
        frame_hinges: [[0.1, -0.2], [1.2, 0.05]],
        side: Side::Left,
        shake: Shake {
            amplitude: 0.07,
            frequency: 1.3,
        },
        gravity: 9.7,
        torque: 0.0,
        angle: 0.8,
        rate: 7.0,
    }
}

/// The linkage on a frame that slides on the ground: a loop, and a motion.
fn on_frame(linkage: &FourBar) -> Vec<(String, Given)> {
    let start = linkage.motions(&[0.0]).unwrap().remove(0);
    let frame_velocity = Vector2::new(start.frame_velocity, 0.0);
    let turned =
        |bar: usize, point: [f64; 2]| Rotation2::new(start.angles[bar]) * Vector2::from(point);
    let [crank_hinge, rocker_hinge] = linkage.frame_hinges.map(Vector2::from);
    let crank_tip = turned(0, [linkage.bars[0].length, 0.0]);
    let roots = [crank_hinge, crank_hinge + crank_tip, rocker_hinge];
    let across = |bar: usize, arm: Vector2<f64>| start.rates[bar] * Vector2::new(-arm.y, arm.x);
    let root_speeds = [
        frame_velocity,
        frame_velocity + across(0, crank_tip),
        frame_velocity,
    ];
    let mut all = vec![
        ("gravity".to_owned(), N(linkage.gravity)),
        ("body.frame.m".to_owned(), N(2.0)),
        ("body.frame.inertia".to_owned(), N(0.3)),
        (
            "body.frame.velocity".to_owned(),
            list(frame_velocity.as_slice()),
        ),
        ("marker.frame.body".to_owned(), T("frame")),
    ];
    for (number, name) in BARS.into_iter().enumerate() {
        let bar = &linkage.bars[number];
        let arm = turned(number, bar.centre);
        let body = [
            ("m", N(bar.m)),
            ("inertia", N(bar.inertia)),
            ("angle", N(start.angles[number])),
            ("position", list((roots[number] + arm).as_slice())),
            ("rate", N(start.rates[number])),
            (
                "velocity",
                list((root_speeds[number] + across(number, arm)).as_slice()),
            ),
        ];
        all.extend(body.map(|(key, given)| (format!("body.{name}.{key}"), given)));
        all.push((format!("marker.{name}.body"), T(name)));
    }
    let rocker_tip = rocker_hinge + turned(2, [linkage.bars[2].length, 0.0]);
    let points = [crank_hinge, roots[1], rocker_tip, rocker_hinge];
    for ([name, a, b], point) in HINGES.into_iter().zip(points) {
        let hinge = [
            ("kind", T("revolute")),
            ("a", T(a)),
            ("b", T(b)),
            ("point", list(point.as_slice())),
        ];
        all.extend(hinge.map(|(key, given)| (format!("joint.{name}.{key}"), given)));
    }
    let Shake {
        amplitude,
        frequency,
    } = linkage.shake;
    let rail = [
        ("joint.rail.kind", T("prismatic")),
        ("joint.rail.a", T("ground")),
        ("joint.rail.b", T("frame")),
        ("joint.rail.point", list(&[0.0, 0.0])),
        ("joint.rail.axis", list(&[1.0, 0.0])),
        ("motion.shake.joint", T("rail")),
        ("motion.shake.amplitude", N(amplitude)),
        ("motion.shake.frequency", N(frequency)),
    ];
    all.extend(rail.map(|(name, given)| (name.to_owned(), given)));
    all
}

fn error_of_linkage(own: &mut Body, motion: &FourBarMotion) -> f64 {
    let angles = own.read(&BARS.map(|bar| format!("{bar}_angle")));
    let rates = own.read(&BARS.map(|bar| format!("{bar}_rate")));
    let mut largest = difference(&angles, &motion.angles).max(difference(&rates, &motion.rates));
    largest = largest.max((own.read_one("frame_x") - motion.frame_position).abs());
    for ([name, ..], expected) in HINGES.into_iter().zip(&motion.hinge_forces) {
        let force = own.read(&[format!("{name}_fx"), format!("{name}_fy")]);
        largest = largest.max(difference(&force, expected));
    }
    largest
}

#[test]
fn a_four_bar_linkage_on_a_shaken_frame_is_that_of_the_reference() {
    let linkage = linkage();
    let composition = on_frame(&linkage);
    let composition: Vec<_> = composition
        .iter()
        .map(|(name, given)| (name.as_str(), *given))
        .collect();
    let times: Vec<f64> = (0..=40).map(|i| 0.05 * f64::from(i)).collect();
    let mut own = planar(&composition, "absolute", TIGHT);
    let mut largest: f64 = 0.0;
    let motions = linkage.motions(&times).unwrap();
    for motion in &motions {
        largest = largest.max(error_of_linkage(&mut own, motion));
        own.advance(0.05);
    }
    let turned = motions[40].angles[0] - motions[0].angles[0];
    println!("{largest:e}, the crank turned by {turned} rad");
    assert!(turned.abs() > 3.0, "{turned}");
    assert!(largest < 1e-7, "{largest:e}");
}
