//! The free planar link against closed forms.

#![allow(clippy::unwrap_used)]

mod common;

use common::body::{Body, TIGHT, difference};
use common::cases::{CASES, Case};

const LINK: Case = CASES[2];
const M: f64 = 1.3;
const INERTIA: f64 = 0.17;
const HALF: f64 = 0.45;
const GRAVITY: f64 = 9.7;

#[test]
fn it_starts_where_its_marker_is_told_to() {
    let mut body = Body::of(LINK, TIGHT);
    let names = [
        "start_x",
        "start_y",
        "start_angle",
        "start_vx",
        "start_vy",
        "start_rate",
    ];
    let start = body.read_all(names);
    assert!(difference(&start, &[0.3, -0.7, 1.1, 2.0, 0.9, -4.0]) < 1e-15);
    let names: Vec<_> = names.into_iter().map(str::to_owned).collect();
    let states: Vec<_> = body
        .model
        .states
        .into_iter()
        .map(|state| state.output)
        .collect();
    assert_eq!(states, names);
}

/// Equal forces at both ends and a moment: the centre moves on a parabola, the angle on another.
#[test]
fn constant_loads_give_parabolas() {
    let (fx, fy, moment) = (3.1, -1.7, 0.9);
    let mut body = Body::of(LINK, TIGHT);
    for marker in ["start", "end"] {
        body.drive(&format!("{marker}_fx"), fx);
        body.drive(&format!("{marker}_fy"), fy);
    }
    body.drive("end_moment", moment);
    let names = ["x", "y", "angle", "vx", "vy", "rate"];
    let start = body.read_all(names);
    let acceleration = [2.0 * fx / M, 2.0 * fy / M - GRAVITY, moment / INERTIA];
    for _ in 0..10 {
        body.advance(0.21);
        let t = body.t;
        let at = |i: usize| start[i] + start[i + 3] * t + 0.5 * acceleration[i] * t * t;
        let rate = |i: usize| start[i + 3] + acceleration[i] * t;
        let expected = [at(0), at(1), at(2), rate(0), rate(1), rate(2)];
        assert!(difference(&body.read_all(names), &expected) < 1e-11);
        let angle = at(2);
        let end = [at(0) + HALF * angle.cos(), at(1) + HALF * angle.sin()];
        assert!(difference(&body.read_all(["end_x", "end_y"]), &end) < 1e-11);
    }
}

#[test]
fn loads_change_momentum_and_angular_momentum_about_the_origin() {
    let momenta = |body: &mut Body| {
        let [x, y, vx, vy, rate] = body.read_all(["x", "y", "vx", "vy", "rate"]);
        let angular = M * (x * vy - y * vx) + INERTIA * rate;
        vec![M * vx, M * vy, angular]
    };
    let mut body = Body::of(LINK, TIGHT);
    body.drive_all(7.0);
    let changes = body.rates(1e-3, momenta).rates;

    let mut body = Body::of(LINK, TIGHT);
    body.drive_all(7.0);
    body.advance(2e-3);
    let mut expected = [0.0, -M * GRAVITY, -M * GRAVITY * body.read_one("x")];
    for marker in ["start", "end"] {
        let [x, y] = ["x", "y"].map(|axis| body.read_one(&format!("{marker}_{axis}")));
        let load = ["fx", "fy", "moment"].map(|part| body.input(&format!("{marker}_{part}")));
        expected[0] += load[0];
        expected[1] += load[1];
        expected[2] += load[2] + x * load[1] - y * load[0];
    }
    assert!(
        difference(&changes, &expected) < 1e-8,
        "{changes:?} {expected:?}"
    );
}
