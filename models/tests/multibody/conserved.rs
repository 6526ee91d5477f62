//! What mechanisms keep: energy, momentum, the joints themselves.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::common::Solver;
use crate::common::body::{Body, TIGHT, difference};
use crate::common::cases::CASES;
use crate::common::mechanisms::Given::{List as L, Number as N, Text as T};
use crate::common::mechanisms::{Given, SLIDER_CRANK, SPATIAL_LOOP, SPATIAL_TREE, with};
use crate::{planar, spatial};

const NORMAL: Solver = Solver("radau5", &[]);

#[test]
fn every_mechanism_keeps_its_energy() {
    for case in CASES
        .into_iter()
        .filter(|case| !case.composition.is_empty())
    {
        let mut run = Body::of(case, TIGHT);
        let start = run.read_one("energy");
        let mut largest: f64 = 0.0;
        let mut exchanged: f64 = 0.0;
        let marker = run.model.markers[0].velocity.clone();
        for _ in 0..100 {
            run.advance(0.05);
            largest = largest.max((run.read_one("energy") - start).abs());
            let speed: f64 = run.read(&marker).iter().map(|v| v * v).sum();
            exchanged = exchanged.max(speed);
        }
        println!("{} minimal {}: {largest:e}", case.model, case.is_minimal);
        assert!(exchanged > 0.5, "{} hardly moved: {exchanged}", case.model);
        assert!(largest < 1e-8, "{}: {largest:e}", case.model);
    }
}

/// Markers at the two sides of every joint of the loops.
fn watched(
    composition: &[(&'static str, Given)],
    points: &'static [[&'static str; 2]],
) -> Vec<(String, Given)> {
    let own = composition
        .iter()
        .map(|(name, given)| ((*name).to_owned(), *given));
    let mut all: Vec<_> = own.collect();
    for [joint, side] in points {
        let body = composition
            .iter()
            .find(|(name, _)| *name == format!("joint.{joint}.{side}"));
        all.push((format!("marker.{joint}-{side}.body"), body.unwrap().1));
    }
    all
}

const SIDES: &[[&str; 2]] = &[["pin", "a"], ["pin", "b"], ["wrist", "a"], ["wrist", "b"]];

/// Place of the joint's point on a body that is not turned at the start is the difference of the two places.
fn gap(run: &mut Body, joint: &str, arms: [[f64; 2]; 2]) -> f64 {
    let mut points = [[0.0; 2]; 2];
    for (side, (point, arm)) in ["a", "b"].into_iter().zip(points.iter_mut().zip(arms)) {
        let name = |suffix: &str| format!("{joint}-{side}_{suffix}");
        let read = run.read(&[name("x"), name("y"), name("angle")]);
        let (sin, cos) = read[2].sin_cos();
        *point = [
            read[0] + cos * arm[0] - sin * arm[1],
            read[1] + sin * arm[0] + cos * arm[1],
        ];
    }
    difference(&points[0], &points[1])
}

/// The joint's point in the axes of a body: `from` and `angle` are those of the body at the start.
fn arm(point: [f64; 2], from: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    let [x, y] = [point[0] - from[0], point[1] - from[1]];
    [cos * x + sin * y, cos * y - sin * x]
}

#[test]
fn joints_do_not_drift_open_over_long_runs() {
    let composition = watched(SLIDER_CRANK, SIDES);
    let composition: Vec<(&str, Given)> = composition
        .iter()
        .map(|(name, given)| (name.as_str(), *given))
        .collect();
    let (rod, crank, slider) = (([1.4, 0.5], -0.4), ([0.4, 0.3], 0.9), ([2.2, -0.15], 0.0));
    let pin = [
        arm([0.8, 0.7], rod.0, rod.1),
        arm([0.8, 0.7], crank.0, crank.1),
    ];
    let wrist = [
        arm([2.1, -0.1], rod.0, rod.1),
        arm([2.1, -0.1], slider.0, slider.1),
    ];
    for solver in [NORMAL, Solver("rk4", &[("step", 5e-3)])] {
        let mut run = planar(&composition, "absolute", solver);
        let mut largest: f64 = 0.0;
        for _ in 0..4000 {
            run.advance(0.01);
            largest = largest
                .max(gap(&mut run, "pin", pin))
                .max(gap(&mut run, "wrist", wrist));
        }
        println!("{solver:?}: {largest:e} m after {} s", run.t);
        assert!(largest < 5e-15, "{solver:?}: {largest:e}");
    }
}

