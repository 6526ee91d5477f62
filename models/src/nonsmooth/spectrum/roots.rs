//! Eigenvalues of amplification matrices.

use nalgebra::linalg::{Schur, balancing::balance_parlett_reinsch};
use nalgebra::{Complex, DMatrix};

/// QR iterations at most; a matrix of this size takes a dozen.
const MOST_ITERATIONS: usize = 1000;

/// All eigenvalues; `None` if they are not finite or the iteration does not end.
pub fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    if matrix.iter().any(|entry| !entry.is_finite()) {
        return None;
    }
    if matrix.is_empty() {
        return Some(Vec::new());
    }
    // Accelerations are larger than coordinates by Omega^2.
    let mut balanced = matrix.clone();
    balance_parlett_reinsch(&mut balanced);
    let schur = Schur::try_new(balanced, f64::EPSILON, MOST_ITERATIONS)?;
    Some(schur.complex_eigenvalues().iter().copied().collect())
}

/// The root with positive imaginary part, the largest if there are several.
///
/// All schemes here have two roots that can vibrate; further ones are real, so that there is one such pair or none.
pub fn principal(roots: &[Complex<f64>]) -> Option<Complex<f64>> {
    let vibrating = roots.iter().filter(|root| root.im > 0.0);
    vibrating
        .max_by(|one, other| one.norm_sqr().total_cmp(&other.norm_sqr()))
        .copied()
}
