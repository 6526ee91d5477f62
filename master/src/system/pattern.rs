//! Which entries of the coupling Jacobian may differ from 0.

use std::ops::Range;

/// The entries of a square sparse matrix, column by column, and for each term of the assembly the entry that it adds to.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    size: usize,
    columns: Vec<usize>,
    rows: Vec<usize>,
    starts: Vec<usize>,
    slots: Vec<usize>,
}

impl Pattern {
    /// The pattern of a matrix with `size` rows from row and column of all its terms. `visit_all` calls what it is given
    /// for each term, in an order that is always the same.
    pub fn new(size: usize, visit_all: impl Fn(&mut dyn FnMut(usize, usize))) -> Self {
        let mut terms = Vec::new();
        visit_all(&mut |row, column| terms.push((column, row)));
        let mut entries = terms.clone();
        entries.sort_unstable();
        entries.dedup();
        let entry_of = |term: &(usize, usize)| entries.partition_point(|entry| entry < term);
        let starts = (0..=size).map(|column| entries.partition_point(|entry| entry.0 < column));
        Self {
            size,
            slots: terms.iter().map(entry_of).collect(),
            starts: starts.collect(),
            columns: entries.iter().map(|entry| entry.0).collect(),
            rows: entries.iter().map(|entry| entry.1).collect(),
        }
    }

    /// Number of rows and columns.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Number of entries.
    pub fn entries(&self) -> usize {
        self.rows.len()
    }

    /// Row of every entry.
    pub fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// Column of every entry.
    pub fn columns(&self) -> &[usize] {
        &self.columns
    }

    /// First entry of every column, and the number of all entries.
    pub fn starts(&self) -> &[usize] {
        &self.starts
    }

    /// The entries of one column.
    pub fn entries_of(&self, column: usize) -> Range<usize> {
        self.starts[column]..self.starts[column + 1]
    }

    /// The entry that a term of the assembly adds to.
    pub fn entry(&self, slot: usize) -> usize {
        self.slots[slot]
    }

    /// Writes the product with `x` to `product`; `values` are those of the entries.
    pub fn multiply(&self, values: &[f64], x: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        for (entry, value) in values.iter().enumerate() {
            product[self.rows[entry]] += value * x[self.columns[entry]];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_at_one_place_share_an_entry() {
        let terms = [(2, 0), (0, 1), (2, 0), (1, 1), (0, 0)];
        let pattern = Pattern::new(3, |visit| terms.iter().for_each(|&(r, c)| visit(r, c)));
        assert_eq!(pattern.rows(), [0, 2, 0, 1]);
        assert_eq!(pattern.columns(), [0, 0, 1, 1]);
        assert_eq!(pattern.starts(), [0, 2, 4, 4]);
        let slots: Vec<_> = (0..terms.len()).map(|slot| pattern.entry(slot)).collect();
        assert_eq!(slots, [1, 2, 1, 3, 0]);
        let mut product = [9.0; 3];
        pattern.multiply(&[2.0, -1.0, 3.0, 0.5], &[10.0, 4.0, 7.0], &mut product);
        assert_eq!(product, [32.0, 2.0, -10.0]);
    }
}
