//! Two double pendulums in space.

use nalgebra::{Unit, UnitQuaternion, UnitVector3, Vector3};

use super::rigid_body::RigidBody;
use super::spatial_chain::{JointedBody, SpatialChain};
use super::spatial_joint::{CompositeJoint, SpatialJoint};

impl SpatialChain {
    /// Two bodies with three different moments of inertia each; the first on a hinge in the ground with the tilted axis
    /// `(1, -2, 4) / sqrt 21`, the second in a universal joint at its end. The joint's axes, given in the axes of the
    /// first body, are `(2, 1, 0) / sqrt 5`, fixed in the first, and `(-1, 2, 3) / sqrt 14`, fixed in the second body.
    /// No point of a joint lies on a principal axis. Gravity 9.81 m/s^2 in -z.
    pub fn universal_double_pendulum() -> Self {
        let axes = [unit(2.0, 1.0, 0.0), unit(-1.0, 2.0, 3.0)];
        double_pendulum(CompositeJoint::Universal(axes), &[0.5, -0.7], &[2.5, -1.7])
    }

    /// The same with a revolute joint about the axis `(3, -1, 2) / sqrt 14` of the first body between the two.
    pub fn revolute_double_pendulum() -> Self {
        let axis = unit(3.0, -1.0, 2.0);
        double_pendulum(CompositeJoint::Revolute(axis), &[0.5], &[2.5])
    }
}

fn unit(x: f64, y: f64, z: f64) -> UnitVector3<f64> {
    Unit::new_normalize(Vector3::new(x, y, z))
}

fn double_pendulum(second: CompositeJoint, coordinates: &[f64], rates: &[f64]) -> SpatialChain {
    let on_ground = SpatialJoint {
        inner_point: Vector3::new(0.1, -0.2, 0.3),
        outer_point: Vector3::new(-0.05, 0.12, 0.5),
        freedoms: CompositeJoint::Revolute(unit(1.0, -2.0, 4.0)).freedoms(),
        attitude: UnitQuaternion::from_scaled_axis(Vector3::new(0.9, 0.3, -0.2)),
    };
    let between = SpatialJoint {
        inner_point: Vector3::new(0.08, -0.03, -0.45),
        outer_point: Vector3::new(0.11, 0.06, 0.4),
        freedoms: second.freedoms(),
        attitude: UnitQuaternion::from_scaled_axis(Vector3::new(-0.4, 0.7, 0.5)),
    };
    let first = RigidBody {
        m: 1.3,
        moments: Vector3::new(0.17, 0.29, 0.23),
    };
    let second = RigidBody {
        m: 0.8,
        moments: Vector3::new(0.11, 0.05, 0.09),
    };
    SpatialChain {
        bodies: vec![
            JointedBody {
                body: first,
                joint: on_ground,
            },
            JointedBody {
                body: second,
                joint: between,
            },
        ],
        gravity: Vector3::new(0.0, 0.0, -9.81),
        coordinates: [&[0.8], coordinates].concat(),
        rates: [&[-1.2], rates].concat(),
    }
}
