//! Two bodies that float in space in every joint: their conserved quantities, the laws of the joint and of the bodies.

#![allow(clippy::unwrap_used)]

mod common;

use common::spatial::{
    assert_chain_is_limit_of_rk4, assert_newton_euler, attitude, drift_of_energy, place,
};
use linchpin_models::reference::{
    BodyMotion, CompositeJoint, Freedom, JointedBody, RigidBody, SpatialChain, SpatialChainMotion,
    SpatialJoint,
};
use nalgebra::{Unit, UnitQuaternion, UnitVector3, Vector3};

const BODIES: [RigidBody; 2] = [
    RigidBody {
        m: 1.3,
        moments: Vector3::new(0.17, 0.29, 0.23),
    },
    RigidBody {
        m: 0.8,
        moments: Vector3::new(0.11, 0.05, 0.09),
    },
];
/// A point in space about which nothing is simple.
const ABOUT: Vector3<f64> = Vector3::new(0.7, -1.1, 0.4);

fn unit(x: f64, y: f64, z: f64) -> UnitVector3<f64> {
    Unit::new_normalize(Vector3::new(x, y, z))
}

/// All joints of S1 Sect. 3.2, with how many coordinates they leave.
fn joints() -> [(CompositeJoint, usize); 11] {
    let axis = unit(3.0, -1.0, 2.0);
    let axes = [unit(2.0, 1.0, 0.0), unit(-1.0, 2.0, 3.0)];
    [
        (CompositeJoint::Weld, 0),
        (CompositeJoint::AtPoint, 3),
        (CompositeJoint::Universal(axes), 2),
        (CompositeJoint::Revolute(axis), 1),
        (CompositeJoint::Translational(axis), 1),
        (CompositeJoint::Cylindrical(axis), 2),
        (CompositeJoint::Planar(axis), 3),
        (CompositeJoint::Inline(axis), 4),
        (CompositeJoint::InPlane(axis), 5),
        (CompositeJoint::Orientation, 3),
        (CompositeJoint::Perpendicular(axes), 5),
    ]
}

fn pair(joint: CompositeJoint, gravity: Vector3<f64>) -> SpatialChain {
    let floating = SpatialJoint {
        inner_point: Vector3::zeros(),
        outer_point: Vector3::zeros(),
        freedoms: CompositeJoint::Free.freedoms(),
        attitude: UnitQuaternion::identity(),
    };
    let between = SpatialJoint {
        inner_point: Vector3::new(0.08, -0.03, -0.45),
        outer_point: Vector3::new(0.11, 0.06, 0.4),
        freedoms: joint.freedoms(),
        attitude: UnitQuaternion::from_scaled_axis(Vector3::new(-0.4, 0.7, 0.5)),
    };
    let own = [0.3, -0.2, 0.25, -0.1, 0.15];
    let own_rates = [0.9, -1.4, 0.7, 1.1, -0.6];
    let count = between.freedoms.len();
    SpatialChain {
        bodies: vec![
            JointedBody {
                body: BODIES[0],
                joint: floating,
            },
            JointedBody {
                body: BODIES[1],
                joint: between,
            },
        ],
        gravity,
        coordinates: [&[0.3, -0.7, 0.2, 0.4, -0.3, 0.8], &own[..count]].concat(),
        rates: [&[0.5, 0.9, -0.4, 0.8, -0.5, 1.3], &own_rates[..count]].concat(),
    }
}

fn floating(joint: CompositeJoint) -> SpatialChain {
    pair(joint, Vector3::zeros())
}

fn over_a_second(chain: &SpatialChain) -> Vec<SpatialChainMotion> {
    let times: Vec<_> = (0..=10).map(|i| 0.1 * f64::from(i)).collect();
    chain.motions(&times).unwrap()
}

/// Sum over both bodies.
fn sum<T: std::iter::Sum>(
    motion: &SpatialChainMotion,
    value: impl Fn(&RigidBody, &BodyMotion) -> T,
) -> T {
    let bodies = BODIES.iter().zip(&motion.bodies);
    bodies.map(|(body, motion)| value(body, motion)).sum()
}

fn momentum(motion: &SpatialChainMotion) -> Vector3<f64> {
    sum(motion, RigidBody::momentum)
}

fn angular_momentum(motion: &SpatialChainMotion) -> Vector3<f64> {
    sum(motion, |body, motion| body.angular_momentum(motion, &ABOUT))
}

#[test]
fn every_joint_leaves_its_freedoms() {
    for (joint, count) in joints() {
        assert_eq!(joint.freedoms().len(), count, "{joint:?}");
    }
}

