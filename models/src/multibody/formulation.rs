//! What both formulations of the equations of motion give.

use linchpin_proto::joint_load::Wrench;
use linchpin_proto::readable::number;
use linchpin_worker::Inputs;

use super::kinematics::{Kinematics, Twist};
use super::system::System;
use crate::integrators::Ode;

/// Accelerations and reactions at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Dynamics {
    /// Of the ground and the bodies: acceleration of the centre of mass and angular acceleration.
    pub accelerations: Vec<Twist>,
    /// Of every joint: its load on body b, at the centre of mass of that.
    pub reactions: Vec<Wrench>,
}

/// A state that could not be brought back onto the joints.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Unsettled {
    /// The joints stay open.
    #[error(
        "the joints stay open by {residual} m or rad; the internal steps are too long, or the mechanism is in a singular position",
        residual = number(*residual)
    )]
    Open {
        /// Largest residual.
        residual: f64,
    },
    /// The reactions are not determined.
    #[error(
        "the conditions of the joints became dependent: the mechanism is in a singular position"
    )]
    Singular,
}

/// Equations of motion `y' = f(t, y, u)` of a system.
pub trait Formulation: Send {
    /// The system.
    fn system(&self) -> &System;

    /// Names of the states, for messages.
    fn state_names(&self) -> &[String];

    /// The states at the start.
    fn start(&self) -> Vec<f64>;

    /// The motion of the bodies at time `t` (s).
    fn kinematics(&self, t: f64, state: &[f64]) -> Kinematics;

    /// Accelerations and reactions under these inputs; `None` in a singular position.
    fn dynamics(&self, t: f64, state: &[f64], inputs: &[f64]) -> Option<Dynamics>;

    /// Writes `f(t, y, u)`; not a number in a singular position.
    fn rate(&self, t: f64, state: &[f64], inputs: &[f64], rate: &mut [f64]);

    /// Brings a state that a macro step has reached at time `t` back to where states belong.
    ///
    /// # Errors
    /// [`Unsettled`] if that is not possible.
    fn settle(&self, t: f64, state: &mut [f64]) -> Result<(), Unsettled>;
}

/// The equations under given inputs, as integrators want them.
pub struct Driven<'a> {
    pub formulation: &'a dyn Formulation,
    /// Time at which the macro step starts (s).
    pub start: f64,
    pub inputs: &'a Inputs,
}

impl Ode for Driven<'_> {
    fn derivative(&self, tau: f64, y: &[f64], dy: &mut [f64]) {
        let mut inputs = vec![0.0; self.inputs.len()];
        self.inputs.values_at(tau, &mut inputs);
        self.formulation.rate(self.start + tau, y, &inputs, dy);
    }
}