/// In space: the spherical joint by points, and the hinge by the angle between its axes.
#[test]
fn joints_in_space_do_not_drift_open_over_long_runs() {
    let more: [(&str, Given); 3] = [
        ("marker.rod.body", T("rod")),
        ("marker.crank.body", T("crank")),
        ("marker.slider.body", T("slider")),
    ];
    let mut run = spatial(&with(SPATIAL_LOOP, &more), "absolute", NORMAL);
    let read = |run: &mut Body, name: &str| {
        let names = ["x", "y", "z", "qw", "qx", "qy", "qz"].map(|part| format!("{name}_{part}"));
        let [x, y, z, qw, qx, qy, qz] = <[f64; 7]>::try_from(run.read(&names)).unwrap();
        let attitude = UnitQuaternion::new_normalize(Quaternion::new(qw, qx, qy, qz));
        (Vector3::new(x, y, z), attitude)
    };
    let ball = Vector3::new(0.8, 0.7, -0.1);
    let axis = Vector3::new(0.3, -0.5, 1.0).normalize();
    let start = ["rod", "crank", "slider"].map(|name| read(&mut run, name));
    let local =
        |(from, attitude): (Vector3<f64>, UnitQuaternion<f64>)| attitude.inverse() * (ball - from);
    let (on_rod, on_crank) = (local(start[0]), local(start[1]));
    let axis_on_crank = start[1].1.inverse() * axis;
    let mut largest: f64 = 0.0;
    for _ in 0..3000 {
        run.advance(0.01);
        let [rod, crank, slider] = ["rod", "crank", "slider"].map(|name| read(&mut run, name));
        let gap = rod.0 + rod.1 * on_rod - crank.0 - crank.1 * on_crank;
        let tilt = (crank.1 * axis_on_crank).cross(&axis);
        let turned = (slider.1 * start[2].1.inverse()).angle();
        largest = largest.max(gap.norm()).max(tilt.norm()).max(turned);
    }
    println!("{largest:e}");
    assert!(largest < 1e-14, "{largest:e}");
}

/// Nothing holds it on the ground: a rod with two bodies on it, in space.
const FLOATING: &[(&str, Given)] = &[
    ("joint.hinge.a", T("arm")),
    ("joint.hinge.b", T("extra")),
    ("body.extra.m", N(0.8)),
    ("body.extra.inertia", L(&[0.2, 0.21, 0.3])),
    ("body.extra.position", L(&[-0.2, -0.5, 0.4])),
    (
        "body.extra.velocity",
        L(&[0.4319342127906801, -0.5701531608836977, -0.4146568442790529]),
    ),
    (
        "body.extra.omega",
        L(&[0.5183210553488161, -0.8638684255813602, 1.7277368511627205]),
    ),
    ("spring.s.a", T("extra")),
    ("gravity", L(&[0.7, -1.1, -9.7])),
];

#[test]
fn a_floating_mechanism_keeps_momentum_and_angular_momentum() {
    let bodies: [(&str, f64, [f64; 3]); 6] = [
        ("arm", 1.3, [0.17, 0.29, 0.23]),
        ("rod", 0.7, [0.27, 0.31, 0.33]),
        ("bob", 0.9, [0.11, 0.13, 0.19]),
        ("block", 0.6, [0.07, 0.08, 0.09]),
        ("cap", 0.3, [0.02, 0.03, 0.04]),
        ("extra", 0.8, [0.2, 0.21, 0.3]),
    ];
    let markers = bodies.map(|(name, ..)| (format!("marker.m-{name}.body"), T(name)));
    let markers: Vec<(&str, Given)> = markers
        .iter()
        .map(|(name, given)| (name.as_str(), *given))
        .collect();
    let composition = with(&with(SPATIAL_TREE, FLOATING), &markers);
    let mass: f64 = bodies.iter().map(|(_, mass, _)| mass).sum();
    let gravity = Vector3::new(0.7, -1.1, -9.7);
    let momenta = |run: &mut Body| {
        let (mut momentum, mut spin, mut first) =
            (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        for (name, mass, inertia) in bodies {
            let marker = run
                .model
                .markers
                .iter()
                .find(|own| own.name == format!("m-{name}"));
            let marker = marker.unwrap().clone();
            let [x, y, z, qw, qx, qy, qz] =
                <[f64; 7]>::try_from(run.read(&marker.position)).unwrap();
            let velocity = run.read(&marker.velocity);
            let (position, attitude) = (
                Vector3::new(x, y, z),
                UnitQuaternion::new_normalize(Quaternion::new(qw, qx, qy, qz)),
            );
            let own = mass * Vector3::from_column_slice(&velocity[..3]);
            let omega = attitude.inverse() * Vector3::from_column_slice(&velocity[3..]);
            momentum += own;
            first += mass * position;
            spin += position.cross(&own) + attitude * Vector3::from(inertia).component_mul(&omega);
        }
        (momentum, spin - first.cross(&momentum) / mass)
    };
    for formulation in ["absolute", "minimal"] {
        let mut run = spatial(&composition, formulation, TIGHT);
        let (momentum, spin) = momenta(&mut run);
        let mut largest: f64 = 0.0;
        for _ in 0..60 {
            run.advance(0.05);
            let (now, turning) = momenta(&mut run);
            let expected = momentum + mass * run.t * gravity;
            largest = largest
                .max((now - expected).norm())
                .max((turning - spin).norm());
        }
        println!("{formulation}: {largest:e}");
        assert!(largest < 1e-9, "{formulation}: {largest:e}");
    }
}
