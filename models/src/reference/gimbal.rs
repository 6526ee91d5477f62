//! A spinning top in a gimbal.

use nalgebra::{UnitQuaternion, Vector3};

use super::rigid_body::RigidBody;
use super::spatial_chain::{JointedBody, SpatialChain};
use super::spatial_joint::{CompositeJoint, SpatialJoint};

/// An outer ring that turns about the vertical z axis through the origin by `psi`, in it an inner ring about the outer
/// one's x axis by `theta`, in it a top about the inner ring's z axis by `phi`. All axes meet in the origin, where both
/// rings have their centres of mass; at `psi = theta = phi = 0` all axes are those of space.
///
/// For rings without inertia and a top with the moments `(A, A, C)` about its centre of mass, `I = A + m l^2`, it is
/// the heavy symmetric top with a fixed point (Goldstein, Classical Mechanics, Sect. 5.7). Its energy stays, and so do
/// its spin and its vertical angular momentum:
///
/// ```text
/// s = C (phi' + psi' cos theta),   I psi' sin^2 theta + s cos theta
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gimbal {
    /// The outer ring; only its third moment of inertia counts.
    pub outer: RigidBody,
    /// The inner ring.
    pub inner: RigidBody,
    /// The top; its third axis is the one that it spins about.
    pub top: RigidBody,
    /// `l`, from the origin to the top's centre of mass along its third axis (m).
    pub distance: f64,
    /// Acceleration of gravity in -z (m/s^2).
    pub gravity: f64,
    /// `psi`, `theta`, `phi` at the start (rad).
    pub angles: [f64; 3],
    /// Their rates (rad/s).
    pub rates: [f64; 3],
}

impl Gimbal {
    /// The gimbal as a chain: outer ring, inner ring, top.
    pub fn chain(&self) -> SpatialChain {
        let zero = Vector3::zeros();
        let top = Vector3::z() * -self.distance;
        let body = |body, axis, outer_point| JointedBody {
            body,
            joint: SpatialJoint {
                inner_point: zero,
                outer_point,
                freedoms: CompositeJoint::Revolute(axis).freedoms(),
                attitude: UnitQuaternion::identity(),
            },
        };
        SpatialChain {
            bodies: vec![
                body(self.outer, Vector3::z_axis(), zero),
                body(self.inner, Vector3::x_axis(), zero),
                body(self.top, Vector3::z_axis(), top),
            ],
            gravity: Vector3::z() * -self.gravity,
            coordinates: self.angles.to_vec(),
            rates: self.rates.to_vec(),
        }
    }
}