#[test]
fn momentum_angular_momentum_and_energy_stay() {
    for (joint, _) in joints() {
        let motions = over_a_second(&floating(joint));
        let first = &motions[0];
        for motion in &motions {
            let change = (momentum(motion) - momentum(first)).norm();
            assert!(change < 1e-11, "{joint:?}: {change:e} at {}", motion.t);
            let change = (angular_momentum(motion) - angular_momentum(first)).norm();
            assert!(change < 1e-11, "{joint:?}: {change:e} at {}", motion.t);
            let kinetic: f64 = sum(motion, RigidBody::kinetic_energy);
            assert!((kinetic - motion.energy).abs() < 1e-14, "{joint:?}");
            let load = motion.reactions[0];
            let size = load.force.norm() + load.moment.norm();
            assert!(size < 1e-11, "{joint:?}: nothing acts on the floating body");
        }
        let drift = drift_of_energy(&motions);
        assert!(drift < 1e-11, "{joint:?}: {drift:e}");
        let moved = motions[10].bodies[1].omega - motions[0].bodies[1].omega;
        assert!(moved.norm() > 1e-2, "{joint:?}");
    }
}

/// Under gravity the pair falls: its momentum grows by the weight, the joint's load is that of the pair without weight.
#[test]
fn gravity_moves_the_pair_only_as_a_whole() {
    let gravity = Vector3::new(1.3, -2.1, -9.0);
    for (joint, _) in joints() {
        let falling = over_a_second(&pair(joint, gravity));
        let floating = over_a_second(&floating(joint));
        for (falling, floating) in falling.iter().zip(&floating) {
            let t = falling.t;
            let weight = (BODIES[0].m + BODIES[1].m) * gravity;
            let error = (momentum(falling) - momentum(floating) - weight * t).norm();
            assert!(error < 1e-10, "{joint:?}: {error:e} at {t}");
            let fallen = falling.bodies[1].position - floating.bodies[1].position;
            let error = (fallen - 0.5 * t * t * gravity).norm();
            assert!(error < 1e-10, "{joint:?}: {error:e} at {t}");
            let error = (falling.reactions[1].force - floating.reactions[1].force).norm();
            assert!(error < 1e-8, "{joint:?}: {error:e} at {t}");
        }
        let drift = drift_of_energy(&falling);
        assert!(drift < 1e-9, "{joint:?}: {drift:e}");
    }
}

#[test]
fn the_bodies_obey_newton_s_and_euler_s_laws() {
    for (joint, _) in joints() {
        assert_newton_euler(&floating(joint), 0.4);
    }
}

#[test]
fn another_integrator_tends_to_it() {
    for (joint, _) in joints() {
        assert_chain_is_limit_of_rk4(&floating(joint), 0.5);
    }
}

/// A joint as it shows in the poses.
struct Seen {
    /// From the joint's point in the first body to that in the second.
    gap: Vector3<f64>,
    /// Attitude of the second body relative to where the first would have it at coordinates 0.
    turn: UnitQuaternion<f64>,
    /// From the axes of the first body to those of space.
    first: UnitQuaternion<f64>,
}

fn seen(chain: &SpatialChain, motion: &SpatialChainMotion) -> Seen {
    let joint = &chain.bodies[1].joint;
    let [first, second] = [motion.bodies[0], motion.bodies[1]];
    let gap = place(&second, &joint.outer_point) - place(&first, &joint.inner_point);
    let first = attitude(&first);
    Seen {
        gap: first.inverse() * gap,
        turn: first.inverse() * attitude(&second) * joint.attitude.inverse(),
        first,
    }
}

impl Seen {
    /// How far the bodies are from obeying the joint's constraints, which are written as S1 Sect. 3.2 does.
    fn violation(&self, joint: CompositeJoint) -> f64 {
        let at_point = self.gap.norm();
        let inline = |axis: UnitVector3<f64>| self.gap.cross(&axis).norm();
        let in_plane = |normal: UnitVector3<f64>| self.gap.dot(&normal).abs();
        let parallel = |axis: UnitVector3<f64>| (self.turn * *axis - *axis).norm();
        let no_turn = self.turn.angle();
        let perpendicular =
            |[first, second]: [UnitVector3<f64>; 2]| first.dot(&(self.turn * *second)).abs();
        match joint {
            CompositeJoint::Weld => at_point + no_turn,
            CompositeJoint::AtPoint => at_point,
            CompositeJoint::Universal(axes) => at_point + perpendicular(axes),
            CompositeJoint::Revolute(axis) => at_point + parallel(axis),
            CompositeJoint::Translational(axis) => inline(axis) + no_turn,
            CompositeJoint::Cylindrical(axis) => inline(axis) + parallel(axis),
            CompositeJoint::Planar(normal) => in_plane(normal) + parallel(normal),
            CompositeJoint::Inline(axis) => inline(axis),
            CompositeJoint::InPlane(normal) => in_plane(normal),
            CompositeJoint::Orientation => no_turn,
            CompositeJoint::Perpendicular(axes) => perpendicular(axes),
            CompositeJoint::Free => 0.0,
        }
    }
}

