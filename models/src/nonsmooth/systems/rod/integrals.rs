//! Inertia shape integrals and stiffness of a rod (S2 Sect. C.3, C.5): all that its motion depends on.

use nalgebra::DMatrix;

use super::Rod;
use super::coordinates::{Free, PER_NODE};
use super::element::{Element, Row, Square, VALUES};
use crate::nonsmooth::matrix::{BorderedBand, Shape, dot};

/// Diagonals on each side of the main one that elements fill in `S_ff` and `K_ff`, where displacements along and across
/// do not meet: from `w` of one node to `w'` of the next.
const HALF_BANDWIDTH: usize = 4;
/// The same in `S_tilde`: from `u` of one node to `w'` of the next.
const HALF_BANDWIDTH_SKEW: usize = 5;

/// The integrals over a rod, and over point masses on it, in its coordinates `q`.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeIntegrals {
    /// Mass (kg), S2 (129).
    pub mass: f64,
    /// `I_1` (131), the moment of mass without deformation (kg m).
    pub first_moment: [f64; 2],
    /// `I_2` (134), the second moment of mass without deformation (kg m^2).
    pub second_moment: f64,
    /// `I_3` (135): `u_0^T S`.
    pub stretch: Vec<f64>,
    /// `I_4` (140): `u_0^T I_tilde S`.
    pub turn: Vec<f64>,
    /// `S_bar` (131): `S`, two rows.
    pub mean: [Vec<f64>; 2],
    /// `S_ff` (138): `S^T S`.
    pub elastic: BorderedBand,
    /// `S_tilde` (140): `S^T I_tilde S`, skew.
    pub skew: BorderedBand,
    /// `K_ff` (160).
    pub stiffness: BorderedBand,
}

impl ShapeIntegrals {
    /// Those of a rod, in its free nodal values.
    pub fn of(rod: &Rod, free: &Free) -> Self {
        let element = Element::of(rod);
        let n = free.count();
        let zeros = |half_bandwidth: usize| banded(n, half_bandwidth.min(n.saturating_sub(1)));
        let mut integrals = Self {
            mass: rod.mass(),
            first_moment: [0.5 * rod.mass() * rod.length, 0.0],
            second_moment: rod.mass() * rod.length * rod.length / 3.0
                + element.rotary * rod.elements as f64,
            stretch: vec![0.0; n],
            turn: vec![0.0; n],
            mean: [vec![0.0; n], vec![0.0; n]],
            elastic: zeros(HALF_BANDWIDTH),
            skew: zeros(HALF_BANDWIDTH_SKEW),
            stiffness: zeros(HALF_BANDWIDTH),
        };
        for number in 0..rod.elements {
            let places = std::array::from_fn(|k| free.place(PER_NODE * number + k));
            integrals.add_element(&element, number as f64 * element.length, places);
        }
        integrals
    }

    /// Coordinates.
    pub fn count(&self) -> usize {
        self.stretch.len()
    }

    fn add_element(&mut self, element: &Element, start: f64, places: [Option<usize>; VALUES]) {
        let [along, across] = &element.mean;
        let [weighted_along, weighted_across] = &element.weighted;
        let shifted = |weighted: &Row, mean: &Row| -> Row {
            std::array::from_fn(|k| weighted[k] + start * mean[k])
        };
        let mut turn = shifted(weighted_across, across);
        for (turn, tilt) in turn.iter_mut().zip(element.tilt) {
            *turn += tilt;
        }
        add_row(&mut self.stretch, &shifted(weighted_along, along), places);
        add_row(&mut self.turn, &turn, places);
        for (mean, own) in self.mean.iter_mut().zip(&element.mean) {
            add_row(mean, own, places);
        }
        add_square(&mut self.elastic, &element.elastic, places);
        add_square(&mut self.skew, &element.skew, places);
        add_square(&mut self.stiffness, &element.stiffness, places);
    }

    /// Adds a point mass (kg) that is at `(x, 0)` without deformation and moves by `(along . q, across . q)`.
    ///
    /// # Panics
    /// If the two rows have entries that are further apart than an element's.
    pub fn add_point_mass(&mut self, mass: f64, x: f64, [along, across]: [&[f64]; 2]) {
        self.mass += mass;
        self.first_moment[0] += mass * x;
        self.second_moment += mass * x * x;
        let moved: Vec<usize> = (0..self.count())
            .filter(|&i| along[i] != 0.0 || across[i] != 0.0)
            .collect();
        for &i in &moved {
            self.stretch[i] += mass * x * along[i];
            self.turn[i] += mass * x * across[i];
            self.mean[0][i] += mass * along[i];
            self.mean[1][i] += mass * across[i];
            for &j in &moved {
                let product = along[i] * along[j] + across[i] * across[j];
                self.elastic.add(i, j, mass * product);
                let skew = along[i] * across[j] - across[i] * along[j];
                self.skew.add(i, j, mass * skew);
            }
        }
    }

