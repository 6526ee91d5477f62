//! Sparse elimination.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::{Perm, PermRef};
use faer::sparse::linalg::lu::simplicial::{
    SimplicialLu, factorize_simplicial_numeric_lu, factorize_simplicial_numeric_lu_scratch,
    solve_in_place_scratch,
};
use faer::sparse::linalg::{LuError, colamd};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, Mat, Par};

use super::pivot::{SingularColumn, share};
use crate::system::pattern::Pattern;

/// LU decomposition column by column (Gilbert and Peierls). The order of the columns follows from the pattern alone
/// (COLAMD); the pivot rows follow from the numbers. The factors keep their memory, which grows only when the pivots demand more
/// fill than ever before.
pub struct Sparse {
    order: Perm<usize>,
    factors: SimplicialLu<usize, f64>,
    pivot_rows: Vec<usize>,
    pivot_places: Vec<usize>,
    rhs: Mat<f64>,
    memory: MemBuffer,
    /// The least pivot of the last factors, as a share of its column.
    pub least_pivot: f64,
}

impl Sparse {
    pub fn new(pattern: &Pattern) -> Self {
        let n = pattern.size();
        let factor = factorize_simplicial_numeric_lu_scratch::<usize, f64>(n, n);
        let solve = solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq);
        Self {
            order: column_order(pattern),
            factors: SimplicialLu::new(),
            pivot_rows: vec![0; n],
            pivot_places: vec![0; n],
            rhs: Mat::zeros(n, 1),
            memory: MemBuffer::new(factor.or(solve)),
            least_pivot: 1.0,
        }
    }

    /// Number of multiplications of one elimination with pivots as they are for numbers without any relation; `None` if
    /// every matrix of this pattern is singular.
    pub fn multiplications(&mut self, pattern: &Pattern) -> Option<usize> {
        self.factorise(pattern, &unrelated(pattern.entries()))
            .ok()?;
        let (lower, upper) = (
            self.factors.l_factor_unsorted(),
            self.factors.u_factor_unsorted(),
        );
        let uses = upper.symbolic().row_idx().iter();
        let ends = upper.symbolic().col_ptr();
        Some(
            uses.take(ends[pattern.size()])
                .map(|&column| lower.symbolic().col_range(column).len())
                .sum(),
        )
    }

    pub fn solve(
        &mut self,
        pattern: &Pattern,
        values: &[f64],
        rhs: &mut [f64],
    ) -> Result<(), SingularColumn> {
        self.factorise(pattern, values)?;
        self.substitute(rhs);
        Ok(())
    }

    /// Solves with the factors at hand.
    pub fn substitute(&mut self, rhs: &mut [f64]) {
        for (row, value) in rhs.iter().enumerate() {
            self.rhs[(row, 0)] = *value;
        }
        self.factors.solve_in_place_with_conj(
            PermRef::new_checked(&self.pivot_rows, &self.pivot_places, rhs.len()),
            self.order.as_ref(),
            Conj::No,
            self.rhs.as_mut(),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
        for (row, value) in rhs.iter_mut().enumerate() {
            *value = self.rhs[(row, 0)];
        }
    }

    fn factorise(&mut self, pattern: &Pattern, values: &[f64]) -> Result<(), SingularColumn> {
        let factorised = factorize_simplicial_numeric_lu(
            &mut self.pivot_rows,
            &mut self.pivot_places,
            &mut self.factors,
            SparseColMatRef::new(places(pattern), values),
            self.order.as_ref(),
            MemStack::new(&mut self.memory),
        );
        let columns = self.order.arrays().0;
        match factorised {
            Ok(()) => {}
            Err(LuError::SymbolicSingular { index }) => return Err(SingularColumn(columns[index])),
            Err(LuError::Generic(_)) => {
                // No memory: the process ends as for any other allocation.
                std::alloc::handle_alloc_error(std::alloc::Layout::for_value(values))
            }
        }
        let upper = self.factors.u_factor_unsorted();
        self.least_pivot = 1.0;
        for (step, &column) in columns.iter().enumerate() {
            // The pivot is the last entry of its column.
            let pivot = upper.val_of_col(step).last().copied().unwrap_or(0.0);
            let own = &values[pattern.entries_of(column)];
            let share = share(pivot, own).ok_or(SingularColumn(column))?;
            self.least_pivot = self.least_pivot.min(share);
        }
        Ok(())
    }
}

fn places(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    let n = pattern.size();
    SymbolicSparseColMatRef::new_checked(n, n, pattern.starts(), None, pattern.rows())
}

/// An order of the columns that keeps the factors sparse whatever the pivots are.
fn column_order(pattern: &Pattern) -> Perm<usize> {
    let n = pattern.size();
    let mut order: Vec<usize> = (0..n).collect();
    let mut inverse = order.clone();
    let scratch = colamd::order_scratch::<usize>(n, n, pattern.entries());
    let ordered = colamd::order(
        &mut order,
        &mut inverse,
        places(pattern),
        colamd::Control::default(),
        MemStack::new(&mut MemBuffer::new(scratch)),
    );
    if ordered.is_err() {
        // Any order is right; this one is the slowest.
        order = (0..n).collect();
        inverse.clone_from(&order);
    }
    Perm::new_checked(order.into(), inverse.into(), n)
}

/// Numbers between -1/2 and 1/2 without any relation (SplitMix64, Steele, Lea and Flood 2014). Multiples of one number would not do: in a
/// regular pattern they make blocks of low rank.
fn unrelated(count: usize) -> Vec<f64> {
    let fraction = |number: u64| {
        let mut z = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (1..=count as u64).map(fraction).collect()
}
