//! Small dense systems, in place.

use super::Singular;

/// Factors `P A = L U` of a dense matrix with row exchanges (Golub & Van Loan, Alg. 3.4.1); `a` is overwritten.
pub fn factor(n: usize, a: &mut [f64], pivots: &mut [usize]) -> Result<(), Singular> {
    for column in 0..n {
        let pivot = (column..n)
            .max_by(|&i, &j| a[i * n + column].abs().total_cmp(&a[j * n + column].abs()))
            .unwrap_or(column);
        pivots[column] = pivot;
        if pivot != column {
            for j in 0..n {
                a.swap(column * n + j, pivot * n + j);
            }
        }
        let diagonal = a[column * n + column];
        if diagonal == 0.0 || !diagonal.is_finite() {
            return Err(Singular { row: column });
        }
        for i in column + 1..n {
            let factor = a[i * n + column] / diagonal;
            a[i * n + column] = factor;
            if factor != 0.0 {
                for j in column + 1..n {
                    a[i * n + j] -= factor * a[column * n + j];
                }
            }
        }
    }
    Ok(())
}

/// Solves with the factors of [`factor`]; `b` becomes the solution.
pub fn solve(n: usize, a: &[f64], pivots: &[usize], b: &mut [f64]) {
    for (row, &pivot) in pivots.iter().enumerate() {
        b.swap(row, pivot);
    }
    for i in 1..n {
        let (done, rest) = b.split_at_mut(i);
        rest[0] -= super::dot(&a[i * n..][..i], done);
    }
    for i in (0..n).rev() {
        let (head, done) = b.split_at_mut(i + 1);
        head[i] = (head[i] - super::dot(&a[i * n + i + 1..][..n - i - 1], done)) / a[i * n + i];
    }
}
