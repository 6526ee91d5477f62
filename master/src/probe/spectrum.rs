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
    let places = entangled(matrix);
    let (balanced, _) = balanced(&submatrix(matrix, &places));
    let size = places.len();
    let eigenvalues = balanced
        .eigenvalues()
        .map_err(|_| ProbeError::NoConvergence { size })?;
    let alone = (0..matrix.nrows()).filter(|place| !places.contains(place));
    Ok(alone
        .map(|place| matrix[(place, place)].abs())
        .chain(eigenvalues.iter().map(|value| value.re.hypot(value.im)))
        .fold(0.0, f64::max))
}

/// The places that are left when those are taken out, one after the other, whose row or column has no entry but that on
/// the diagonal, which then is an eigenvalue. A multiplier that the next step does not remember is such a place; no
/// scaling could balance it.
pub fn entangled(matrix: &Mat<f64>) -> Vec<usize> {
    let mut places: Vec<usize> = (0..matrix.nrows()).collect();
    let is_alone = |places: &[usize], place: usize| {
        let others = || places.iter().filter(|&&other| other != place);
        others().all(|&other| matrix[(place, other)] == 0.0)
            || others().all(|&other| matrix[(other, place)] == 0.0)
    };
    while let Some(alone) = places.iter().position(|&place| is_alone(&places, place)) {
        places.remove(alone);
    }
    places
}

/// Rows and columns of these places.
pub fn submatrix(matrix: &Mat<f64>, places: &[usize]) -> Mat<f64> {
    let size = places.len();
    Mat::from_fn(size, size, |row, column| {
        matrix[(places[row], places[column])]
    })
}

/// `D^-1 A D`, and the diagonal of `D`: powers of two that make the sums of each row and its column alike (Parlett &
/// Reinsch 1969). The eigenvalues stay, without any rounding. Positions, velocities and multipliers differ by many
/// decades; without balancing, the rounding of the largest entries would hide how far the radius is from 1.
pub fn balanced(matrix: &Mat<f64>) -> (Mat<f64>, Vec<f64>) {
    let mut balanced = matrix.clone();
    let size = balanced.nrows();
    let mut scales = vec![1.0; size];
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
            scales[place] *= factor;
            for other in 0..size {
                balanced[(other, place)] *= factor;
                balanced[(place, other)] /= factor;
            }
        }
    }
    (balanced, scales)
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

    /// The third entry is not remembered, so its column is zero, and its row can be of any size.
    #[test]
    fn what_is_not_remembered_hides_nothing() {
        let damping = 0.999_999;
        let (sin, cos) = 0.3_f64.sin_cos();
        let matrix = faer::mat![
            [damping * cos, -damping * sin, 0.0],
            [damping * sin, damping * cos, 0.0],
            [3e15, -7e15, 0.0],
        ];
        assert_eq!(entangled(&matrix), [0, 1]);
        let radius = spectral_radius(&matrix).unwrap();
        assert!((radius - damping).abs() < 1e-14, "{radius}");
    }

    #[test]
    fn a_nilpotent_matrix_has_radius_zero() {
        let matrix = faer::mat![[0.0, 1e200], [0.0, 0.0]];
        assert_eq!(spectral_radius(&matrix).unwrap(), 0.0);
    }
}
