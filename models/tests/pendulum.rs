//! The pendulum against closed forms.

#![allow(clippy::unwrap_used)]

mod common;

use common::body::{Body, TIGHT};
use common::{Solver, agm};
use linchpin_models::oscillator::OscillatorParameters;
use linchpin_models::reference::FreeOscillation;
use std::f64::consts::{FRAC_PI_2, TAU};

const LINK: [(&str, f64); 4] = [
    ("m", 1.3),
    ("inertia", 0.17),
    ("length", 0.9),
    ("offset", 0.11),
];
const ARM: f64 = 0.45 + 0.11;
const INERTIA: f64 = 0.17 + 1.3 * ARM * ARM;

fn pendulum(more: &[(&str, f64)], solver: Solver) -> Body {
    Body::new("pendulum", &[&LINK, more].concat(), solver)
}

/// The period of a swing of amplitude `A` is `2 pi sqrt(J / m g s) / agm(1, cos(A / 2))`.
#[test]
fn a_large_swing_has_the_period_of_the_elliptic_integral() {
    let amplitude: f64 = 2.83;
    let small = TAU * (INERTIA / (1.3 * 9.81 * ARM)).sqrt();
    let period = small / agm(1.0, (0.5 * amplitude).cos());
    assert!(period > 1.9 * small);
    let mut body = pendulum(&[("angle0", amplitude - FRAC_PI_2)], TIGHT);
    for side in [-1.0, 1.0, -1.0] {
        for _ in 0..7 {
            body.advance(0.5 * period / 7.0);
        }
        let [angle, rate] = body.read_all(["angle", "rate"]);
        let expected = side * amplitude - FRAC_PI_2;
        assert!((angle - expected).abs() < 1e-9, "{angle} {expected}");
        assert!(rate.abs() < 1e-9, "{rate}");
    }
}

#[test]
fn without_gravity_it_is_a_damped_oscillator() {
    let own = OscillatorParameters {
        m: INERTIA,
        c: 21.0,
        d: 0.83,
        x0: 1.1 - 0.3,
        v0: -4.0,
    };
    let mut body = pendulum(
        &[
            ("gravity", 0.0),
            ("spring", own.c),
            ("damping", own.d),
            ("rest_angle", 0.3),
            ("angle0", 1.1),
            ("rate0", own.v0),
        ],
        TIGHT,
    );
    let closed = FreeOscillation::new(&own);
    for _ in 0..20 {
        body.advance(0.053);
        let motion = closed.motion(body.t);
        let [angle, rate, alpha] = body.read_all(["tip_angle", "rate", "tip_alpha"]);
        assert!((angle - 0.3 - motion.x).abs() < 1e-10);
        assert!((rate - motion.v).abs() < 1e-9);
        assert!((alpha - motion.a).abs() < 1e-8);
    }
}

#[test]
fn it_keeps_its_energy_to_the_tolerance() {
    let energy_error = |solver: Solver| {
        let swing = [("spring", 2.1), ("angle0", 1.1), ("rate0", 7.0)];
        let mut body = pendulum(&swing, solver);
        let start = body.read_one("energy");
        (0..200).for_each(|_| body.advance(0.05));
        (body.read_one("energy") - start).abs()
    };
    let (normal, tight) = (energy_error(Solver("radau5", &[])), energy_error(TIGHT));
    println!("energy error {normal:e}, tight {tight:e}");
    assert!(normal < 1e-5 && tight < 1e-8, "{normal:e} {tight:e}");
}

/// At rest the moments of weight, spring and load about the hinge are in balance.
#[test]
fn the_load_acts_at_the_tip() {
    let (angle, fx, fy) = (0.7f64, 3.1, -1.7);
    let mut body = pendulum(
        &[("angle0", angle), ("spring", 21.0), ("hinge_x", 5.0)],
        TIGHT,
    );
    let weight = -1.3 * 9.81 * ARM * angle.cos();
    let force = 0.9 * (angle.cos() * fy - angle.sin() * fx);
    body.drive("tip_fx", fx);
    body.drive("tip_fy", fy);
    body.drive("tip_moment", -(weight + force - 21.0 * angle));
    assert!(body.read_one("tip_alpha").abs() < 1e-14);
    body.advance(0.3);
    assert!((body.read_one("angle") - angle).abs() < 1e-13);
    assert!((body.read_one("tip_x") - 5.0 - 0.9 * angle.cos()).abs() < 1e-13);
}

#[test]
fn rk4_is_of_order_four() {
    let end = |solver: Solver| {
        let mut body = pendulum(&[("angle0", 1.1), ("spring", 21.0)], solver);
        body.advance(0.8);
        body.read_one("angle")
    };
    let exact = end(TIGHT);
    let errors = [&[("step", 0.02)], &[("step", 0.01)], &[("step", 0.005)]]
        .map(|options| (end(Solver("rk4", options)) - exact).abs());
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 4.0).abs() < 0.15, "{errors:?}: order {order}");
    }
}
