//! A block on an incline and a mass that slides in space, all schemes, against closed forms. Constant accelerations are
//! exact for all of them.

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::systems::body_on_planes::{Body, BodyOnPlanes, Plane, corners_of};
use linchpin_models::nonsmooth::systems::notch::CornerLaw;
use linchpin_models::nonsmooth::systems::point_mass::SlidingMass;
use linchpin_proto::polynomial::Polynomial;
use linchpin_worker::Inputs;

use super::stand::{SCHEMES, Stand, order};

const MASS: f64 = 1.37;
const GRAVITY: f64 = 9.79;
const HALF: [f64; 2] = [0.23, 0.11];
const ANGLE: f64 = 0.31;

/// A block that lies on a plane of `angle` and slides up it with `speed`; gaps are closed by less than rounding.
fn block(
    scheme: SchemeKind,
    [angle, friction, speed]: [f64; 3],
    settings: Settings,
    inputs: Inputs,
) -> Stand {
    let body = Body::rectangle(MASS, HALF, GRAVITY);
    let law = CornerLaw {
        normal_restitution: 0.0,
        tangential_restitution: 0.0,
        friction,
    };
    let plane = Plane::rising(angle);
    let system = BodyOnPlanes::on_plane(body, &corners_of(HALF), plane, law);
    let height = HALF[1] - 1e-14;
    let q = [plane.normal[0] * height, plane.normal[1] * height, angle];
    let v = plane.tangent().map(|t| t * speed);
    Stand::driven(system, scheme, settings, [&q, &[v[0], v[1], 0.0]], inputs)
}

/// Way up the incline.
fn way(stand: &Stand, angle: f64) -> f64 {
    stand.q()[0] * angle.cos() + stand.q()[1] * angle.sin()
}

#[test]
fn below_the_angle_of_friction_it_does_not_creep() {
    for case in SCHEMES {
        let friction = 1.02 * ANGLE.tan();
        let none = Inputs::constant(&[]);
        let mut stand = block(case.kind, [ANGLE, friction, 0.0], Settings::default(), none);
        stand.steps(1000, 1e-3);
        let way = way(&stand, ANGLE);
        assert!(way.abs() < 1e-13, "{case:?}: {way:e}");
        assert_eq!(stand.integrator.log.impacts, 0, "{case:?}");
    }
}

#[test]
fn above_the_angle_of_friction_it_slides() {
    let friction = 0.2;
    let expected = -0.5 * GRAVITY * (ANGLE.sin() - friction * ANGLE.cos());
    for case in SCHEMES {
        let none = Inputs::constant(&[]);
        let mut stand = block(case.kind, [ANGLE, friction, 0.0], Settings::default(), none);
        stand.steps(1000, 1e-3);
        let way = way(&stand, ANGLE);
        assert!((way - expected).abs() < 1e-10, "{case:?}: {way} {expected}");
        let log = stand.integrator.log;
        let normal = MASS * GRAVITY * ANGLE.cos();
        let loss = friction * normal * expected.abs();
        assert!((log.friction_loss - loss).abs() < 1e-9, "{case:?}");
        assert!(log.penetration < 1e-11, "{case:?}: {:e}", log.penetration);
    }
}

#[test]
fn friction_stops_it_in_finite_time_and_it_stays() {
    // Downwards with 0.9 m/s: deceleration d, end at t = 0.9 / d.
    let (friction, speed) = (0.53, -0.9);
    let deceleration = GRAVITY * (friction * ANGLE.cos() - ANGLE.sin());
    let (end, length) = (-speed / deceleration, speed * speed / (2.0 * deceleration));
    for case in SCHEMES {
        let run = |dt: f64| {
            let none = Inputs::constant(&[]);
            let start = [ANGLE, friction, speed];
            let mut stand = block(case.kind, start, Settings::default(), none);
            while stand.t() < end + 2.0 * dt {
                stand.step(dt);
            }
            let place = way(&stand, ANGLE);
            stand.steps(300, dt);
            let creep = way(&stand, ANGLE) - place;
            assert!(
                creep.abs() < 0.2 * deceleration * dt * dt,
                "{case:?}: {creep:e}"
            );
            let place = way(&stand, ANGLE);
            stand.steps(300, dt);
            let creep = way(&stand, ANGLE) - place;
            assert!(creep.abs() < 1e-12, "{case:?}: {creep:e}");
            (way(&stand, ANGLE) + length).abs()
        };
        for dt in [1.7e-3, 1.1e-4] {
            let error = run(dt);
            assert!(error <= deceleration * dt * dt, "{case:?}: {error:e}");
        }
    }
}

