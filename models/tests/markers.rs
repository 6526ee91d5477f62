//! What holds for the markers of every model: names, kinematics, power.

#![allow(clippy::unwrap_used)]

mod common;

use common::body::{Body, TIGHT, difference};
use common::cases::{CASES, Case};
use linchpin_proto::v1::{Marker, MarkerKind};

/// Time between two points of a difference: its error of fourth order is below what is asserted.
const STEP: f64 = 5e-4;

/// The models that a solver integrates as accurately as is checked. Those with impacts have a test of their own, in
/// nonsmooth/markers.rs.
fn smooth() -> impl Iterator<Item = Case> {
    CASES.into_iter().filter(|case| {
        let solvers = case.description().solvers;
        solvers.iter().any(|solver| solver.name == TIGHT.0)
    })
}

/// Every model, some time after its start, under constant loads.
fn moving(case: Case) -> Body {
    let mut body = Body::of(case, TIGHT);
    body.drive_all(case.load);
    body.advance(0.37);
    body
}

/// Velocity that a change of the position stands for: an angular velocity is `2 q' q*`.
fn velocity_of(marker: &Marker, position: &[f64], rate: &[f64]) -> Vec<f64> {
    if marker.kind() != MarkerKind::Spatial {
        return rate.to_vec();
    }
    let (q, q_rate) = (&position[3..], &rate[3..]);
    let cross = |i: usize, j: usize| q_rate[i] * q[j] - q_rate[j] * q[i];
    let omega = [(1, 2, 3), (2, 3, 1), (3, 1, 2)]
        .map(|(i, j, k)| 2.0 * (q_rate[i] * q[0] - q_rate[0] * q[i] - cross(j, k)));
    [&rate[..3], &omega].concat()
}

#[test]
fn velocities_and_accelerations_are_rates_of_change() {
    for case in smooth() {
        for marker in moving(case).model.markers {
            let positions = moving(case).rates(STEP, |body| body.read(&marker.position));
            let velocities = moving(case).rates(STEP, |body| body.read(&marker.velocity));
            let accelerations = moving(case).rates(STEP, |body| body.read(&marker.acceleration));
            let velocity = velocity_of(&marker, &positions.values, &positions.rates);
            let size = |values: &[f64]| 1.0 + values.iter().fold(0.0f64, |a, b| a.max(b.abs()));
            let error = difference(&velocity, &velocities.values) / size(&velocity);
            assert!(error < 1e-8, "{case:?} {}: {error:e}", marker.name);
            let expected = &accelerations.values;
            let error = difference(&velocities.rates, expected) / size(expected);
            assert!(error < 1e-8, "{case:?} {}: {error:e}", marker.name);
        }
    }
}

/// Without damping the energy changes by the power of the loads only.
#[test]
fn the_power_of_the_loads_is_the_rate_of_the_energy() {
    let mut checked = 0;
    for case in smooth() {
        let mut body = moving(case);
        if !body.model.outputs.iter().any(|own| own.name == "energy") {
            continue;
        }
        let energy = body.rates(STEP, |body| vec![body.read_one("energy")]);
        let mut body = moving(case);
        body.advance(2.0 * STEP);
        let mut power = 0.0;
        for marker in body.model.markers.clone() {
            let velocities = body.read(&marker.velocity);
            let loads = marker.load.iter().map(|name| body.input(name));
            power += loads.zip(velocities).map(|(f, v)| f * v).sum::<f64>();
        }
        let error = (energy.rates[0] / power - 1.0).abs();
        assert!(error < 1e-7, "{case:?}: {error:e} of {power}");
        checked += 1;
    }
    assert_eq!(checked, 9);
}

/// An orientation is told by a unit quaternion at every macro point, however coarse the solver.
#[test]
fn orientations_are_unit_quaternions() {
    let coarse = common::Solver("rk4", &[("step", 0.1)]);
    let mut body = Body::of(CASES[3], coarse);
    for _ in 0..50 {
        body.advance(0.1);
        let q = body.read_all(["end_qw", "end_qx", "end_qy", "end_qz"]);
        let length: f64 = q.iter().map(|part| part * part).sum();
        assert!((length - 1.0).abs() < 1e-15, "{length}");
    }
}
