//! The free body in space against closed forms of Euler's equations.

#![allow(clippy::unwrap_used)]

mod common;

use common::body::{Body, TIGHT, difference};
use common::cases::{CASES, Case};
use common::{Solver, agm};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use std::f64::consts::PI;

const BODY: Case = CASES[3];
const INERTIA: Vector3<f64> = Vector3::new(0.17, 0.29, 0.23);
const M: f64 = 1.3;

fn vector(body: &mut Body, names: [&str; 3]) -> Vector3<f64> {
    Vector3::from(body.read_all(names))
}

fn omega(body: &mut Body) -> Vector3<f64> {
    vector(body, ["omega1", "omega2", "omega3"])
}

fn attitude(body: &mut Body) -> UnitQuaternion<f64> {
    let [w, x, y, z] = body.read_all(["start_qw", "start_qx", "start_qy", "start_qz"]);
    UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z))
}

/// Angular momentum about the centre of mass, in space.
fn spin(body: &mut Body, inertia: Vector3<f64>) -> Vector3<f64> {
    attitude(body) * inertia.component_mul(&omega(body))
}

fn advance(body: &mut Body, length: f64, steps: u32) {
    (0..steps).for_each(|_| body.advance(length / f64::from(steps)));
}

/// Thrown with a spin about its middle axis, a body tumbles through every attitude (Dzhanibekov). The angular velocity
/// in the body has the period `4 K(k) / nu`, `nu^2 = (C - B) (L^2 - 2 E A) / A B C`,
/// `k^2 = (B - A) (2 E C - L^2) / (C - B) (L^2 - 2 E A)` for `A < B < C`, `L^2 > 2 E B` (Landau & Lifshitz I,
/// Sect. 37).
#[test]
fn a_tumbling_body_keeps_angular_momentum_and_energy_and_has_the_elliptic_period() {
    let thrown = [
        ("gravity", 0.0),
        ("omega1_0", 1e-3),
        ("omega2_0", 2e-3),
        ("omega3_0", 9.0),
    ];
    let mut body = Body::altered(BODY, &thrown, TIGHT);
    let start = omega(&mut body);
    let (momentum, energy) = (spin(&mut body, INERTIA), body.read_one("energy"));
    let translation = 0.5 * M * (4.0 + 0.81 + 1.44);
    let twice = 2.0 * (energy - translation);
    let squared = momentum.norm_squared();
    let [a, c, b] = INERTIA.into();
    let (fast, slow) = (
        (c - b) * (squared - twice * a),
        (b - a) * (twice * c - squared),
    );
    assert!(squared > twice * b);
    let period =
        4.0 * PI / (2.0 * agm(1.0, (1.0 - slow / fast).sqrt())) * (a * b * c / fast).sqrt();

    advance(&mut body, 0.5 * period, 50);
    let half = omega(&mut body);
    assert!((half[2] + start[2]).abs() < 1e-6, "turned over: {half}");
    advance(&mut body, 0.5 * period, 50);
    assert!(
        (omega(&mut body) - start).norm() < 1e-6,
        "{start} {}",
        omega(&mut body)
    );
    advance(&mut body, 3.3 * period, 300);
    let (drift, turn) = (
        (body.read_one("energy") - energy).abs(),
        (spin(&mut body, INERTIA) - momentum).norm(),
    );
    println!("period {period}, drift of energy {drift:e}, of angular momentum {turn:e}");
    assert!(drift < 1e-8 && turn < 1e-8, "{drift:e} {turn:e}");
    let centre = vector(&mut body, ["x", "y", "z"]);
    let straight = Vector3::new(0.3, -0.7, 0.2) + Vector3::new(2.0, 0.9, -1.2) * body.t;
    assert!((centre - straight).norm() < 1e-10);
}

/// The axis of a symmetric top goes round its angular momentum at the rate `L / A`, and its angular velocity goes round
/// the axis, seen from the top, at the rate `(C - A) omega_3 / A`.
#[test]
fn a_symmetric_top_precesses_steadily() {
    let inertia = Vector3::new(0.21, 0.21, 0.37);
    let shape = [("j1", 0.21), ("j2", 0.21), ("j3", 0.37)];
    let mut body = Body::altered(BODY, &shape, TIGHT);
    let (start, momentum) = (omega(&mut body), spin(&mut body, inertia));
    let axis = attitude(&mut body) * Vector3::z();
    for _ in 0..12 {
        body.advance(0.31);
        let turn = UnitQuaternion::from_scaled_axis(momentum * body.t / 0.21);
        let expected = turn * axis;
        assert!((attitude(&mut body) * Vector3::z() - expected).norm() < 1e-9);
        let angle = (0.37 - 0.21) / 0.21 * start.z * body.t;
        let expected = UnitQuaternion::from_scaled_axis(Vector3::z() * angle) * start;
        assert!((omega(&mut body) - expected).norm() < 1e-9);
    }
}

