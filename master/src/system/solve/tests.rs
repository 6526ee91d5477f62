use proptest::prelude::*;

use super::*;

/// A matrix by its entries that are not 0: row, column, value.
struct Matrix {
    pattern: Pattern,
    values: Vec<f64>,
}

impl Matrix {
    fn new(size: usize, entries: &[(usize, usize, f64)]) -> Self {
        let pattern = Pattern::new(size, |visit| {
            entries
                .iter()
                .for_each(|&(row, column, _)| visit(row, column));
        });
        let mut values = vec![0.0; pattern.entries()];
        for (slot, (_, _, value)) in entries.iter().enumerate() {
            values[pattern.entry(slot)] += value;
        }
        Self { pattern, values }
    }

    fn full<const N: usize>(rows: [[f64; N]; N]) -> Self {
        let places = (0..N * N).map(|place| (place / N, place % N));
        let entries: Vec<_> = places.map(|(i, j)| (i, j, rows[i][j])).collect();
        Self::new(N, &entries)
    }

    fn size(&self) -> usize {
        self.pattern.size()
    }

    fn solvers(&self) -> [LinearSolver; 2] {
        [
            LinearSolver::dense(&self.pattern),
            LinearSolver::sparse(&self.pattern),
        ]
    }

    fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        self.pattern.multiply(&self.values, x, &mut product);
        product
    }

    fn solve(&self, solver: &mut LinearSolver, rhs: &[f64]) -> Result<Vec<f64>, SingularColumn> {
        let mut x = rhs.to_vec();
        solver.solve(&self.pattern, &self.values, &mut x)?;
        Ok(x)
    }

    /// Both eliminations find `x` from the product with it up to `tolerance`, relative to the largest component.
    fn assert_solved(&self, x: &[f64], tolerance: f64) {
        let largest = x
            .iter()
            .fold(0.0, |largest: f64, value| largest.max(value.abs()));
        for mut solver in self.solvers() {
            let found = self.solve(&mut solver, &self.times(x)).unwrap();
            for (found, x) in found.iter().zip(x) {
                assert!((found - x).abs() <= tolerance * largest, "{found} {x}");
            }
        }
    }
}

/// `G = dg''/dlambda` of the hinges between the links of a free chain with the given angles: the acceleration of an end
/// of a link under a force there is `(1 / m + (l^2 / 4 J) t t^T) f`, that of the other end has the opposite sign in the
/// second term, with `t` across the link.
fn chain(angles: &[f64]) -> Matrix {
    let (mass, arm) = (1.3, 0.7_f64.powi(2) / (4.0 * 0.06));
    let mut entries = Vec::new();
    for (link, angle) in angles.iter().enumerate() {
        let across = [-angle.sin(), angle.cos()];
        // Hinges at the start and the end of the link, as far as there are any.
        let hinges = [
            link.checked_sub(1),
            (link + 1 < angles.len()).then_some(link),
        ];
        for (hinge, partner) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let (Some(row), Some(column)) = (hinges[hinge], hinges[partner]) else {
                continue;
            };
            let sign = if hinge == partner { 1.0 } else { -1.0 };
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let diagonal = if i == j { 1.0 / mass } else { 0.0 };
                let own = diagonal + sign * arm * across[i] * across[j];
                entries.push((2 * row + i, 2 * column + j, sign * own));
            }
        }
    }
    Matrix::new(2 * (angles.len() - 1), &entries)
}

fn awkward(count: usize) -> Vec<f64> {
    let angle = |link: usize| -1.2 + 0.9 * (1.7 * link as f64).sin();
    (0..count).map(angle).collect()
}

#[test]
fn solves_a_system_that_needs_pivoting() {
    let matrix = Matrix::full([[0.0, 2.0, 1.0], [1e-3, -1.0, 0.5], [4.0, 0.0, 3.0]]);
    matrix.assert_solved(&[0.3, -2.0, 7.0], 1e-14);
}

#[test]
fn jacobians_of_chains_are_solved() {
    for links in [2, 3, 8, 64, 200] {
        let matrix = chain(&awkward(links));
        matrix.assert_solved(&awkward(matrix.size()), 1e-10);
    }
}

#[test]
fn a_redundant_column_is_named() {
    let redundant = Matrix::full([[1.0, 2.0], [2.0, 4.0]]);
    let [mut dense, mut sparse] = redundant.solvers();
    let rhs = [1.0, 2.0];
    assert_eq!(redundant.solve(&mut dense, &rhs), Err(SingularColumn(1)));
    assert!(redundant.solve(&mut sparse, &rhs).is_err());
    let empty = Matrix::full([[0.0]]);
    for mut solver in empty.solvers() {
        assert_eq!(empty.solve(&mut solver, &[1.0]), Err(SingularColumn(0)));
    }
}