    /// The integrals in amplitudes of `modes` (S2 187), which make `S_ff` and `K_ff` diagonal (188).
    pub fn reduced(&self, modes: &DMatrix<f64>) -> Self {
        let row = |form: &[f64]| -> Vec<f64> {
            let columns = modes.column_iter();
            columns.map(|mode| dot(form, mode.as_slice())).collect()
        };
        let n = modes.ncols();
        Self {
            mass: self.mass,
            first_moment: self.first_moment,
            second_moment: self.second_moment,
            stretch: row(&self.stretch),
            turn: row(&self.turn),
            mean: [row(&self.mean[0]), row(&self.mean[1])],
            elastic: band_of(&congruent(&self.elastic, modes), 0),
            skew: band_of(&congruent(&self.skew, modes), n - 1),
            stiffness: band_of(&congruent(&self.stiffness, modes), 0),
        }
    }

    /// `I_1 + S_bar q` (130): the moment of mass (kg m).
    pub fn moment_of_mass(&self, q: &[f64]) -> [f64; 2] {
        let [along, across] = &self.mean;
        let [x, y] = self.first_moment;
        [x + dot(along, q), y + dot(across, q)]
    }

    /// `S_bar q'`: its rate in the frame.
    pub fn momentum(&self, v: &[f64]) -> [f64; 2] {
        [dot(&self.mean[0], v), dot(&self.mean[1], v)]
    }

    /// `2 I_3 q + q^T S_ff q` (135, 136): how deformation changes the second moment of mass (kg m^2).
    pub fn second_moment_change(&self, q: &[f64]) -> f64 {
        2.0 * dot(&self.stretch, q) + product(&self.elastic, q, q)
    }
}

/// Zeros with a band only.
fn banded(n: usize, half_bandwidth: usize) -> BorderedBand {
    BorderedBand::zeros(Shape {
        border: 0,
        banded: n,
        half_bandwidth,
    })
}

fn add_row(row: &mut [f64], own: &Row, places: [Option<usize>; VALUES]) {
    for (place, value) in places.into_iter().zip(own) {
        if let Some(place) = place {
            row[place] += value;
        }
    }
}

fn add_square(square: &mut BorderedBand, own: &Square, places: [Option<usize>; VALUES]) {
    for (row, own) in places.into_iter().zip(own) {
        for (column, &value) in places.into_iter().zip(own) {
            match (row, column) {
                (Some(row), Some(column)) if value != 0.0 => square.add(row, column, value),
                _ => {}
            }
        }
    }
}

/// `a^T A b`.
pub fn product(matrix: &BorderedBand, a: &[f64], b: &[f64]) -> f64 {
    let rows = a.iter().enumerate();
    rows.map(|(row, a)| a * matrix.row_times(row, b)).sum()
}

/// The same numbers in a dense matrix.
pub fn dense(matrix: &BorderedBand) -> DMatrix<f64> {
    let n = matrix.shape().order();
    DMatrix::from_fn(n, n, |row, column| matrix.get(row, column))
}

/// `Phi^T A Phi`.
pub fn congruent(matrix: &BorderedBand, modes: &DMatrix<f64>) -> DMatrix<f64> {
    let mut images = DMatrix::zeros(modes.nrows(), modes.ncols());
    for (mode, mut image) in modes.column_iter().zip(images.column_iter_mut()) {
        matrix.multiply_add(1.0, mode.as_slice(), image.as_mut_slice());
    }
    modes.transpose() * images
}

/// The diagonals next to the main one; others are left out.
fn band_of(dense: &DMatrix<f64>, half_bandwidth: usize) -> BorderedBand {
    let n = dense.nrows();
    let mut band = banded(n, half_bandwidth);
    for row in 0..n {
        for column in row.saturating_sub(half_bandwidth)..(row + half_bandwidth + 1).min(n) {
            band.add(row, column, dense[(row, column)]);
        }
    }
    band
}
