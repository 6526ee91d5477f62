//! Eigenvalues of a matrix whose rows have different units.

use faer::Mat;

use super::ProbeError;

/// Rows and columns are balanced when a further scaling would shrink their sum by less than this factor.
const BALANCED: f64 = 0.95;

/// Largest absolute value of the eigenvalues.
///
/// # Errors
/// [`ProbeError::NoConvergence`] if the eigenvalues cannot be computed.
pub fn spectral_radius(matrix: &Mat<f64>) -> Result<f64, ProbeError> {
    let size = matrix.nrows();
    let eigenvalues = balanced(matrix)
        .eigenvalues()
        .map_err(|_| ProbeError::NoConvergence { size })?;
    Ok(eigenvalues
        .iter()
        .map(|value| value.re.hypot(value.im))
        .fold(0.0, f64::max))
}

/// `D^-1 A D` with a diagonal `D` of powers of two that makes the sums of each row and its column alike (Parlett &
/// Reinsch 1969). The eigenvalues stay, without any rounding. Positions, velocities and multipliers differ by many
/// decades; without balancing, the rounding of the largest entries would hide how far the radius is from 1.
pub fn balanced(matrix: &Mat<f64>) -> Mat<f64> {
    let mut balanced = matrix.clone();
    let size = balanced.nrows();
    let mut is_done = false;
    while !is_done {
        is_done = true;
        for place in 0..size {
            let others = || (0..size).filter(|&other| other != place);
            let column: f64 = others().map(|row| balanced[(row, place)].abs()).sum();
            let row: f64 = others().map(|column| balanced[(place, column)].abs()).sum();
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let factor = (row / column).log2().div_euclid(2.0).exp2();
            let sum = column * factor + row / factor;
            // Sums beyond the range of numbers end the loop.
            if sum.is_nan() || sum >= BALANCED * (column + row) {
                continue;
            }
            is_done = false;
            for other in 0..size {
                balanced[(other, place)] *= factor;
                balanced[(place, other)] /= factor;
            }
        }
    }
    balanced
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rotation by 0.3 rad with damping 0.999999, in units that differ by 14 decades, coupled to a small third value.
    #[test]
    fn badly_scaled_rows_lose_no_digits() {
        let (damping, scale) = (0.999_999, 1e14);
        let (sin, cos) = 0.3_f64.sin_cos();
        let matrix = faer::mat![
            [damping * cos, -damping * sin / scale, 0.0],
            [damping * sin * scale, damping * cos, 0.0],
            [1e9, 3.0, -0.5],
        ];
        let radius = spectral_radius(&matrix).unwrap();
        assert!((radius - damping).abs() < 1e-14, "{radius}");
    }

    #[test]
    fn a_nilpotent_matrix_has_radius_zero() {
        let matrix = faer::mat![[0.0, 1e200], [0.0, 0.0]];
        assert_eq!(spectral_radius(&matrix).unwrap(), 0.0);
    }
}
