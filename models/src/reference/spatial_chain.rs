//! Rigid bodies in space, one on the other, in the coordinates of their joints.

mod dynamics;
mod frame;
#[cfg(test)]
mod tests;

use nalgebra::Vector3;

use super::ranges::all_finite;
use super::rigid_body::{BodyMotion, RigidBody};
use super::spatial_joint::SpatialJoint;
use super::{ReferenceError, trajectory};
use crate::integrators::Ode;
use dynamics::Configuration;

/// An open chain of rigid bodies, the first on the ground, each other one on the one before it, in joints without
/// friction.
///
/// The coordinates `q` are those of the freedoms of all joints from the ground to the tip. Kane's equations are
///
/// ```text
/// sum_k M_jk q_k'' = sum_i v_ij m_i (g - a_i) - w_ij (J_i alpha_i + omega_i x J_i omega_i)
/// M_jk = sum_i m_i v_ij v_ik + w_ij J_i w_ik
/// ```
///
/// `v_ij`, `w_ij` are the velocity of the centre and the angular velocity of body `i` per unit of the rate `q_j'`
/// (partial velocities), `a_i`, `alpha_i` its accelerations at constant rates. The load in a joint is what the bodies
/// outside of it need by Newton's and Euler's laws besides their weights.
///
/// Kane & Levinson, Dynamics: Theory and Applications (1985), Sect. 6.1.
///
/// Three successive turns have infinite rates where the second is a quarter turn; a motion that comes there fails.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialChain {
    /// The bodies from the ground to the tip.
    pub bodies: Vec<JointedBody>,
    /// Acceleration of gravity (m/s^2), in space.
    pub gravity: Vector3<f64>,
    /// Coordinates at the start (rad, m), one for each freedom.
    pub coordinates: Vec<f64>,
    /// Their rates at the start (rad/s, m/s).
    pub rates: Vec<f64>,
}

/// A body with the joint that it hangs on.
#[derive(Debug, Clone, PartialEq)]
pub struct JointedBody {
    /// Mass and moments of inertia; they may vanish where the mass matrix of the chain stays positive definite.
    pub body: RigidBody,
    /// To the body before it, or to the ground.
    pub joint: SpatialJoint,
}

/// Motion of a chain at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialChainMotion {
    /// Time since the start (s).
    pub t: f64,
    /// Coordinates of the joints (rad, m).
    pub coordinates: Vec<f64>,
    /// Their rates (rad/s, m/s).
    pub rates: Vec<f64>,
    /// Motions of the bodies.
    pub bodies: Vec<BodyMotion>,
    /// Loads in the joints; number `i` is the joint that body `i` hangs on.
    pub reactions: Vec<JointReaction>,
    /// Kinetic and potential energy of all bodies (J); the latter is 0 at the origin.
    pub energy: f64,
}

/// What a joint does to its outer body; the opposite acts on the inner one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointReaction {
    /// Point of the joint in the outer body (m), in space.
    pub point: Vector3<f64>,
    /// Force on the outer body (N), in space.
    pub force: Vector3<f64>,
    /// Moment on the outer body about that point (N m), in space.
    pub moment: Vector3<f64>,
}

impl SpatialChain {
    /// The motion at `times` (s since the start), which must ascend from 0; Radau IIA with the tolerance 1e-12.
    ///
    /// # Errors
    /// [`ReferenceError`] if there is no body, a number is out of its range, coordinates or rates are not one for each
    /// freedom, the times do not ascend, or the integration fails.
    pub fn motions(&self, times: &[f64]) -> Result<Vec<SpatialChainMotion>, ReferenceError> {
        self.check()?;
        let start = [self.coordinates.as_slice(), &self.rates].concat();
        let states = trajectory::states(self, &start, times)?;
        let motions = times.iter().zip(states);
        Ok(motions.map(|(&t, state)| self.motion(t, &state)).collect())
    }

    fn check(&self) -> Result<(), ReferenceError> {
        if self.bodies.is_empty() {
            return Err(ReferenceError::NoBody);
        }
        for (place, body) in self.bodies.iter().enumerate() {
            body.check().map_err(|error| error.in_body(place))?;
        }
        let freedoms = self.bodies.iter().map(|body| body.joint.freedoms.len());
        let freedoms = freedoms.sum();
        for (field, values) in [("coordinates", &self.coordinates), ("rates", &self.rates)] {
            if values.len() != freedoms {
                return Err(ReferenceError::NotOnePerFreedom {
                    field,
                    given: values.len(),
                    freedoms,
                });
            }
            all_finite(field, values)?;
        }
        all_finite("gravity", self.gravity.as_slice())
    }

    fn motion(&self, t: f64, state: &[f64]) -> SpatialChainMotion {
        let (coordinates, rates) = state.split_at(self.coordinates.len());
        let now = Configuration::new(self, coordinates, rates);
        let bodies = now.motions();
        let own = self.bodies.iter().map(|body| body.body);
        let energies = own.zip(&bodies).map(|(body, motion)| {
            body.kinetic_energy(motion) + body.potential_energy(motion, &self.gravity)
        });
        SpatialChainMotion {
            t,
            coordinates: coordinates.to_vec(),
            rates: rates.to_vec(),
            energy: energies.sum(),
            reactions: now.reactions(),
            bodies,
        }
    }
}

impl JointedBody {
    fn check(&self) -> Result<(), ReferenceError> {
        self.body.check()?;
        self.joint.check()
    }
}

impl Ode for SpatialChain {
    fn derivative(&self, _: f64, y: &[f64], dy: &mut [f64]) {
        let (coordinates, rates) = y.split_at(self.coordinates.len());
        let (coordinate_rates, rate_rates) = dy.split_at_mut(self.coordinates.len());
        let accelerations = Configuration::new(self, coordinates, rates).accelerations();
        coordinate_rates.copy_from_slice(rates);
        rate_rates.copy_from_slice(accelerations.as_slice());
    }
}
