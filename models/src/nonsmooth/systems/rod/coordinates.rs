//! Which nodal values are coordinates, and how all nodal values follow from the coordinates.

use nalgebra::DMatrix;

use super::Reference;

/// Nodal values of a node: `u`, `w`, `w'`.
pub const PER_NODE: usize = 3;

/// The nodal values that are not tied to the frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Free {
    /// For every nodal value its number among the free ones.
    places: Vec<Option<usize>>,
    /// The nodal value of every free number.
    values: Vec<usize>,
}

impl Free {
    /// All nodal values: the rod without a reference, which can move as a rigid body in its frame.
    pub fn all(nodes: usize) -> Self {
        Self::without(nodes, &[])
    }

    /// Those that are free under a reference.
    pub fn of(reference: Reference, nodes: usize) -> Self {
        let end_across = PER_NODE * (nodes - 1) + 1;
        match reference {
            Reference::Tangential => Self::without(nodes, &[0, 1, 2]),
            Reference::Pinned => Self::without(nodes, &[0, 1, end_across]),
        }
    }

    fn without(nodes: usize, tied: &[usize]) -> Self {
        let mut places = vec![None; PER_NODE * nodes];
        let values: Vec<usize> = (0..places.len())
            .filter(|value| !tied.contains(value))
            .collect();
        for (number, &value) in values.iter().enumerate() {
            places[value] = Some(number);
        }
        Self { places, values }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.values.len()
    }

    /// Nodal values, free and tied.
    pub fn nodal(&self) -> usize {
        self.places.len()
    }

    /// Number of a nodal value among the free ones; `None` if it is tied.
    pub fn place(&self, value: usize) -> Option<usize> {
        self.places[value]
    }

    /// The nodal values that are free.
    pub fn values(&self) -> &[usize] {
        &self.values
    }
}

/// Coordinates of a rod: its free nodal values, or amplitudes of modes of them, `q_f = Phi q_m` (S2 186).
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinates {
    /// The free nodal values.
    pub free: Free,
    /// `Phi`, a column for every mode; `None` if the free nodal values are the coordinates.
    pub modes: Option<DMatrix<f64>>,
}

impl Coordinates {
    /// How many there are.
    pub fn count(&self) -> usize {
        match &self.modes {
            Some(modes) => modes.ncols(),
            None => self.free.count(),
        }
    }

    /// A linear form of the nodal values, given by its non-zero entries, as one of the coordinates.
    pub fn form(&self, entries: &[(usize, f64)]) -> Vec<f64> {
        let mut form = vec![0.0; self.count()];
        for &(value, factor) in entries {
            let Some(place) = self.free.place(value) else {
                continue;
            };
            match &self.modes {
                Some(modes) => {
                    for (form, share) in form.iter_mut().zip(modes.row(place).iter()) {
                        *form += factor * share;
                    }
                }
                None => form[place] += factor,
            }
        }
        form
    }

    /// Writes all nodal values.
    pub fn nodal(&self, q: &[f64], nodal: &mut [f64]) {
        for (value, own) in nodal.iter_mut().enumerate() {
            *own = self.nodal_value(q, value);
        }
    }

    /// One nodal value; 0 where it is tied.
    pub fn nodal_value(&self, q: &[f64], value: usize) -> f64 {
        match (self.free.place(value), &self.modes) {
            (None, _) => 0.0,
            (Some(place), None) => q[place],
            (Some(place), Some(modes)) => {
                let shares = modes.row(place);
                shares.iter().zip(q).map(|(share, q)| share * q).sum()
            }
        }
    }
}
