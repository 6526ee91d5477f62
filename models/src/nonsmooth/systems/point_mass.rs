//! Point masses over a plane: a bouncing ball, and a mass that slides in space with friction in two directions.

use crate::nonsmooth::matrix::{BorderedBand, Shape};
use crate::nonsmooth::system::{Contact, Instant, MechanicalSystem, Side};

/// A ball over the floor. One coordinate, the height of its lowest point (m), which is its gap as well. Input, if there
/// is one: a force upwards (N).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BouncingBall {
    mass: f64,
    gravity: f64,
    contacts: [Contact; 1],
}

impl BouncingBall {
    /// With a mass (kg), the acceleration of gravity downwards (m/s^2) and a coefficient of restitution.
    pub fn new(mass: f64, gravity: f64, restitution: f64) -> Self {
        let contact = Contact {
            side: Side::Unilateral,
            normal_restitution: restitution,
            ..Contact::CONSTRAINT
        };
        Self {
            mass,
            gravity,
            contacts: [contact],
        }
    }
}

impl MechanicalSystem for BouncingBall {
    fn shape(&self) -> Shape {
        Shape::dense(1)
    }

    fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    fn mass(&self, _q: &[f64], mass: &mut BorderedBand) {
        mass.add(0, 0, self.mass);
    }

    fn force(&self, at: Instant<'_>, force: &mut [f64]) {
        let input = at.inputs.first().copied().unwrap_or(0.0);
        force.fill(input - self.mass * self.gravity);
    }

    fn gaps(&self, q: &[f64], gaps: &mut [f64]) {
        gaps.copy_from_slice(q);
    }

    fn directions(&self, _q: &[f64], rows: &mut [f64]) {
        rows.fill(1.0);
    }

    fn direction_rates(&self, _q: &[f64], _v: &[f64], rates: &mut [f64]) {
        rates.fill(0.0);
    }

    fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        self.mass * (0.5 * v[0] * v[0] + self.gravity * q[0])
    }
}

/// A mass on a plane in space. Coordinates: two in the plane and the distance from it (m), which is the gap. Inputs, as
/// many as there are: forces along the coordinates (N).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingMass {
    mass: f64,
    gravity: [f64; 3],
    contacts: [Contact; 1],
}

impl SlidingMass {
    /// With a mass (kg), the acceleration of gravity along the coordinates (m/s^2), whose third component presses the
    /// mass on the plane where it is negative, and a coefficient of friction. It does not bounce.
    pub fn new(mass: f64, gravity: [f64; 3], friction: f64) -> Self {
        let contact = Contact {
            side: Side::Unilateral,
            friction,
            tangents: 2,
            ..Contact::CONSTRAINT
        };
        Self {
            mass,
            gravity,
            contacts: [contact],
        }
    }
}

impl MechanicalSystem for SlidingMass {
    fn shape(&self) -> Shape {
        Shape::dense(3)
    }

    fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    fn mass(&self, _q: &[f64], mass: &mut BorderedBand) {
        for i in 0..3 {
            mass.add(i, i, self.mass);
        }
    }

    fn force(&self, at: Instant<'_>, force: &mut [f64]) {
        for (force, gravity) in force.iter_mut().zip(self.gravity) {
            *force = self.mass * gravity;
        }
        for (force, input) in force.iter_mut().zip(at.inputs) {
            *force += input;
        }
    }

    fn gaps(&self, q: &[f64], gaps: &mut [f64]) {
        gaps.fill(q[2]);
    }

    fn directions(&self, _q: &[f64], rows: &mut [f64]) {
        rows.copy_from_slice(&[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    }

    fn direction_rates(&self, _q: &[f64], _v: &[f64], rates: &mut [f64]) {
        rates.fill(0.0);
    }

    fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        let terms = q.iter().zip(v).zip(self.gravity);
        let sum = terms.map(|((q, v), gravity)| 0.5 * v * v - gravity * q);
        self.mass * sum.sum::<f64>()
    }
}
