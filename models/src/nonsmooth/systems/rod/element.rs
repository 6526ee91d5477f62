//! Integrals of the shape functions over one element in closed form.
//!
//! With `xi = x/l` the shape functions (S2 110) are `1 - xi`, `xi` along and the cubics of Hermite across. The order of
//! the nodal values is that of S2 Fig. 34: `u`, `w`, `w'` of the first node, then of the second.

use super::{Rod, RotaryInertia};

/// Nodal values of an element.
pub const VALUES: usize = 6;
/// Nodal values along the rod.
const ALONG: [usize; 2] = [0, 3];
/// Nodal values across it.
const ACROSS: [usize; 4] = [1, 2, 4, 5];

/// A square matrix over the nodal values.
pub type Square = [[f64; VALUES]; VALUES];
/// A row over the nodal values.
pub type Row = [f64; VALUES];

/// Integrals over an element that starts at `x = 0`; all elements of a rod have the same.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    /// Length `l` (m).
    pub length: f64,
    /// Mass (kg).
    pub mass: f64,
    /// `rho I l` (kg m^2): what sections have of the mass's second moment, the integral of `rho y^2` (134).
    pub rotary: f64,
    /// `S_bar`, S2 (131): the integral of `rho S`, along and across (kg, and kg m for `w'`).
    pub mean: [Row; 2],
    /// The integral of `rho x S`, along and across: what `I_3` (135) and `I_4` (140) have from the element's inside.
    pub weighted: [Row; 2],
    /// What `I_4` (140) has from `y^2`: the integral of `rho I w'`. 0 if only the frame has rotary inertia.
    pub tilt: Row,
    /// `S_ff`, S2 (138).
    pub elastic: Square,
    /// `S_tilde`, S2 (140), skew.
    pub skew: Square,
    /// `K_ff`, S2 (160).
    pub stiffness: Square,
}

impl Element {
    /// An element of a rod.
    pub fn of(rod: &Rod) -> Self {
        let l = rod.length / rod.elements as f64;
        let area = rod.section.area;
        let mass = rod.density * area * l;
        let per_length = rod.density * rod.section.second_moment;
        let (axial, bending) = (
            rod.youngs_modulus * area / l,
            rod.youngs_modulus * rod.section.second_moment / l.powi(3),
        );
        let mut element = Self {
            length: l,
            mass,
            rotary: per_length * l,
            mean: [
                along([mass / 2.0; 2]),
                across(scaled([0.5, l / 12.0, 0.5, -l / 12.0], mass)),
            ],
            weighted: [
                along([mass * l / 6.0, mass * l / 3.0]),
                across(scaled([0.15, l / 30.0, 0.35, -l / 20.0], mass * l)),
            ],
            tilt: [0.0; VALUES],
            elastic: [[0.0; VALUES]; VALUES],
            skew: [[0.0; VALUES]; VALUES],
            stiffness: [[0.0; VALUES]; VALUES],
        };
        add_along(&mut element.elastic, [[2.0, 1.0], [1.0, 2.0]], mass / 6.0);
        add_across(
            &mut element.elastic,
            [
                [156.0, 22.0 * l, 54.0, -13.0 * l],
                [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
                [54.0, 13.0 * l, 156.0, -22.0 * l],
                [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
            ],
            mass / 420.0,
        );
        add_along(&mut element.stiffness, [[1.0, -1.0], [-1.0, 1.0]], axial);
        add_across(
            &mut element.stiffness,
            [
                [12.0, 6.0 * l, -12.0, 6.0 * l],
                [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
                [-12.0, -6.0 * l, 12.0, -6.0 * l],
                [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
            ],
            bending,
        );
        element.add_skew(mass);
        if rod.rotary_inertia == RotaryInertia::Consistent {
            element.add_rotary(per_length);
        }
        element
    }

    /// The integral of `rho (S_1^T S_2 - S_2^T S_1)`, which is `S^T I_tilde S` with (125).
    fn add_skew(&mut self, mass: f64) {
        let l = self.length;
        let products = [
            [0.35, l / 20.0, 0.15, -l / 30.0],
            [0.15, l / 30.0, 0.35, -l / 20.0],
        ];
        for (row, products) in ALONG.into_iter().zip(products) {
            for (column, product) in ACROSS.into_iter().zip(products) {
                self.skew[row][column] += mass * product;
                self.skew[column][row] -= mass * product;
            }
        }
    }

    /// What `-y w'` adds to the motion along: `rho I w'^2` in `S_ff`, `rho I w'` in `I_4`.
    fn add_rotary(&mut self, per_length: f64) {
        let l = self.length;
        add_across(
            &mut self.elastic,
            [
                [36.0, 3.0 * l, -36.0, 3.0 * l],
                [3.0 * l, 4.0 * l * l, -3.0 * l, -l * l],
                [-36.0, -3.0 * l, 36.0, -3.0 * l],
                [3.0 * l, -l * l, -3.0 * l, 4.0 * l * l],
            ],
            per_length / (30.0 * l),
        );
        self.tilt = across([-per_length, 0.0, per_length, 0.0]);
    }
}

fn scaled(values: [f64; 4], factor: f64) -> [f64; 4] {
    values.map(|value| factor * value)
}

fn along(values: [f64; 2]) -> Row {
    let mut row = [0.0; VALUES];
    for (place, value) in ALONG.into_iter().zip(values) {
        row[place] = value;
    }
    row
}

fn across(values: [f64; 4]) -> Row {
    let mut row = [0.0; VALUES];
    for (place, value) in ACROSS.into_iter().zip(values) {
        row[place] = value;
    }
    row
}

fn add_along(square: &mut Square, values: [[f64; 2]; 2], factor: f64) {
    for (row, values) in ALONG.into_iter().zip(values) {
        for (column, value) in ALONG.into_iter().zip(values) {
            square[row][column] += factor * value;
        }
    }
}

fn add_across(square: &mut Square, values: [[f64; 4]; 4], factor: f64) {
    for (row, values) in ACROSS.into_iter().zip(values) {
        for (column, value) in ACROSS.into_iter().zip(values) {
            square[row][column] += factor * value;
        }
    }
}
