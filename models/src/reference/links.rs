//! What references of linked pendulums share.

use super::ranges::{finite, not_negative, positive};
use super::{ReferenceError, trajectory};
use crate::integrators::Ode;

/// A rigid link in the plane; its centre of mass is in its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link {
    /// Mass (kg), positive.
    pub m: f64,
    /// Moment of inertia about the centre of mass (kg m^2), not negative.
    pub inertia: f64,
    /// Length (m), positive.
    pub length: f64,
}

impl Link {
    pub(super) fn check(&self) -> Result<(), ReferenceError> {
        positive("m", self.m)?;
        not_negative("inertia", self.inertia)?;
        positive("length", self.length)
    }
}

/// The torsional spring and damper between the ground and the first link.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GroundHinge {
    /// Stiffness (N m/rad), not negative.
    pub spring: f64,
    /// Damping (N m s/rad), not negative.
    pub damping: f64,
    /// Angle of the first link at which the spring is relaxed (rad).
    pub rest_angle: f64,
}

impl GroundHinge {
    /// Moment on the first link (N m).
    pub(super) fn moment(&self, angle: f64, rate: f64) -> f64 {
        -self.spring * (angle - self.rest_angle) - self.damping * rate
    }

    /// Energy of the spring (J).
    pub(super) fn energy(&self, angle: f64) -> f64 {
        0.5 * self.spring * (angle - self.rest_angle).powi(2)
    }
}

/// Motion of linked pendulums at one time; links are numbered from the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkMotion {
    /// Time since the start (s).
    pub t: f64,
    /// Angles of the links from the x axis (rad).
    pub angles: Vec<f64>,
    /// Their rates (rad/s).
    pub rates: Vec<f64>,
    /// Force (N) on link `i` in the hinge between the links `i` and `i + 1`.
    pub hinge_forces: Vec<[f64; 2]>,
    /// Kinetic energy, potential energy above the hinge in the ground, energy of the spring (J).
    pub energy: f64,
}

/// Pendulums with the state `(angles, rates)`.
pub(super) trait LinkedPendulum: Ode + Sized {
    fn motion(&self, t: f64, state: &[f64]) -> LinkMotion;

    fn motions(&self, start: &[f64], times: &[f64]) -> Result<Vec<LinkMotion>, ReferenceError> {
        let states = trajectory::states(self, start, times)?;
        let motions = times.iter().zip(&states);
        Ok(motions.map(|(&t, state)| self.motion(t, state)).collect())
    }
}

/// The rules of the numbers of linked pendulums.
pub(super) fn check_links<'a>(
    links: impl Iterator<Item = &'a Link>,
    hinge: &GroundHinge,
    gravity: f64,
    start: impl Iterator<Item = f64>,
) -> Result<(), ReferenceError> {
    for link in links {
        link.check()?;
    }
    not_negative("spring", hinge.spring)?;
    not_negative("damping", hinge.damping)?;
    finite("rest_angle", hinge.rest_angle)?;
    finite("gravity", gravity)?;
    for value in start {
        finite("start", value)?;
    }
    Ok(())
}