#[test]
fn a_force_that_grows_pulls_it_loose() {
    // On the level: F = c t; it slips at t = mu m g / c.
    let (friction, slope) = (0.43, 17.0);
    let slips = friction * MASS * GRAVITY / slope;
    let end = 0.5;
    let expected = slope * (end - slips).powi(3) / (6.0 * MASS);
    for case in SCHEMES {
        let error = |steps: usize| {
            let mut inputs = Inputs::constant(&[0.0]);
            inputs.replace(0, Polynomial::through(&[0.0, 1.0], &[0.0, slope]).unwrap());
            let start = [0.0, friction, 0.0];
            let mut stand = block(case.kind, start, Settings::default(), inputs);
            let dt = end / steps as f64;
            let sticking = (slips / dt) as usize;
            stand.steps(sticking, dt);
            assert!(stand.v()[0].abs() < 1e-12, "{case:?}: it slips too early");
            stand.steps(steps - sticking, dt);
            (stand.q()[0] - expected).abs()
        };
        // The instant within its step makes the error jump between 0 and its bound, which has order 2.
        for steps in [257, 700, 2056, 4112] {
            let dt = end / steps as f64;
            let share = error(steps) / (dt * dt);
            assert!(share < 3.5, "{case:?}: {share} dt^2");
        }
    }
}

/// On a plane in space that falls along x.
fn mass(scheme: SchemeKind, angle: f64, friction: f64, v: [f64; 2]) -> Stand {
    let gravity = [GRAVITY * angle.sin(), 0.0, -GRAVITY * angle.cos()];
    let system = SlidingMass::new(MASS, gravity, friction);
    let start: [&[f64]; 2] = [&[0.0, 0.0, -1e-14], &[v[0], v[1], 0.0]];
    Stand::new(system, scheme, Settings::default(), start)
}

#[test]
fn in_space_it_slows_down_on_a_straight_line() {
    let (friction, v) = (0.27, [0.83, -0.59]);
    let speed = f64::hypot(v[0], v[1]);
    let deceleration = friction * GRAVITY;
    let length = speed * speed / (2.0 * deceleration);
    for case in SCHEMES {
        let dt = 7e-4;
        let mut stand = mass(case.kind, 0.0, friction, v);
        while stand.t() < 0.5 * speed / deceleration {
            stand.step(dt);
        }
        let t = stand.t();
        let way = speed * t - 0.5 * deceleration * t * t;
        for (q, v) in stand.q().iter().zip(v) {
            let error = q - way * v / speed;
            assert!(error.abs() < 1e-11, "{case:?}: {error:e}");
        }
        let loss = stand.integrator.log.friction_loss;
        let expected = MASS * deceleration * way;
        assert!(
            (loss / expected - 1.0).abs() < 1e-9,
            "{case:?}: {loss} {expected}"
        );
        while stand.t() < 1.5 * speed / deceleration {
            stand.step(dt);
        }
        let across = stand.q()[0] * v[1] - stand.q()[1] * v[0];
        // Without damping the deceleration goes on to and fro, with forces of the very size of friction.
        let allowed = if case.is_undamped() { 1e-6 } else { 1e-9 };
        assert!(across.abs() < allowed, "{case:?}: {across:e}");
        let error = stand.q()[0].hypot(stand.q()[1]) - length;
        assert!(error.abs() < deceleration * dt * dt, "{case:?}: {error:e}");
        assert!(stand.v()[0].hypot(stand.v()[1]) < 1e-12, "{case:?}");
    }
}

#[test]
fn in_space_it_turns_downhill() {
    // With mu = tan(angle), |v| + v_x is constant: friction takes from |v| what gravity gives to v_x. HETS takes both
    // its friction forces along velocities at the end of the step, so that it has order 1 where their direction turns.
    for case in SCHEMES {
        let error = |dt: f64| {
            let mut stand = mass(case.kind, ANGLE, ANGLE.tan(), [0.11, 0.97]);
            let kept = |v: &[f64]| v[0].hypot(v[1]) + v[0];
            let before = kept(stand.v());
            stand.steps((0.8 / dt).round() as usize, dt);
            assert!(stand.v()[0] > 0.5, "{case:?}: it does not turn");
            (kept(stand.v()) - before).abs()
        };
        let [coarse, fine] = [4e-3, 2e-3].map(error);
        let seen = order(coarse, fine);
        // HETS takes both its friction forces along velocities at the end of the step.
        let expected = match case.kind {
            SchemeKind::Hets => 1.0,
            _ => case.order,
        };
        assert!(seen > expected - 0.2, "{case:?}: {coarse:e} {seen}");
    }
}

#[test]
fn in_space_below_the_angle_of_friction_it_does_not_creep() {
    for case in SCHEMES {
        let mut stand = mass(case.kind, ANGLE, 1.02 * ANGLE.tan(), [0.0, 0.0]);
        stand.steps(1000, 1e-3);
        let way = stand.q()[0].hypot(stand.q()[1]);
        assert!(way < 1e-13, "{case:?}: {way:e}");
    }
}
