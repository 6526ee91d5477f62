//! Motions under a constant multiplier that have closed forms while the partner turns.

use std::f64::consts::PI;

use linchpin_proto::joint_load::{End, JointLaw, Law};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::bodies::{Body, LINK, PENDULUM, SOLVERS, SPATIAL};
use crate::common::body::difference;
use crate::common::{Solver, agm};
use crate::joint::{Joint, Partner, Space};
use crate::run::Run;

/// Angle (rad) of the partner at the start.
const ANGLE: f64 = 0.3;
/// Its rate (rad/s).
const RATE: f64 = 1.7;
/// Reference orientation of the partner in space.
const REFERENCE: [f64; 4] = [0.3, 0.5, -0.2, 0.7];
/// Multiplier of forces (N).
const FORCE: f64 = 5.3;
/// Multiplier of moments (N m).
const MOMENT: f64 = 25.0;
const MASS: f64 = 1.3;

fn turning(space: Space) -> Partner {
    let turn: fn(f64) -> Vector3<f64> = match space {
        Space::Planar => |t| Vector3::new(0.0, 0.0, ANGLE + RATE * t),
        Space::Spatial => |t| RATE * t * axis(),
    };
    Partner {
        space,
        position: |_| Vector3::zeros(),
        turn,
        reference: REFERENCE,
    }
}

fn axis() -> Vector3<f64> {
    Vector3::new(0.4, -0.7, 1.1).normalize()
}

/// The end of a plane's normal force: the own marker lies in the plane of the partner.
fn in_plane(marker: &'static str, normal: Vector3<f64>) -> Joint {
    let law = JointLaw {
        law: Law::InPlane { normal },
        points: [Vector3::zeros(), Vector3::new(0.4, 0.2, 0.0)],
    };
    Joint {
        marker,
        law,
        end: End::A,
    }
}

/// `integral from 0 to t of (t - s) cos(RATE s) ds`, and with the sine.
fn twice_integrated(t: f64) -> (f64, f64) {
    let angle = RATE * t;
    let scale = RATE * RATE;
    ((1.0 - angle.cos()) / scale, (angle - angle.sin()) / scale)
}

/// The centre of mass falls freely, and the force on it has a constant component along the axis of the turn and a
/// turning one.
fn centre(fall: &[f64; 6], normal: &Vector3<f64>, axis: &Vector3<f64>, t: f64) -> Vector3<f64> {
    let [x, y, z, vx, vy, vz] = *fall;
    let along = axis * axis.dot(normal);
    let (cosine, sine) = twice_integrated(t);
    let turned = 0.5 * t * t * along + cosine * (normal - along) + sine * axis.cross(normal);
    Vector3::new(x, y, z) + t * Vector3::new(vx, vy, vz) + FORCE / MASS * turned
}

/// The body from which the joint does not take its weight: without gravity.
fn error_of_centre(body: Body, joint: Joint, solver: Solver) -> f64 {
    let partner = turning(body.space);
    let mut run = Run::new(
        body.case,
        &[("gravity", 0.0)],
        solver,
        partner.request(&[joint]),
    );
    let names: &[&str] = match body.space {
        Space::Planar => &["x", "y", "vx", "vy"],
        Space::Spatial => &["x", "y", "z", "vx", "vy", "vz"],
    };
    let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
    let read = |run: &Run| partner.signals(|_| FORCE, |signals| run.read(signals, &names));
    let start = match read(&run)[..] {
        [x, y, vx, vy] => [x, y, 0.0, vx, vy, 0.0],
        [x, y, z, vx, vy, vz] => [x, y, z, vx, vy, vz],
        _ => panic!("no position and velocity"),
    };
    let Law::InPlane { normal } = joint.law.law else {
        panic!("another law");
    };
    let (normal, axis) = match body.space {
        Space::Planar => (
            UnitQuaternion::from_scaled_axis(ANGLE * Vector3::z()) * normal,
            Vector3::z(),
        ),
        Space::Spatial => {
            let [w, x, y, z] = REFERENCE;
            let reference = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            (reference * normal, axis())
        }
    };
    let mut largest: f64 = 0.0;
    for _ in 0..20 {
        partner.signals(|_| FORCE, |signals| run.step(0.11, signals));
        let expected = centre(&start, &normal, &axis, run.t);
        let values = &read(&run)[..names.len() / 2];
        largest = largest.max(difference(values, &expected.as_slice()[..values.len()]));
    }
    largest
}

#[test]
fn a_turning_plane_pushes_the_centre_of_mass_along_its_normal() {
    let normal = Vector3::new(0.3, -1.0, 0.0).normalize();
    let tilted = Vector3::new(0.3, -1.0, 0.8).normalize();
    for solver in SOLVERS {
        for (body, normal) in [(LINK, normal), (SPATIAL, tilted)] {
            let error = error_of_centre(body, in_plane("end", normal), solver);
            println!("{} {solver:?}: {error:.1e}", body.case.model);
            assert!(error < 1e-10, "{} {solver:?}: {error:e}", body.case.model);
        }
    }
}

