//! Springs and dampers along the line between two points.

use linchpin_proto::joint_load::Wrench;
use linchpin_worker::setup::SetupError;
use nalgebra::Vector3;

use super::body::{self, Body};
use super::entries::{Entries, Entry};
use super::error::CompositionError;
use super::kinematics::{BodyMotion, NO_LOAD, add_load, moved_load};

/// A spring and a damper: with `d` from the end on a to that on b, the force on a is
/// `(stiffness (|d| - rest_length) + damping |d|') d / |d|`, and b gets the opposite.
#[derive(Debug, Clone, PartialEq)]
pub struct Spring {
    bodies: [usize; 2],
    /// Ends in the axes of a and b, from the centres of mass (m).
    points: [Vector3<f64>; 2],
    stiffness: f64,
    damping: f64,
    rest_length: f64,
}

/// All springs of a composition.
///
/// # Errors
/// [`SetupError`]: a body that is not there, a value out of its range, a force without direction.
pub fn read(entries: &Entries<'_>, bodies: &[Body]) -> Result<Vec<Spring>, SetupError> {
    let springs = entries.of("spring");
    springs.map(|entry| Spring::read(&entry, bodies)).collect()
}

impl Spring {
    fn read(entry: &Entry<'_>, bodies: &[Body]) -> Result<Self, SetupError> {
        let mut spring = Self {
            bodies: body::pair(entry, bodies)?,
            points: [
                entry.vector_or_zeros("point_a")?,
                entry.vector_or_zeros("point_b")?,
            ],
            stiffness: entry.non_negative_or("stiffness", 0.0)?,
            damping: entry.non_negative_or("damping", 0.0)?,
            rest_length: 0.0,
        };
        let length = spring.apart(|place| &bodies[place].start).norm();
        spring.rest_length = entry.non_negative_or("rest_length", length)?;
        if length == 0.0 && (spring.damping > 0.0 || spring.rest_length > 0.0) {
            let field = entry.place();
            return Err(CompositionError::NoLength { field }.into());
        }
        Ok(spring)
    }

    /// Adds its loads on the bodies, at their centres of mass.
    pub fn add_loads(&self, motions: &[BodyMotion], loads: &mut [Wrench]) {
        let [a, b] = self.bodies.map(|place| &motions[place]);
        let apart = self.apart(|place| &motions[place]);
        let length = apart.norm();
        let moving = b.velocity(&self.points[1]) - a.velocity(&self.points[0]);
        let mut force = self.stiffness * apart;
        if length > 0.0 {
            let along = apart / length;
            let damper = self.damping * moving.dot(&along);
            force += (damper - self.stiffness * self.rest_length) * along;
        }
        for (end, sign) in [(0, 1.0), (1, -1.0)] {
            let place = self.bodies[end];
            let arm = motions[place].arm(&self.points[end]);
            let load = moved_load(&Wrench { force, ..NO_LOAD }, &arm);
            add_load(&mut loads[place], sign, &load);
        }
    }

    /// Energy of the spring (J).
    pub fn energy(&self, motions: &[BodyMotion]) -> f64 {
        let stretched = self.apart(|place| &motions[place]).norm() - self.rest_length;
        0.5 * self.stiffness * stretched * stretched
    }

    fn apart<'m>(&self, motion: impl Fn(usize) -> &'m BodyMotion) -> Vector3<f64> {
        let [a, b] = self.bodies.map(motion);
        b.point(&self.points[1]) - a.point(&self.points[0])
    }
}
