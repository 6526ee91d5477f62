//! Two tumbling bodies held by an atpoint joint in space: what an ideal joint must not change.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_tests::convergence::slope_of;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;

/// Unequal inertias, tilted axes, off-centre markers, no gravity; the joint is closed at the start in position and
/// velocity: body a turns about its own centre, body b starts with the velocity of the joint.
const SCENE: &str = r#"
[scene]
name = "pair"
t_end = 0.5

[coupling]
method = "weighted"
macro_step = 1e-3

[[subsystem]]
name = "a"
model = "spatial-body"
parameters = { m = 1.3, j1 = 0.11, j2 = 0.23, j3 = 0.19, gravity = 0.0, end_x = 0.4, end_y = -0.1, end_z = 0.2, rx0 = 0.0, ry0 = 0.0, rz0 = 0.0, omega1_0 = 2.0, omega2_0 = -3.0, omega3_0 = 5.0 }
solver = { kind = "radau5", rtol = 1e-12, atol = 1e-12 }

[[subsystem]]
name = "b"
model = "spatial-body"
# omega x r of the end of a: (-3*0.2 - 5*(-0.1), 5*0.4 - 2*0.2, 2*(-0.1) + 3*0.4) = (-0.1, 1.6, 1.0)
parameters = { m = 0.7, j1 = 0.05, j2 = 0.09, j3 = 0.13, gravity = 0.0, x0 = 0.4, y0 = -0.1, z0 = 0.2, rx0 = 0.5, ry0 = -0.8, rz0 = 1.1, vx0 = -0.1, vy0 = 1.6, vz0 = 1.0, start_x = 0.0, start_y = 0.0, start_z = 0.0, omega1_0 = 4.0, omega2_0 = 1.0, omega3_0 = -2.0 }
solver = { kind = "radau5", rtol = 1e-12, atol = 1e-12 }

[[joint]]
name = "ball"
kind = "atpoint"
a = "a.end"
b = "b.start"

[output]
variables = ["a.energy", "b.energy", "a.vx", "a.vy", "a.vz", "b.vx", "b.vy", "b.vz"]
"#;

fn trajectory(coupling: &str, h: f64) -> Trajectory {
    run(
        &with_settings(SCENE, &format!("{coupling} macro_step={h}"), &[]),
        Place::InProcess,
    )
}

fn momentum(trajectory: &Trajectory, axis: &str) -> Vec<f64> {
    let of = |body: &str, m: f64| {
        trajectory
            .column(&format!("{body}.v{axis}"))
            .into_iter()
            .map(move |v| m * v)
    };
    of("a", 1.3).zip(of("b", 0.7)).map(|(a, b)| a + b).collect()
}

fn energy_error(trajectory: &Trajectory) -> f64 {
    let parts = ["a.energy", "b.energy"].map(|column| trajectory.column(column));
    let energy: Vec<f64> = parts[0].iter().zip(&parts[1]).map(|(a, b)| a + b).collect();
    energy
        .iter()
        .map(|now| (now - energy[0]).abs() / energy[0])
        .fold(0.0, f64::max)
}

#[test]
fn momentum_stays_whatever_the_macro_step() {
    for coupling in ["index=1 a=2 b=2.6 degree=1", "index=2 a=1 b=0 degree=0"] {
        let trajectory = trajectory(coupling, 5e-3);
        for axis in ["x", "y", "z"] {
            let momentum = momentum(&trajectory, axis);
            let drift = momentum
                .iter()
                .map(|now| (now - momentum[0]).abs())
                .fold(0.0, f64::max);
            // Action equals reaction in every instant, so only the solvers' errors are left.
            assert!(drift < 1e-10, "{coupling}, {axis}: {drift:e}");
        }
    }
}

/// The position gap lets the pair of forces do work; it vanishes with the order of the method.
#[test]
fn energy_stays_to_the_order_of_the_method() {
    let steps = [4e-3, 2e-3, 1e-3];
    for (coupling, least) in [
        ("index=1 a=1 b=1 degree=0", 2.0),
        ("index=1 a=2 b=2.6 degree=1", 3.0),
        ("index=1 a=2 b=2.6 degree=2", 4.0),
    ] {
        let errors = steps.map(|h| energy_error(&trajectory(coupling, h)));
        let order = slope_of(steps.into_iter().zip(errors));
        println!("{coupling}: {errors:?} order {order:.2}");
        assert!(order > least - 0.2, "{coupling}: {errors:?} order {order}");
    }
}

#[test]
fn the_joint_stays_closed() {
    let trajectory = trajectory("index=1 a=2 b=2.6 degree=2", 1e-3);
    for axis in ["x", "y", "z"] {
        let gap = trajectory.column(&format!("ball.residual.position.{axis}"));
        let largest = gap.iter().map(|gap| gap.abs()).fold(0.0, f64::max);
        assert!(largest < 1e-9, "{axis}: {largest:e}");
    }
}
