//! The top in a gimbal against closed forms of the heavy symmetric top.

#![allow(clippy::unwrap_used)]

mod common;

use std::f64::consts::PI;

use common::agm;
use common::spatial::{assert_chain_is_limit_of_rk4, assert_newton_euler, drift_of_energy};
use linchpin_models::reference::{Gimbal, RigidBody, SpatialChainMotion};
use nalgebra::Vector3;

const NO_RING: RigidBody = RigidBody {
    m: 0.0,
    moments: Vector3::new(0.0, 0.0, 0.0),
};
const TOP: RigidBody = RigidBody {
    m: 1.3,
    moments: Vector3::new(0.021, 0.021, 0.034),
};
/// A heavy symmetric top.
const BARE: Gimbal = Gimbal {
    outer: NO_RING,
    inner: NO_RING,
    top: TOP,
    distance: 0.17,
    gravity: 9.7,
    angles: [0.3, 0.8, -0.4],
    rates: [1.9, 0.0, 45.0],
};
/// Rings and a top with three different moments of inertia each.
const HEAVY: Gimbal = Gimbal {
    outer: RigidBody {
        m: 0.7,
        moments: Vector3::new(0.013, 0.017, 0.029),
    },
    inner: RigidBody {
        m: 0.4,
        moments: Vector3::new(0.011, 0.008, 0.016),
    },
    top: RigidBody {
        m: 1.3,
        moments: Vector3::new(0.021, 0.027, 0.034),
    },
    rates: [1.9, -0.6, 45.0],
    ..BARE
};

fn motions(gimbal: &Gimbal) -> Vec<SpatialChainMotion> {
    let times: Vec<_> = (0..=20).map(|i| 0.1 * f64::from(i)).collect();
    gimbal.chain().motions(&times).unwrap()
}

/// Moment of inertia of the bare top across its axis about the fixed point.
fn across() -> f64 {
    TOP.moments.x + TOP.m * BARE.distance * BARE.distance
}

/// Spin about the own axis and vertical angular momentum of the bare top.
fn momenta(coordinates: &[f64], rates: &[f64]) -> [f64; 2] {
    let (sin, cos) = coordinates[1].sin_cos();
    let spin = TOP.moments.z * (rates[2] + rates[0] * cos);
    [spin, across() * rates[0] * sin * sin + spin * cos]
}

#[test]
fn a_bare_top_keeps_its_spin_its_vertical_angular_momentum_and_its_energy() {
    let motions = motions(&BARE);
    let start = momenta(&BARE.angles, &BARE.rates);
    for motion in &motions {
        let now = momenta(&motion.coordinates, &motion.rates);
        for (now, start) in now.iter().zip(start) {
            assert!((now - start).abs() < 1e-11, "{now} {start} at {}", motion.t);
        }
    }
    let drift = drift_of_energy(&motions);
    assert!(drift < 1e-9, "{drift:e}");
}

/// With `u = cos theta`, `p` and `s` the vertical angular momentum and the spin over `I`, `b = 2 m g l / I`,
/// `a = 2 E / I` without the energy of the spin:
/// `u'^2 = (1 - u^2) (a - b u) - (p - s u)^2` with the roots `u1 < u2 < u3`. It nods between the first two with the
/// period `4 K(k) / sqrt(b (u3 - u1))`, `k^2 = (u2 - u1) / (u3 - u1)` (Goldstein, Sect. 5.7).
#[test]
fn a_bare_top_nods_with_its_elliptic_period() {
    let [spin, vertical] = momenta(&BARE.angles, &BARE.rates);
    let (s, p) = (spin / across(), vertical / across());
    let b = 2.0 * TOP.m * BARE.gravity * BARE.distance / across();
    let (sin, start) = BARE.angles[1].sin_cos();
    let a = (BARE.rates[0] * sin).powi(2) + b * start;
    // The start is a root; the others are those of b u^2 + c1 u + c0.
    let c1 = b * start - a - s * s;
    let c0 = c1 * start + 2.0 * p * s - b;
    let large = 0.5 * (-c1 + (c1 * c1 - 4.0 * b * c0).sqrt()) / b;
    let turn = c0 / (b * large);
    let (u1, u2) = (turn.min(start), turn.max(start));
    let elliptic = PI / (2.0 * agm(1.0, ((large - u2) / (large - u1)).sqrt()));
    let period = 4.0 * elliptic / (b * (large - u1)).sqrt();
    let times = [0.5 * period, period, 7.5 * period];
    let expected = [turn, start, turn];
    for (motion, u) in BARE.chain().motions(&times).unwrap().iter().zip(expected) {
        assert!(
            (motion.coordinates[1].cos() - u).abs() < 1e-10,
            "{motion:?} {u}"
        );
        assert!(motion.rates[1].abs() < 1e-8, "{motion:?}");
    }
    assert!(u2 - u1 > 1e-2);
}

/// Steady precession `W` at the inclination `theta`: for the inner ring's moments `(A, B, D)` and the spin `S`,
/// `(I + B - D) cos theta W^2 - S W + m g l = 0`.
#[test]
fn a_top_with_its_steady_rate_does_not_nod() {
    let inner = RigidBody {
        m: 0.4,
        moments: Vector3::new(0.011, 0.008, 0.016),
    };
    for inner in [NO_RING, inner] {
        let outer = HEAVY.outer;
        let theta = BARE.angles[1];
        let rate = 2.7;
        let inertia = across() + inner.moments.y - inner.moments.z;
        let weight = TOP.m * BARE.gravity * BARE.distance;
        let spin = inertia * theta.cos() * rate + weight / rate;
        let own = spin / TOP.moments.z - rate * theta.cos();
        let steady = Gimbal {
            outer,
            inner,
            rates: [rate, 0.0, own],
            ..BARE
        };
        for motion in motions(&steady) {
            let angles = [0, 1, 2].map(|i| motion.coordinates[i]);
            let [psi, nod, phi] = angles;
            assert!((nod - theta).abs() < 1e-9, "{angles:?} at {}", motion.t);
            assert!((psi - 0.3 - rate * motion.t).abs() < 1e-9, "{angles:?}");
            assert!((phi + 0.4 - own * motion.t).abs() < 1e-9, "{angles:?}");
        }
    }
}

/// Whatever the moments of inertia, weight and ground put no moment about the vertical.
#[test]
fn a_gimbal_keeps_its_vertical_angular_momentum_and_its_energy() {
    let chain = HEAVY.chain();
    let vertical = |motion: &SpatialChainMotion| -> f64 {
        let bodies = chain.bodies.iter().zip(&motion.bodies);
        bodies
            .map(|(own, motion)| own.body.angular_momentum(motion, &Vector3::zeros()).z)
            .sum()
    };
    let motions = motions(&HEAVY);
    for motion in &motions {
        let change = vertical(motion) - vertical(&motions[0]);
        assert!(change.abs() < 1e-11, "{change:e} at {}", motion.t);
        assert!(motion.reactions[0].moment.z.abs() < 1e-10, "{motion:?}");
    }
    let drift = drift_of_energy(&motions);
    println!("drift {drift:e}");
    assert!(drift < 1e-9, "{drift:e}");
    let nods = motions.iter().map(|motion| motion.coordinates[1]);
    assert!(nods.fold(0.0, f64::max) > HEAVY.angles[1] + 1e-2);
}

#[test]
fn the_bodies_obey_newton_s_and_euler_s_laws() {
    assert_newton_euler(&HEAVY.chain(), 0.3);
}

#[test]
fn another_integrator_tends_to_it() {
    assert_chain_is_limit_of_rk4(&HEAVY.chain(), 0.3);
}