#[test]
fn loads_change_momentum_and_angular_momentum_about_the_origin() {
    let momenta = |body: &mut Body| {
        let centre = vector(body, ["x", "y", "z"]);
        let momentum = M * vector(body, ["vx", "vy", "vz"]);
        let angular = centre.cross(&momentum) + spin(body, INERTIA);
        [momentum.as_slice(), angular.as_slice()].concat()
    };
    let loaded = || {
        let mut body = Body::of(BODY, TIGHT);
        body.drive_all(7.0);
        body
    };
    let changes = loaded().rates(1e-3, momenta).rates;

    let mut body = loaded();
    body.advance(2e-3);
    let weight = Vector3::new(0.0, 0.0, -M * 9.7);
    let mut force = weight;
    let mut moment = vector(&mut body, ["x", "y", "z"]).cross(&weight);
    for marker in body.model.markers.clone() {
        let point = Vector3::from_vec(body.read(&marker.position[..3]));
        let loads: Vec<_> = marker.load.iter().map(|name| body.input(name)).collect();
        let (own_force, own_moment) = loads.split_at(3);
        let own_force = Vector3::from_row_slice(own_force);
        force += own_force;
        moment += point.cross(&own_force) + Vector3::from_row_slice(own_moment);
    }
    let expected = [force.as_slice(), moment.as_slice()].concat();
    let error = difference(&changes, &expected);
    assert!(error < 1e-8, "{error:e}: {changes:?} {expected:?}");
}

/// In the plane of x and z it is the planar link, whose angle turns about -y.
#[test]
fn motion_in_a_plane_is_that_of_the_planar_link() {
    let planar = [
        ("x0", 0.3),
        ("y0", 0.0),
        ("angle0", 1.1),
        ("vx0", 0.0),
        ("vy0", 0.0),
        ("rate0", 0.0),
    ];
    let mut link = Body::altered(CASES[2], &planar, TIGHT);
    let [x0, z0] = link.read_all(["x", "y"]);
    let spatial = [
        ("m", 1.3),
        ("j1", 0.17),
        ("j2", 0.17),
        ("j3", 0.17),
        ("gravity", 9.7),
        ("start_x", -0.45),
        ("end_x", 0.45),
        ("x0", x0),
        ("z0", z0),
        ("ry0", -1.1),
    ];
    let mut body = Body::new("spatial-body", &spatial, TIGHT);
    for (planar, spatial, value) in [
        ("start_fx", "start_fx", 3.1),
        ("start_fy", "start_fz", -1.7),
        ("end_fy", "end_fz", 2.3),
        ("end_moment", "end_moment_y", 0.9),
    ] {
        let sign = if spatial == "end_moment_y" { -1.0 } else { 1.0 };
        link.drive(planar, value);
        body.drive(spatial, sign * value);
    }
    for _ in 0..10 {
        link.advance(0.11);
        body.advance(0.11);
        let in_plane = link.read_all(["end_x", "end_y", "end_vx", "end_vy", "end_ax", "end_ay"]);
        let in_space = body.read_all(["end_x", "end_z", "end_vx", "end_vz", "end_ax", "end_az"]);
        assert!(
            difference(&in_plane, &in_space) < 1e-8,
            "{in_plane:?} {in_space:?}"
        );
        let [rate, alpha] = link.read_all(["end_rate", "end_alpha"]);
        let turning = body.read_all(["end_omega_y", "end_alpha_y"]);
        assert!(difference(&turning, &[-rate, -alpha]) < 1e-8);
    }
}

/// Bringing the quaternion back to unit length at the macro points does not lower the order.
#[test]
fn rk4_is_of_order_four() {
    let end = |solver: Solver| {
        let mut body = Body::of(BODY, solver);
        body.drive_all(7.0);
        advance(&mut body, 0.64, 4);
        vector(&mut body, ["end_x", "end_y", "end_z"])
    };
    let exact = end(TIGHT);
    let errors = [&[("step", 8e-3)], &[("step", 4e-3)], &[("step", 2e-3)]]
        .map(|options| (end(Solver("rk4", options)) - exact).norm());
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 4.0).abs() < 0.2, "{errors:?}: order {order}");
    }
}
