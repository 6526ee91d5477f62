//! A block on an incline that slides or sticks, and a rocking block.

use linchpin_models::nonsmooth::systems::body_on_planes::{Body, BodyOnPlanes, Plane, corners_of};
use linchpin_models::nonsmooth::systems::notch::CornerLaw;

use crate::compare::{Expected, assert_agreement, largest_difference};
use crate::other::{self, Problem};
use crate::own::{self, Own};

const GRAVITY: f64 = 9.81;

/// A block on a plane that falls along x by `slope`, without restitution.
fn block(mass: f64, half: [f64; 2], slope: f64, friction: f64) -> BodyOnPlanes {
    let law = CornerLaw {
        normal_restitution: 0.0,
        tangential_restitution: 0.0,
        friction,
    };
    let body = Body::rectangle(mass, half, GRAVITY);
    let [left, right, ..] = corners_of(half);
    BodyOnPlanes::on_plane(body, &[left, right], Plane::rising(-slope), law)
}

const SLOPE: f64 = 0.4;
const HALF: [f64; 2] = [0.11, 0.07];
const MASS: f64 = 2.3;
const SPEED: f64 = 0.57;

fn on_slope(friction: f64, problem: Problem<'_>) -> Own {
    let plane = Plane::rising(-SLOPE);
    let (t, n) = (plane.tangent(), plane.normal);
    // Closed by more than rounding.
    let height = HALF[1] - 1e-14;
    let q = [n[0] * height, n[1] * height, -SLOPE];
    let v = [t[0] * SPEED, t[1] * SPEED, 0.0];
    let system = block(MASS, HALF, SLOPE, friction);
    let mut own = own::run(system, [&q, &v], 1e-4, problem.t_end, problem.samples);
    // As Siconos has them: along the slope, normal to it, against it.
    for q in &mut own.samples {
        let along = |axis: [f64; 2]| q[0] * axis[0] + q[1] * axis[1];
        *q = vec![along(t), along(n), q[2] + SLOPE];
    }
    own
}

fn incline<'a>(settings: &'a [(&'a str, f64)]) -> Problem<'a> {
    Problem {
        name: "incline",
        settings,
        t_end: 0.8,
        samples: 40,
    }
}

/// Constant accelerations are exact for both schemes.
#[test]
fn a_block_that_slides_down_an_incline() {
    let friction = 0.3;
    let settings = [("slope", SLOPE), ("mu", friction), ("v0", SPEED)];
    let problem = incline(&settings);
    let own = on_slope(friction, problem);
    let Some(other) = other::run(problem, 1e-4) else {
        return;
    };
    assert_eq!((other.impacts, own.impacts), (0, 0));
    let difference = largest_difference(&other.samples, &own.samples);
    let forces = largest_difference(&other.forces, &own.forces);
    println!(
        "{difference:e} m, {forces:e} N, losses {} {}",
        other.loss, own.loss
    );
    assert!(difference < 1e-9, "{difference:e} m");
    assert!(forces < 1e-6, "{forces:e} N");
    assert!((other.loss - own.loss).abs() < 1e-9 * own.loss);
}

/// It stops within a step, and while normal forces change corners sink by as little: differences are of second order.
#[test]
fn a_block_that_stops_on_an_incline_and_sticks() {
    let friction = 0.6;
    let settings = [("slope", SLOPE), ("mu", friction), ("v0", SPEED)];
    let problem = incline(&settings);
    let own = on_slope(friction, problem);
    let deceleration = GRAVITY * (friction * SLOPE.cos() - SLOPE.sin());
    let stop = SPEED / deceleration;
    assert!(stop < 0.5 * problem.t_end);
    let dt = 1e-4;
    let Some(other) = other::run(problem, dt) else {
        return;
    };
    assert_eq!((other.impacts, own.impacts), (0, 0));
    let difference = largest_difference(&other.samples, &own.samples);
    println!("{difference:e} m, losses {} {}", other.loss, own.loss);
    let allowed = 10.0 * deceleration * dt * dt;
    assert!(difference < allowed, "{difference:e} m");
    let (theirs, ours) = (&other.samples[39], &other.samples[20]);
    assert!((theirs[0] - ours[0]).abs() < 1e-9, "it creeps");
    // How corners that stick share the friction is not determined; its sum holds the weight.
    for forces in [&other.forces[39], &own.forces[39]] {
        let [n1, t1, n2, t2] = forces[..] else {
            panic!("two corners")
        };
        let weight = MASS * GRAVITY;
        assert!((n1 + n2 - weight * SLOPE.cos()).abs() < 1e-6, "{forces:?}");
        assert!((t1 + t2 + weight * SLOPE.sin()).abs() < 1e-6, "{forces:?}");
        let moment = HALF[0] * (n2 - n1) + HALF[1] * (t1 + t2);
        assert!(moment.abs() < 1e-6, "{forces:?}");
    }
    assert!((other.loss - own.loss).abs() < 1e-5 * own.loss);
}

/// Released on a corner it rocks: impacts and rest of the energy agree.
#[test]
fn a_rocking_block() {
    let ([b, h], mass, friction, tilt) = ([0.09, 0.31], 1.7, 1.4, 0.12_f64);
    let problem = Problem {
        name: "rocking",
        settings: &[
            ("b", b),
            ("h", h),
            ("m", mass),
            ("mu", friction),
            ("phi0", tilt),
        ],
        t_end: 1.2,
        samples: 60,
    };
    let (sin, cos) = tilt.sin_cos();
    let q = [-b + b * cos - h * sin, b * sin + h * cos - 1e-14, tilt];
    let own_dt = 1e-5;
    let system = block(mass, [b, h], 0.0, friction);
    let own = own::run(
        system,
        [&q, &[0.0; 3]],
        own_dt,
        problem.t_end,
        problem.samples,
    );
    let expected = Expected {
        steps: [4e-4, 5e-5],
        constant: 5.0,
        ratio: [4.0, 16.0],
        loss: None,
    };
    assert_agreement(problem, &own, own_dt, expected);
}
