//! A rocking block, all schemes, against Housner 1963: a block that stands on a corner falls back, and its other corner
//! hits the floor.

use std::f64::consts::PI;

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::systems::body_on_planes::{Body, BodyOnPlanes, Plane, corners_of};
use linchpin_models::nonsmooth::systems::notch::CornerLaw;

use super::stand::{SCHEMES, Stand};

const GRAVITY: f64 = 9.79;
const SLENDER: [f64; 2] = [0.043, 0.31];
/// It loses so much at every impact that it comes to rest soon.
const STOCKY: [f64; 2] = [0.17, 0.21];
const TILT: f64 = 0.037;

/// On its left lower corner, turned by `quarters` of a turn as well, so that other corners are the lower ones.
fn block(scheme: SchemeKind, [b, h]: [f64; 2], restitution: f64, quarters: u8) -> Stand {
    let half = if quarters.is_multiple_of(2) {
        [b, h]
    } else {
        [h, b]
    };
    let body = Body::rectangle(2.3, half, GRAVITY);
    let law = CornerLaw {
        normal_restitution: restitution,
        tangential_restitution: 0.0,
        friction: 0.7,
    };
    let corners = corners_of(half);
    let system = BodyOnPlanes::on_plane(body, &corners, Plane::rising(0.0), law);
    let (sin, cos) = TILT.sin_cos();
    let centre = [b * cos - h * sin, b * sin + h * cos - 1e-12];
    let angle = TILT + 0.5 * PI * f64::from(quarters);
    let q = [centre[0], centre[1], angle];
    Stand::new(system, scheme, Settings::default(), [&q, &[0.0; 3]])
}

/// Distance of the corners from the centre, their angle, and the rate `p` of Housner, `p^2 = 3 g / (4 R)`.
fn geometry() -> [f64; 3] {
    let distance = SLENDER[0].hypot(SLENDER[1]);
    let angle = SLENDER[0].atan2(SLENDER[1]);
    [distance, angle, (0.75 * GRAVITY / distance).sqrt()]
}

/// Time until the block is upright: exact, by quadrature of `theta'^2 = 2 p^2 [cos(alpha - theta_0) - cos(alpha -
/// theta)]`.
fn quarter_period() -> f64 {
    let [_, alpha, p] = geometry();
    let points = 4000;
    let h = 1.0 / f64::from(points);
    let slice = |k: i32| {
        // theta = theta_0 (1 - s^2) removes the singularity of the start.
        let s = (f64::from(k) + 0.5) * h;
        let theta = TILT * (1.0 - s * s);
        let fall = (alpha - TILT).cos() - (alpha - theta).cos();
        2.0 * TILT * s / (p * (2.0 * fall).sqrt())
    };
    h * (0..points).map(slice).sum::<f64>()
}

/// Steps until the right lower corner is closed; the angular velocities before and behind.
fn fall(stand: &mut Stand, dt: f64) -> [f64; 2] {
    loop {
        let before = stand.v()[2];
        stand.step(dt);
        // Moreau's rule corrects velocities before the gap is closed.
        let is_over = stand.integrator.gaps()[1] <= 0.0 || stand.v()[2] > 0.99 * before;
        if is_over && stand.t() > 0.1 {
            return [before, stand.v()[2]];
        }
    }
}

#[test]
fn it_falls_in_the_time_of_housner() {
    let [_, alpha, p] = geometry();
    let exact = quarter_period();
    // Small angles: theta = alpha - (alpha - theta_0) cosh(p t).
    let housner = (1.0 / (1.0 - TILT / alpha)).acosh() / p;
    assert!((housner / exact - 1.0).abs() < 0.01, "{housner} {exact}");
    for case in SCHEMES {
        for dt in [1e-3, 1e-4] {
            let mut stand = block(case.kind, SLENDER, 0.0, 0);
            fall(&mut stand, dt);
            let error = stand.t() - exact;
            assert!(error.abs() < 1.1 * dt, "{case:?}: {error:e}");
        }
    }
}

#[test]
fn the_other_corner_takes_speed_as_newton_has_it() {
    let [distance, alpha, _] = geometry();
    for restitution in [0.0, 0.17] {
        // Angular momentum about the corner that hits is kept; that corner sticks and leaves with restitution.
        let inertia = distance * distance / 3.0;
        let [b, h] = SLENDER;
        let kept = inertia + h * h - b * b * (1.0 + 2.0 * restitution);
        let ratio = kept / (inertia + distance * distance);
        if restitution == 0.0 {
            let housner = 1.0 - 1.5 * alpha.sin().powi(2);
            assert!((ratio - housner).abs() < 1e-14);
        }
        for case in SCHEMES {
            let dt = 2e-5;
            let mut stand = block(case.kind, SLENDER, restitution, 0);
            let [before, behind] = fall(&mut stand, dt);
            let seen = behind / before;
            assert!((seen - ratio).abs() < 2e-3, "{case:?}: {seen} {ratio}");
        }
    }
}

#[test]
fn all_corners_are_alike() {
    for case in SCHEMES {
        let run = |quarters: u8| {
            let mut stand = block(case.kind, SLENDER, 0.1, quarters);
            stand.steps(1500, 2e-4);
            let turned = stand.q()[2] - 0.5 * PI * f64::from(quarters);
            [stand.q()[0], stand.q()[1], turned]
        };
        let first = run(0);
        for quarters in 1..4 {
            let other = run(quarters);
            for (a, b) in first.iter().zip(other) {
                assert!((a - b).abs() < 1e-9, "{case:?} {quarters}: {a} {b}");
            }
        }
    }
}

#[test]
fn it_comes_to_rest_on_both_corners() {
    for case in SCHEMES {
        let mut stand = block(case.kind, STOCKY, 0.0, 0);
        let mut energy = stand.integrator.energy();
        let mut rise: f64 = 0.0;
        for _ in 0..4000 {
            stand.step(1e-4);
            let now = stand.integrator.energy();
            rise = rise.max(now - energy);
            energy = now.min(energy);
        }
        // Between impacts that are shorter than a step it can climb out of its penetration.
        assert!(rise < 1e-5, "{case:?}: energy from nowhere, {rise:e}");
        let turn = stand.q()[2];
        assert!(turn.abs() < 1e-4, "{case:?}: {turn:e}");
        assert!(stand.v().iter().all(|v| v.abs() < 1e-10), "{case:?}");
        let forces = &stand.integrator.state.forces;
        let excess = (forces[0] + forces[2]) / (2.3 * GRAVITY) - 1.0;
        let is_rest = case.is_undamped() || excess.abs() < 1e-6;
        assert!(is_rest, "{case:?}: {excess:e}");
    }
}