/// A body that a moment swings.
struct Swinging {
    body: Body,
    /// Moment of inertia (kg m^2) about the point that does not move.
    inertia: f64,
    /// Which end of the joint it is.
    end: End,
    /// Parameters that leave only the moment.
    alone: &'static [(&'static str, f64)],
}

const SWINGING: [Swinging; 2] = [
    Swinging {
        body: LINK,
        inertia: 0.17,
        end: End::A,
        alone: &[("gravity", 0.0)],
    },
    Swinging {
        body: PENDULUM,
        inertia: 0.17 + MASS * 0.56 * 0.56,
        end: End::B,
        alone: &[("gravity", 0.0), ("spring", 0.0)],
    },
];

impl Swinging {
    fn model(&self) -> &'static str {
        self.body.case.model
    }

    fn joint(&self) -> Joint {
        let law = Law::Perpendicular {
            axes: [Vector3::x(); 2],
        };
        Joint {
            marker: self.body.markers[0],
            law: JointLaw {
                law,
                points: [Vector3::zeros(); 2],
            },
            end: self.end,
        }
    }

    /// A moment between an axis of the body and one of the partner that turns at a steady rate: the angle from the one
    /// to the other swings as a pendulum, `psi'' = -W^2 sin psi`, `W^2 = lambda / J`. Its period is
    /// `2 pi / W agm(1, sqrt(1 - k^2))` with `2 W^2 k^2 = psi'^2 / 2 + W^2 (1 - cos psi)`.
    fn period(&self, [angle, rate]: [f64; 2]) -> f64 {
        let squared = MOMENT / self.inertia;
        let (swing, speed) = (ANGLE - angle, RATE - rate);
        let energy = 0.5 * speed * speed + squared * (1.0 - swing.cos());
        let modulus = energy / (2.0 * squared);
        assert!(modulus < 1.0, "it does not swing, it turns over");
        2.0 * PI / (squared.sqrt() * agm(1.0, (1.0 - modulus).sqrt()))
    }

    /// Difference of angle and rate after a period from those at the start.
    fn error(&self, solver: Solver) -> f64 {
        let partner = turning(Space::Planar);
        let request = partner.request(&[self.joint()]);
        let mut run = Run::new(self.body.case, self.alone, solver, request);
        let read = |run: &Run| {
            partner.signals(
                |_| MOMENT,
                |signals| run.read_all(signals, ["angle", "rate"]),
            )
        };
        let [angle, rate] = read(&run);
        let period = self.period([angle, rate]);
        for _ in 0..20 {
            partner.signals(|_| MOMENT, |signals| run.step(period / 20.0, signals));
        }
        difference(&read(&run), &[angle + RATE * period, rate])
    }
}

#[test]
fn a_turning_axis_makes_the_body_swing_with_the_period_of_a_pendulum() {
    for swinging in SWINGING {
        for solver in SOLVERS {
            let (model, error) = (swinging.model(), swinging.error(solver));
            println!("{model} {solver:?}: {error:.1e}");
            assert!(error < 1e-10, "{model} {solver:?}: {error:e}");
        }
    }
}

#[test]
fn rk4_keeps_its_order_under_joint_loads() {
    let solvers: [Solver; 3] = [
        Solver("rk4", &[("step", 4e-3)]),
        Solver("rk4", &[("step", 2e-3)]),
        Solver("rk4", &[("step", 1e-3)]),
    ];
    for swinging in SWINGING {
        let errors = solvers.map(|solver| swinging.error(solver));
        let orders = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
        println!("{}: {errors:?} {orders:?}", swinging.model());
        for order in orders {
            assert!(
                (order - 4.0).abs() < 0.3,
                "{}: {errors:?}",
                swinging.model()
            );
        }
    }
}

#[test]
fn radau5_keeps_its_tolerance_under_joint_loads() {
    let solvers = [
        (1e-5, Solver("radau5", &[("rtol", 1e-5), ("atol", 1e-5)])),
        (1e-7, Solver("radau5", &[("rtol", 1e-7), ("atol", 1e-7)])),
        (1e-9, Solver("radau5", &[("rtol", 1e-9), ("atol", 1e-9)])),
    ];
    for swinging in SWINGING {
        for (tolerance, solver) in solvers {
            let (model, error) = (swinging.model(), swinging.error(solver));
            println!("{model} {tolerance:e}: {error:.1e}");
            let allowed = 1e-4 * tolerance..tolerance;
            assert!(allowed.contains(&error), "{model} {tolerance:e}: {error:e}");
        }
    }
}
