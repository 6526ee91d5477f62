//! Square matrices of a few dense rows and columns and a band: those of a rod on moving axes.
//!
//! ```text
//!   | B  R |   B: border x border, dense
//!   | C  A |   R, C: dense; A: a band of `half_bandwidth` diagonals on each side
//! ```
//!
//! A rigid mechanism is all border; a rod has the angles of its axes in the border and its elements in the band, so
//! that a factorisation costs of the order of `n (half_bandwidth^2 + border half_bandwidth)`.

mod band;
mod dense;
mod factors;

pub use dense::{factor as dense_factor, solve as dense_solve};
pub use factors::{Factors, Singular};

/// Size and structure of a matrix.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shape {
    /// Leading rows and columns that are dense.
    pub border: usize,
    /// Rows and columns of the band.
    pub banded: usize,
    /// Diagonals of the band on each side of its main diagonal.
    pub half_bandwidth: usize,
}

impl Shape {
    /// A dense matrix of `n` rows.
    pub const fn dense(n: usize) -> Self {
        Self {
            border: n,
            banded: 0,
            half_bandwidth: 0,
        }
    }

    /// Rows and columns.
    pub const fn order(&self) -> usize {
        self.border + self.banded
    }

    /// Structure of `stages` x `stages` blocks of this structure, with the stages of a row side by side.
    pub const fn staged(&self, stages: usize) -> Self {
        Self {
            border: stages * self.border,
            banded: stages * self.banded,
            half_bandwidth: stages * (self.half_bandwidth + 1) - 1,
        }
    }

    /// Diagonals of the band.
    const fn bandwidth(&self) -> usize {
        2 * self.half_bandwidth + 1
    }
}

/// A matrix of [`Shape`].
#[derive(Debug, Clone, PartialEq)]
pub struct BorderedBand {
    shape: Shape,
    /// The leading rows, `border` of `order` numbers.
    top: Vec<f64>,
    /// What the other rows have in the leading columns, `banded` rows of `border` numbers.
    left: Vec<f64>,
    /// The band, `banded` rows of `bandwidth` numbers: column `j` of row `i` at `j - i + half_bandwidth`.
    band: Vec<f64>,
}

impl BorderedBand {
    /// Zeros.
    pub fn zeros(shape: Shape) -> Self {
        Self {
            shape,
            top: vec![0.0; shape.border * shape.order()],
            left: vec![0.0; shape.banded * shape.border],
            band: vec![0.0; shape.banded * shape.bandwidth()],
        }
    }

    /// Its structure.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// All numbers become 0.
    pub fn clear(&mut self) {
        self.top.fill(0.0);
        self.left.fill(0.0);
        self.band.fill(0.0);
    }

    /// Adds to an entry.
    ///
    /// # Panics
    /// If the entry is outside of the structure.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        *self.entry(row, column) += value;
    }

    /// Adds to an entry and to the one across the diagonal, once if they are the same.
    ///
    /// # Panics
    /// As [`BorderedBand::add`].
    pub fn add_symmetric(&mut self, row: usize, column: usize, value: f64) {
        self.add(row, column, value);
        if row != column {
            self.add(column, row, value);
        }
    }

    /// An entry; 0 outside of the structure.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        let Shape {
            border,
            half_bandwidth,
            ..
        } = self.shape;
        if row < border {
            return self.top[row * self.shape.order() + column];
        }
        let row = row - border;
        if column < border {
            return self.left[row * border + column];
        }
        let place = column - border + half_bandwidth;
        match place.checked_sub(row) {
            Some(offset) if offset < self.shape.bandwidth() => {
                self.band[row * self.shape.bandwidth() + offset]
            }
            _ => 0.0,
        }
    }

    fn entry(&mut self, row: usize, column: usize) -> &mut f64 {
        let Shape {
            border,
            half_bandwidth,
            ..
        } = self.shape;
        if row < border {
            return &mut self.top[row * self.shape.order() + column];
        }
        let row = row - border;
        if column < border {
            return &mut self.left[row * border + column];
        }
        let offset = column - border + half_bandwidth - row;
        assert!(offset < self.shape.bandwidth(), "entry outside of the band");
        &mut self.band[row * self.shape.bandwidth() + offset]
    }

    /// Columns of a row of the band block, counted from its start, that are in the structure.
    fn band_columns(&self, row: usize) -> std::ops::Range<usize> {
        let w = self.shape.half_bandwidth;
        row.saturating_sub(w)..(row + w + 1).min(self.shape.banded)
    }

    /// A row times `x`.
    pub fn row_times(&self, row: usize, x: &[f64]) -> f64 {
        let Shape { border, .. } = self.shape;
        if row < border {
            let order = self.shape.order();
            return dot(&self.top[row * order..][..order], x);
        }
        let row = row - border;
        let (head, tail) = x.split_at(border);
        let columns = self.band_columns(row);
        let left = &self.left[row * border..][..border];
        let start = row * self.shape.bandwidth() + self.shape.half_bandwidth + columns.start - row;
        let band = &self.band[start..][..columns.len()];
        dot(left, head) + dot(band, &tail[columns])
    }

    /// `y += factor A x`.
    pub fn multiply_add(&self, factor: f64, x: &[f64], y: &mut [f64]) {
        for (row, y) in y.iter_mut().enumerate() {
            *y += factor * self.row_times(row, x);
        }
    }

    /// Adds `factor` times a matrix of the same structure.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        add_scaled(factor, &other.top, &mut self.top);
        add_scaled(factor, &other.left, &mut self.left);
        add_scaled(factor, &other.band, &mut self.band);
    }

    /// Adds a matrix without a border to the band.
    ///
    /// # Panics
    /// If it has a border, or not the size and bandwidth of the band.
    pub fn add_band(&mut self, other: &Self) {
        let own = Shape {
            border: 0,
            ..self.shape
        };
        assert_eq!(own, other.shape, "structure of the band");
        add_scaled(1.0, &other.band, &mut self.band);
    }

    /// Adds `factor` times `other` to the block of these stages of a matrix of [`Shape::staged`].
    pub fn add_stage(
        &mut self,
        stages: usize,
        [row, column]: [usize; 2],
        factor: f64,
        other: &Self,
    ) {
        if stages == 1 {
            self.add_scaled(factor, other);
            return;
        }
        let (own, given) = (self.shape, other.shape);
        // Row by row: the numbers of `other` stand `stages` places apart here.
        let add = |values: &[f64], to: &mut [f64]| {
            for (to, value) in to.iter_mut().step_by(stages).zip(values) {
                *to += factor * value;
            }
        };
        for (i, values) in other.top.chunks_exact(given.order().max(1)).enumerate() {
            let start = (stages * i + row) * own.order() + column;
            add(values, &mut self.top[start..]);
        }
        for i in 0..given.banded {
            let staged_row = stages * i + row;
            let values = &other.left[i * given.border..][..given.border];
            let start = staged_row * own.border + column;
            add(values, self.left.get_mut(start..).unwrap_or_default());

            let columns = other.band_columns(i);
            let values =
                &other.band[i * given.bandwidth() + columns.start + given.half_bandwidth - i..];
            let offset = stages * columns.start + column + own.half_bandwidth - staged_row;
            let start = staged_row * own.bandwidth() + offset;
            add(&values[..columns.len()], &mut self.band[start..]);
        }
    }
}

/// `a . b`.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `y += factor x`.
pub fn add_scaled(factor: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}
