//! The reference of bodies in space against Newton's laws, its own constraints and the plane.

#![allow(clippy::unwrap_used)]

mod common;

use common::body::difference;
use common::spatial::{
    assert_chain_is_limit_of_rk4, assert_newton_euler, attitude, drift_of_energy, place,
};
use linchpin_models::reference::{
    CompositeJoint, DoublePendulum, Freedom, GroundHinge, JointedBody, Link, ReferenceError,
    RigidBody, SpatialChain, SpatialChainMotion, SpatialJoint,
};
use nalgebra::{UnitQuaternion, Vector3};

fn chains() -> [SpatialChain; 2] {
    [
        SpatialChain::universal_double_pendulum(),
        SpatialChain::revolute_double_pendulum(),
    ]
}

fn over_two_seconds(chain: &SpatialChain) -> Vec<SpatialChainMotion> {
    let times: Vec<_> = (0..=20).map(|i| 0.1 * f64::from(i)).collect();
    chain.motions(&times).unwrap()
}

/// Axis of turn number `number` of the second joint in the first and in the second body.
fn axis(chain: &SpatialChain, number: usize) -> [Vector3<f64>; 2] {
    let joint = &chain.bodies[1].joint;
    let Freedom::Turn(axis) = joint.freedoms[number] else {
        panic!()
    };
    let axis = axis.into_inner();
    [axis, joint.attitude.inverse() * axis]
}

#[test]
fn the_bodies_obey_newton_s_and_euler_s_laws() {
    for chain in chains() {
        for t in [0.2, 0.9, 1.6] {
            assert_newton_euler(&chain, t);
        }
    }
}

#[test]
fn the_energy_stays() {
    for chain in chains() {
        let drift = drift_of_energy(&over_two_seconds(&chain));
        println!("drift {drift:e}");
        assert!(drift < 1e-10, "{drift:e}");
    }
}

#[test]
fn another_integrator_tends_to_it() {
    for chain in chains() {
        assert_chain_is_limit_of_rk4(&chain, 1.0);
    }
}

/// By the poses alone: the points of a joint are one, the first body keeps the axis in the ground.
#[test]
fn the_points_of_the_joints_coincide() {
    for chain in chains() {
        let [ground, between] = [0, 1].map(|i| chain.bodies[i].joint.clone());
        let Freedom::Turn(axis) = ground.freedoms[0] else {
            panic!()
        };
        for motion in over_two_seconds(&chain) {
            let [first, second] = [motion.bodies[0], motion.bodies[1]];
            let gap = place(&first, &ground.outer_point) - ground.inner_point;
            assert!(gap.norm() < 1e-14, "{gap}");
            let gap = place(&first, &between.inner_point) - place(&second, &between.outer_point);
            assert!(gap.norm() < 1e-14, "{gap}");
            let turned = attitude(&first) * (ground.attitude.inverse() * axis.into_inner());
            assert!((turned - axis.into_inner()).norm() < 1e-14, "{turned}");
        }
    }
}

/// The axes of the universal joint stay at right angles, and it puts no moment about either.
#[test]
fn the_universal_joint_keeps_its_axes_at_right_angles() {
    let chain = SpatialChain::universal_double_pendulum();
    let [in_first, _] = axis(&chain, 0);
    let [_, in_second] = axis(&chain, 1);
    for motion in over_two_seconds(&chain) {
        let axes = [
            attitude(&motion.bodies[0]) * in_first,
            attitude(&motion.bodies[1]) * in_second,
        ];
        assert!(axes[0].dot(&axes[1]).abs() < 1e-14, "{axes:?}");
        let moment = motion.reactions[1].moment;
        assert!(moment.norm() > 1e-2, "{moment}");
        for axis in axes {
            assert!(moment.dot(&axis).abs() < 1e-13, "{moment} {axis}");
        }
    }
}

/// Both bodies see the axis of the revolute joint at one place, and it puts no moment about it.
#[test]
fn the_revolute_joint_keeps_its_axis() {
    let chain = SpatialChain::revolute_double_pendulum();
    let axes = axis(&chain, 0);
    for motion in over_two_seconds(&chain) {
        let seen = [0, 1].map(|body| attitude(&motion.bodies[body]) * axes[body]);
        assert!((seen[0] - seen[1]).norm() < 1e-14, "{seen:?}");
        let moment = motion.reactions[1].moment;
        assert!(moment.norm() > 1e-2, "{moment}");
        assert!(moment.dot(&seen[0]).abs() < 1e-13, "{moment}");
    }
}

