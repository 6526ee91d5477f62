//! Pendulums in the plane.

use linchpin_models::reference::{DoublePendulum, GroundHinge, Link};

use crate::common::Solver;
use crate::common::body::{Body, TIGHT, difference};
use crate::common::mechanisms::Composition;
use crate::common::mechanisms::Given::{List as L, Number as N, Text as T};
use crate::{FORMULATIONS, planar};

/// The first link of the double pendulum of S1 Sect. 4.2, its hinge told by points on the bodies.
const LINK: Composition = &[
    ("body.link.m", N(1.0)),
    ("body.link.inertia", N(1.0 / 12.0)),
    (
        "body.link.position",
        L(&[0.3535533905932738, 0.3535533905932738]),
    ),
    ("body.link.angle", N(std::f64::consts::FRAC_PI_4)),
    ("joint.hinge.kind", T("revolute")),
    ("joint.hinge.a", T("ground")),
    ("joint.hinge.b", T("link")),
    ("joint.hinge.point_a", L(&[0.0, 0.0])),
    ("joint.hinge.point_b", L(&[-0.5, 0.0])),
    ("torsion-spring.t.a", T("ground")),
    ("torsion-spring.t.b", T("link")),
    ("torsion-spring.t.stiffness", N(500.0)),
    ("torsion-spring.t.damping", N(50.0)),
    (
        "torsion-spring.t.rest_angle",
        N(std::f64::consts::FRAC_PI_4),
    ),
    ("marker.tip.body", T("link")),
    ("marker.tip.point", L(&[0.5, 0.0])),
];

#[test]
fn the_link_of_schweizer_and_lu_is_that_of_the_pendulum_model() {
    let parameters = [
        ("m", 1.0),
        ("inertia", 1.0 / 12.0),
        ("length", 1.0),
        ("spring", 500.0),
        ("damping", 50.0),
        ("rest_angle", std::f64::consts::FRAC_PI_4),
        ("angle0", std::f64::consts::FRAC_PI_4),
    ];
    for formulation in FORMULATIONS {
        let mut pendulum = Body::new("pendulum", &parameters, TIGHT);
        let mut own = planar(LINK, formulation, TIGHT);
        for body in [&mut pendulum, &mut own] {
            body.drive("tip_fx", -31.0);
            body.drive("tip_fy", 17.0);
            body.drive("tip_moment", 9.0);
        }
        let marker = own.model.markers[0].clone();
        let names = [marker.position, marker.velocity, marker.acceleration].concat();
        for _ in 0..40 {
            let error = difference(&pendulum.read(&names), &own.read(&names));
            assert!(error < 1e-9, "{formulation}: {error:e} at t = {}", own.t);
            let angle = difference(&own.read(&["hinge_angle"]), &pendulum.read(&["angle"]));
            let rate = difference(&own.read(&["hinge_rate"]), &pendulum.read(&["rate"]));
            let energy = own.read_one("energy") - pendulum.read_one("energy");
            assert!(angle < 1e-10 && rate < 1e-9 && energy.abs() < 1e-9);
            pendulum.advance(0.037);
            own.advance(0.037);
        }
    }
}

const DOUBLE: Composition = &[
    ("gravity", N(9.7)),
    ("body.first.m", N(1.3)),
    ("body.first.inertia", N(0.11)),
    ("body.first.position", L(&[0.45, 0.0])),
    ("body.first.velocity", L(&[0.0, -0.54])),
    ("body.first.rate", N(-1.2)),
    ("body.second.m", N(0.7)),
    ("body.second.inertia", N(0.05)),
    ("body.second.position", L(&[0.9, -0.3])),
    ("body.second.angle", N(-std::f64::consts::FRAC_PI_2)),
    ("body.second.velocity", L(&[0.6, -1.08])),
    ("body.second.rate", N(2.0)),
    ("joint.hinge.kind", T("revolute")),
    ("joint.hinge.a", T("ground")),
    ("joint.hinge.b", T("first")),
    ("joint.hinge.point", L(&[0.0, 0.0])),
    ("joint.pin.kind", T("revolute")),
    ("joint.pin.a", T("second")),
    ("joint.pin.b", T("first")),
    ("joint.pin.point", L(&[0.9, 0.0])),
    ("torsion-spring.t.a", T("ground")),
    ("torsion-spring.t.b", T("first")),
    ("torsion-spring.t.stiffness", N(3.0)),
    ("torsion-spring.t.damping", N(0.2)),
    ("torsion-spring.t.rest_angle", N(0.4)),
    ("marker.first.body", T("first")),
    ("marker.second.body", T("second")),
];