#[test]
fn the_poses_obey_the_constraints_of_the_joint() {
    for (joint, _) in joints() {
        let chain = floating(joint);
        for motion in over_a_second(&chain) {
            let violation = seen(&chain, &motion).violation(joint);
            assert!(violation < 1e-13, "{joint:?}: {violation:e}");
        }
    }
}

/// The load of the joint has no part along its freedoms.
#[test]
fn the_load_does_no_work_along_the_freedoms() {
    for (joint, _) in joints() {
        let chain = floating(joint);
        let slides = joint
            .freedoms()
            .into_iter()
            .filter_map(|freedom| match freedom {
                Freedom::Slide(axis) => Some(axis),
                Freedom::Turn(_) => None,
            });
        let slides: Vec<_> = slides.collect();
        for motion in over_a_second(&chain) {
            let seen = seen(&chain, &motion);
            let [force, moment] = [motion.reactions[1].force, motion.reactions[1].moment]
                .map(|load| seen.first.inverse() * load);
            for slide in &slides {
                assert!(force.dot(slide).abs() < 1e-13, "{joint:?}: {force}");
            }
            let work = match joint {
                CompositeJoint::Weld
                | CompositeJoint::Translational(_)
                | CompositeJoint::Orientation => 0.0,
                CompositeJoint::Revolute(axis)
                | CompositeJoint::Cylindrical(axis)
                | CompositeJoint::Planar(axis) => moment.dot(&axis).abs(),
                CompositeJoint::Universal([first, second])
                | CompositeJoint::Perpendicular([first, second]) => {
                    moment.dot(&first).abs() + moment.dot(&(seen.turn * *second)).abs()
                }
                CompositeJoint::AtPoint
                | CompositeJoint::Inline(_)
                | CompositeJoint::InPlane(_)
                | CompositeJoint::Free => moment.norm(),
            };
            assert!(work < 1e-13, "{joint:?}: {work:e}");
            let size = force.norm() + moment.norm();
            assert!(size > 1e-3, "{joint:?}: {size:e}");
        }
    }
}

/// Welded bodies have one angular velocity, and their centres move as points of one body.
#[test]
fn a_weld_makes_one_body() {
    let chain = floating(CompositeJoint::Weld);
    for motion in over_a_second(&chain) {
        let [first, second] = [motion.bodies[0], motion.bodies[1]];
        let rates = [first, second].map(|body| attitude(&body) * body.omega);
        assert!((rates[0] - rates[1]).norm() < 1e-13);
        let velocity = first.velocity + rates[0].cross(&(second.position - first.position));
        assert!((velocity - second.velocity).norm() < 1e-13);
    }
}

/// Momenta and energies of a body by hand: a quarter turn about x takes the body's y to the z of space.
#[test]
fn momenta_and_energies_of_one_body() {
    let body = BODIES[0];
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
    let motion = BodyMotion {
        position: Vector3::new(1.7, -1.1, 0.4),
        attitude: turn.into_inner(),
        velocity: Vector3::new(0.0, 2.0, 0.0),
        omega: Vector3::new(0.0, 3.0, 0.0),
    };
    let momentum = body.momentum(&motion);
    assert!((momentum - Vector3::new(0.0, 2.6, 0.0)).norm() < 1e-15);
    let spin = body.angular_momentum(&motion, &ABOUT);
    // (1, 0, 0) x (0, 2.6, 0) and 0.29 * 3 about z.
    assert!((spin - Vector3::new(0.0, 0.0, 2.6 + 0.87)).norm() < 1e-14);
    assert!((body.kinetic_energy(&motion) - 0.5 * (1.3 * 4.0 + 0.29 * 9.0)).abs() < 1e-14);
    let height = body.potential_energy(&motion, &Vector3::new(0.0, 0.0, -9.7));
    assert!((height - 1.3 * 9.7 * 0.4).abs() < 1e-14);
}
