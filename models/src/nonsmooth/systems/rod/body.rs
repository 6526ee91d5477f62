//! A rod with a mass at its end, in the coordinates in which a mechanism computes.

use super::coordinates::{Coordinates, Free, PER_NODE};
use super::integrals::{ShapeIntegrals, congruent, dense};
use super::modes::lowest;
use super::{Rod, RodError};
use crate::nonsmooth::matrix::dot;

/// A rod, ready for the equations of motion.
#[derive(Debug, Clone, PartialEq)]
pub struct RodBody {
    /// As described.
    pub rod: Rod,
    /// Integrals of the rod with the mass at its end.
    pub integrals: ShapeIntegrals,
    /// Displacement of the end in the frame, along and across: rows of the coordinates (`S_check` of S2 181).
    pub end: [Vec<f64>; 2],
    /// Bending moment at the root (N m): a row of the coordinates.
    root_moment: Vec<f64>,
    coordinates: Coordinates,
    angular_frequencies: Vec<f64>,
}

impl RodBody {
    /// A rod with `end_mass` (kg) at its end.
    ///
    /// Modes are those of the rod alone, as in S2 (184). Amplitudes of these modes would not make `S_ff` diagonal,
    /// which has the end mass too; so the coordinates are amplitudes of combinations of them that do, which describe
    /// the same motions.
    ///
    /// # Errors
    /// [`RodError`].
    pub fn new(rod: Rod, end_mass: f64) -> Result<Self, RodError> {
        rod.check()?;
        let free = Free::of(rod.reference, rod.nodes());
        let mut integrals = ShapeIntegrals::of(&rod, &free);
        let stiffness_and_mass = rod.modes.map(|count| {
            (
                count,
                dense(&integrals.stiffness),
                dense(&integrals.elastic),
            )
        });
        let mut coordinates = Coordinates { free, modes: None };
        let last = PER_NODE * rod.elements;
        let end = [last, last + 1].map(|value| coordinates.form(&[(value, 1.0)]));
        integrals.add_point_mass(end_mass, rod.length, [&end[0], &end[1]]);
        let mut angular_frequencies = Vec::new();
        if let Some((count, stiffness, mass)) = stiffness_and_mass {
            let modes = lowest(&stiffness, &mass, count)?;
            let [stiffness, mass] =
                [&integrals.stiffness, &integrals.elastic].map(|m| congruent(m, &modes.shapes));
            let combinations = lowest(&stiffness, &mass, count)?;
            let modes_with_end = modes.shapes * combinations.shapes;
            integrals = integrals.reduced(&modes_with_end);
            coordinates.modes = Some(modes_with_end);
            angular_frequencies = modes.angular_frequencies;
        }
        Ok(Self {
            end: [last, last + 1].map(|value| coordinates.form(&[(value, 1.0)])),
            root_moment: coordinates.form(&root_moment(&rod)),
            rod,
            integrals,
            coordinates,
            angular_frequencies,
        })
    }

    /// Coordinates.
    pub fn count(&self) -> usize {
        self.coordinates.count()
    }

    /// `omega_k` (rad/s) of the modes that are kept, without the end mass; empty without modes.
    pub fn angular_frequencies(&self) -> &[f64] {
        &self.angular_frequencies
    }

    /// Displacement of the end in the frame (m).
    pub fn end(&self, q: &[f64]) -> [f64; 2] {
        [dot(&self.end[0], q), dot(&self.end[1], q)]
    }

    /// `E I w''` at the root (N m): the bending moment there.
    pub fn root_moment(&self, q: &[f64]) -> f64 {
        dot(&self.root_moment, q)
    }

    /// Nodal values: as many as [`RodBody::write_nodal`] writes.
    pub fn nodal_count(&self) -> usize {
        self.coordinates.free.nodal()
    }

    /// Displacement of a node in the frame, along and across (m).
    pub fn node(&self, q: &[f64], node: usize) -> [f64; 2] {
        [0, 1].map(|axis| self.coordinates.nodal_value(q, PER_NODE * node + axis))
    }

    /// Writes `u`, `w`, `w'` of all nodes, from the root on.
    pub fn write_nodal(&self, q: &[f64], nodal: &mut [f64]) {
        self.coordinates.nodal(q, nodal);
    }
}

/// `E I w''(0) = E I/l^2 (-6 w_0 - 4 l w_0' + 6 w_1 - 2 l w_1')` of the first element, by nodal values (S2 163).
fn root_moment(rod: &Rod) -> [(usize, f64); 4] {
    let l = rod.length / rod.elements as f64;
    let factor = rod.youngs_modulus * rod.section.second_moment / (l * l);
    [
        (1, -6.0 * factor),
        (2, -4.0 * l * factor),
        (PER_NODE + 1, 6.0 * factor),
        (PER_NODE + 2, -2.0 * l * factor),
    ]
}