/// With all axes along z it is the double pendulum in the plane.
#[test]
fn parallel_axes_give_the_double_pendulum() {
    let links = [(1.3, 0.17, 0.9), (2.1, 0.41, 1.7)].map(|(m, inertia, length)| Link {
        m,
        inertia,
        length,
    });
    let planar = DoublePendulum {
        links,
        hinge: GroundHinge::default(),
        gravity: 9.7,
        angles: [1.1, -2.0],
        rates: [-4.0, 3.0],
    };
    let joint = |inner_point: f64, outer_point: f64| SpatialJoint {
        inner_point: Vector3::x() * inner_point,
        outer_point: Vector3::x() * outer_point,
        freedoms: CompositeJoint::Revolute(Vector3::z_axis()).freedoms(),
        attitude: UnitQuaternion::identity(),
    };
    let body = |link: Link, inner_point: f64| JointedBody {
        body: RigidBody {
            m: link.m,
            moments: Vector3::new(0.3, 0.7, link.inertia),
        },
        joint: joint(inner_point, -0.5 * link.length),
    };
    let spatial = SpatialChain {
        bodies: vec![body(links[0], 0.0), body(links[1], 0.5 * links[0].length)],
        gravity: Vector3::new(0.0, -9.7, 0.0),
        coordinates: vec![1.1, -3.1],
        rates: vec![-4.0, 7.0],
    };
    let times = [0.0, 0.4, 1.3];
    let planar = planar.motions(&times).unwrap();
    for (planar, spatial) in planar.iter().zip(spatial.motions(&times).unwrap()) {
        let [a, b] = spatial.coordinates[..] else {
            panic!()
        };
        assert!(difference(&planar.angles, &[a, a + b]) < 1e-9);
        let force = -spatial.reactions[1].force;
        assert!(difference(&planar.hinge_forces[0], &force.as_slice()[..2]) < 1e-8);
        assert!(force.z.abs() < 1e-14 && spatial.reactions[1].moment.norm() < 1e-12);
        assert!((planar.energy - spatial.energy).abs() < 1e-9);
    }
}

#[test]
fn mistakes_are_named() {
    let refused = |alter: fn(&mut SpatialChain)| {
        let mut chain = SpatialChain::universal_double_pendulum();
        alter(&mut chain);
        chain.motions(&[0.0]).unwrap_err().to_string()
    };
    type Alter = fn(&mut SpatialChain);
    let mistakes: [(Alter, &str); 10] = [
        (|chain| chain.bodies.clear(), "no body"),
        (
            |chain| chain.bodies[1].body.m = -1.0,
            "body 1 (from 0) has m = -1",
        ),
        (
            |chain| chain.bodies[0].body.moments.z = f64::NAN,
            "body 0 (from 0) has moments = NaN",
        ),
        (
            |chain| chain.bodies[1].joint.inner_point.y = f64::NAN,
            "has inner_point = NaN",
        ),
        (
            |chain| chain.bodies[1].joint.outer_point.y = f64::INFINITY,
            "has outer_point = inf",
        ),
        (
            |chain| {
                let axis = nalgebra::Unit::new_unchecked(Vector3::repeat(f64::NAN));
                chain.bodies[1].joint.freedoms[0] = Freedom::Turn(axis);
            },
            "body 1 (from 0) has freedoms = NaN",
        ),
        (|chain| chain.gravity.x = f64::NAN, "gravity = NaN"),
        (|chain| chain.coordinates[2] = f64::NAN, "coordinates = NaN"),
        (
            |chain| chain.coordinates.push(0.0),
            "4 coordinates at the start, but the joints have 3 freedoms",
        ),
        (
            |chain| chain.rates.truncate(1),
            "1 rates at the start, but the joints have 3 freedoms",
        ),
    ];
    for (alter, expected) in mistakes {
        let message = refused(alter);
        assert!(message.contains(expected), "{message}");
    }
}

/// A body without inertia about a freedom of its own has no acceleration.
#[test]
fn a_singular_mass_matrix_is_refused() {
    let mut chain = SpatialChain::revolute_double_pendulum();
    chain.bodies[1].body = RigidBody {
        m: 0.0,
        moments: Vector3::zeros(),
    };
    let error = chain.motions(&[0.1]).unwrap_err();
    assert!(
        matches!(error, ReferenceError::Integration { t: 0.0, .. }),
        "{error}"
    );
}
