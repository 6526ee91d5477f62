//! Modes of vibration (S2 App. D): `(K - omega^2 M) phi = 0` (184).

use nalgebra::{DMatrix, SymmetricEigen};

use super::RodError;

/// Sweeps over a row at most until its eigenvalue is found.
const MOST_SWEEPS: usize = 100;
/// Entries of a mode that differ by less than this share are the same: of a symmetric mode that decides the sign.
const SAME: f64 = 1e-6;

/// Eigenvectors with `Phi^T M Phi = 1`, `Phi^T K Phi = diag(omega_k^2)` (188), from the lowest frequency on.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// A column each; the first of its largest entries is positive.
    pub shapes: DMatrix<f64>,
    /// `omega_k` (rad/s).
    pub angular_frequencies: Vec<f64>,
}

/// The lowest `count` modes of a stiffness and a mass matrix, both symmetric, the mass positive definite.
///
/// With `M = L L^T` they are those of `L^-1 K L^-T`, a symmetric eigenproblem. Frequencies are Rayleigh quotients of
/// the modes: what rounding of the largest eigenvalues adds to the smallest ones is not in them.
///
/// # Errors
/// [`RodError::NoModes`].
pub fn lowest(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    count: usize,
) -> Result<Modes, RodError> {
    let n = mass.nrows();
    let factor = mass.clone().cholesky().ok_or(RodError::NoModes)?.l();
    let half = factor
        .solve_lower_triangular(stiffness)
        .ok_or(RodError::NoModes)?;
    let transformed = factor
        .solve_lower_triangular(&half.transpose())
        .ok_or(RodError::NoModes)?;
    let symmetric = (&transformed + transformed.transpose()) * 0.5;
    if !symmetric.iter().all(|entry| entry.is_finite()) {
        return Err(RodError::NoModes);
    }
    let solved = SymmetricEigen::try_new(symmetric, f64::EPSILON, MOST_SWEEPS * n)
        .ok_or(RodError::NoModes)?;
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&i, &j| solved.eigenvalues[i].total_cmp(&solved.eigenvalues[j]));
    let chosen = solved.eigenvectors.select_columns(&order[..count]);
    let mut shapes = factor
        .tr_solve_lower_triangular(&chosen)
        .ok_or(RodError::NoModes)?;
    let mut angular_frequencies = Vec::with_capacity(count);
    for mut shape in shapes.column_iter_mut() {
        let inertia = shape.dot(&(mass * &shape));
        let square = shape.dot(&(stiffness * &shape)) / inertia;
        if !(square > 0.0 && inertia > 0.0) {
            return Err(RodError::NoModes);
        }
        angular_frequencies.push(square.sqrt());
        let largest = shape.amax();
        let leading = shape
            .iter()
            .find(|entry| entry.abs() >= (1.0 - SAME) * largest);
        let sign = leading.map_or(1.0, |entry| entry.signum());
        shape *= sign / inertia.sqrt();
    }
    Ok(Modes {
        shapes,
        angular_frequencies,
    })
}