#[test]
fn a_double_pendulum_inside_one_subsystem_is_that_of_the_reference() {
    let link = |m, inertia, length| Link { m, inertia, length };
    let reference = DoublePendulum {
        links: [link(1.3, 0.11, 0.9), link(0.7, 0.05, 0.6)],
        hinge: GroundHinge {
            spring: 3.0,
            damping: 0.2,
            rest_angle: 0.4,
        },
        gravity: 9.7,
        angles: [0.0, -std::f64::consts::FRAC_PI_2],
        rates: [-1.2, 2.0],
    };
    let times: Vec<f64> = (0..=60).map(|i| 0.05 * f64::from(i)).collect();
    let motions = reference.motions(&times).unwrap();
    for formulation in FORMULATIONS {
        let mut own = planar(DOUBLE, formulation, TIGHT);
        let mut largest: f64 = 0.0;
        for motion in &motions {
            let read = own.read_all([
                "first_angle",
                "second_angle",
                "first_rate",
                "second_rate",
                "pin_fx",
                "pin_fy",
                "energy",
            ]);
            let [force] = motion.hinge_forces[..] else {
                panic!("{} hinges", motion.hinge_forces.len());
            };
            let expected = [&motion.angles[..], &motion.rates, &force, &[motion.energy]].concat();
            largest = largest.max(difference(&read, &expected));
            own.advance(0.05);
        }
        println!("{formulation}: {largest:e}");
        assert!(largest < 1e-8, "{formulation}: {largest:e}");
    }
}

/// Neither the projection nor its place at the ends of macro steps lowers the order.
#[test]
fn rk4_is_of_order_four_in_both_formulations() {
    for formulation in FORMULATIONS {
        let end = |solver: Solver| {
            let mut own = planar(DOUBLE, formulation, solver);
            (0..4).for_each(|_| own.advance(0.2));
            own.read(&["second_x", "second_y", "second_angle", "first_rate"])
        };
        let exact = end(TIGHT);
        let errors = [&[("step", 4e-3)], &[("step", 2e-3)], &[("step", 1e-3)]]
            .map(|options| difference(&end(Solver("rk4", options)), &exact));
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!(
                (order - 4.0).abs() < 0.2,
                "{formulation} {errors:?}: {order}"
            );
        }
    }
}

/// The error of radau5 is that of its tolerance, far below that of a step.
#[test]
fn radau5_keeps_its_tolerance_in_both_formulations() {
    for formulation in FORMULATIONS {
        let end = |solver: Solver| {
            let mut own = planar(DOUBLE, formulation, solver);
            (0..8).for_each(|_| own.advance(0.1));
            own.read(&["second_x", "second_y", "second_angle", "first_rate"])
        };
        let exact = end(TIGHT);
        for (tolerance, solver) in [
            (1e-5, Solver("radau5", &[("rtol", 1e-5), ("atol", 1e-5)])),
            (1e-8, Solver("radau5", &[("rtol", 1e-8), ("atol", 1e-8)])),
        ] {
            let error = difference(&end(solver), &exact);
            println!("{formulation} {tolerance:e}: {error:e}");
            assert!(
                error < 10.0 * tolerance,
                "{formulation} {tolerance:e}: {error:e}"
            );
        }
    }
}