/// A second hinge between the same two links: the columns of both depend on each other, and no others do.
#[test]
fn a_redundant_hinge_of_a_long_chain_is_named() {
    let chain = chain(&awkward(40));
    let hinge = 11;
    let twin = |index: usize| (index / 2 == hinge).then_some(chain.size() + index % 2);
    let places = chain.pattern.rows().iter().zip(chain.pattern.columns());
    let mut entries = Vec::new();
    for ((&row, &column), &value) in places.zip(&chain.values) {
        for row in [Some(row), twin(row)].into_iter().flatten() {
            for column in [Some(column), twin(column)].into_iter().flatten() {
                entries.push((row, column, value));
            }
        }
    }
    let size = chain.size() + 2;
    let doubled = Matrix::new(size, &entries);
    for mut solver in doubled.solvers() {
        let SingularColumn(column) = doubled.solve(&mut solver, &awkward(size)).unwrap_err();
        assert!(column / 2 == hinge || column >= chain.size(), "{column}");
    }
}

/// A variable that appears in no condition, among many that do.
#[test]
fn an_empty_column_and_a_column_of_zeros_are_named() {
    let chain = chain(&awkward(30));
    let lost = 17;
    let places = chain.pattern.rows().iter().zip(chain.pattern.columns());
    let entries = places.zip(&chain.values);
    let all: Vec<_> = entries.map(|((&i, &j), &value)| (i, j, value)).collect();
    let kept: Vec<_> = all
        .iter()
        .copied()
        .filter(|entry| entry.1 != lost)
        .collect();
    let zeroed = |&(i, j, value): &(usize, usize, f64)| (i, j, if j == lost { 0.0 } else { value });
    let zeroed: Vec<_> = all.iter().map(zeroed).collect();
    for entries in [kept, zeroed] {
        let matrix = Matrix::new(chain.size(), &entries);
        for mut solver in matrix.solvers() {
            let found = matrix.solve(&mut solver, &awkward(chain.size()));
            assert_eq!(found, Err(SingularColumn(lost)));
        }
    }
}

#[test]
fn what_is_not_a_number_is_refused() {
    let mut chain = chain(&awkward(20));
    chain.values[40] = f64::NAN;
    let rhs = awkward(chain.size());
    for mut solver in chain.solvers() {
        assert!(chain.solve(&mut solver, &rhs).is_err());
    }
}

/// The kept memory carries nothing over, neither from other numbers nor from a failure.
#[test]
fn equal_numbers_give_equal_bits() {
    let (one, other) = (chain(&awkward(33)), chain(&vec![0.4; 33]));
    let rhs = awkward(one.size());
    for mut solver in one.solvers() {
        let first = one.solve(&mut solver, &rhs).unwrap();
        other.solve(&mut solver, &rhs).unwrap();
        let zeros = vec![0.0; one.pattern.entries()];
        assert!(
            solver
                .solve(&one.pattern, &zeros, &mut rhs.clone())
                .is_err()
        );
        assert_eq!(one.solve(&mut solver, &rhs).unwrap(), first);
    }
    let fresh = || {
        one.solvers()
            .map(|mut solver| one.solve(&mut solver, &rhs).unwrap())
    };
    assert_eq!(fresh(), fresh());
}

#[test]
fn long_chains_are_sparse_and_full_systems_dense() {
    let is_sparse = |matrix: &Matrix| LinearSolver::new(&matrix.pattern).is_sparse();
    assert!(!is_sparse(&chain(&awkward(3))));
    assert!(is_sparse(&chain(&awkward(64))));
    let full = |row: usize| (0..126).map(move |column| (row, column, 1.0));
    let full: Vec<_> = (0..126).flat_map(full).collect();
    assert!(!is_sparse(&Matrix::new(126, &full)));
    let empty_column: Vec<_> = (0..126).map(|row| (row, 0, 1.0)).collect();
    assert!(!is_sparse(&Matrix::new(126, &empty_column)));
}

/// Random places off the diagonal; the diagonal outweighs its row, and the rows are then turned around.
fn well_conditioned() -> impl Strategy<Value = (Vec<(usize, usize, f64)>, Vec<f64>)> {
    (1_usize..60).prop_flat_map(|size| {
        let entry = (0..size, 0..size, -1.0..1.0);
        let entries = prop::collection::vec(entry, 0..4 * size);
        let turn = 0..size;
        let x = prop::collection::vec(-1e3..1e3, size);
        (entries, turn, x).prop_map(move |(mut entries, turn, x)| {
            let mut sums = vec![1.0; size];
            entries
                .iter()
                .for_each(|&(row, _, value): &(_, _, f64)| sums[row] += value.abs());
            entries.extend((0..size).map(|row| (row, row, 2.0 * sums[row])));
            entries
                .iter_mut()
                .for_each(|entry| entry.0 = (entry.0 + turn) % size);
            (entries, x)
        })
    })
}

proptest! {
    #[test]
    fn well_conditioned_systems_are_solved((entries, x) in well_conditioned()) {
        Matrix::new(x.len(), &entries).assert_solved(&x, 1e-12);
    }
}
