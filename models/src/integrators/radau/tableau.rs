//! Coefficients of the Radau IIA method of order 5 (Hairer & Wanner, Solving ODEs II, Sect. IV.5 and IV.8).

const SQRT_6: f64 = 2.449_489_742_783_178;

/// Nodes c_i.
pub const C: [f64; 3] = [(4.0 - SQRT_6) / 10.0, (4.0 + SQRT_6) / 10.0, 1.0];

/// Weights of the stages at the end of the step: a quadrature of order 5.
pub const B: [f64; 3] = [(16.0 - SQRT_6) / 36.0, (16.0 + SQRT_6) / 36.0, 1.0 / 9.0];

/// Real eigenvalue of the inverse of the coefficient matrix.
pub const GAMMA: f64 = 3.637_834_252_744_496;

/// Real and imaginary part of the complex pair of eigenvalues.
pub const ALPHA: f64 = 2.681_082_873_627_752;
/// See [`ALPHA`].
pub const BETA: f64 = 3.050_430_199_247_410_6;

/// `T^-1 A^-1 T = [gamma 0 0; 0 alpha -beta; 0 beta alpha]`, stages `z = T w`.
pub const T: [[f64; 3]; 3] = [
    [
        0.091_232_394_870_892_94,
        -0.141_255_295_020_954_2,
        -0.030_029_194_105_147_424,
    ],
    [
        0.241_717_932_707_107,
        0.204_129_352_293_799_93,
        0.382_942_112_757_261_9,
    ],
    [0.966_048_182_615_093, 1.0, 0.0],
];

/// Inverse of [`T`].
pub const T_INVERSE: [[f64; 3]; 3] = [
    [
        4.325_579_890_063_155,
        0.339_199_251_815_809_87,
        0.541_770_539_935_874_9,
    ],
    [
        -4.178_718_591_551_905,
        -0.327_682_820_761_062_4,
        0.476_623_554_500_550_45,
    ],
    [
        -0.502_872_634_945_786_9,
        2.571_926_949_855_605,
        -0.596_039_204_828_224_9,
    ],
];

/// Weights of the stages in the error estimate (RADAU5's DD): order 3, filtered by the real matrix of the method.
pub const ERROR: [f64; 3] = [
    -(13.0 + 7.0 * SQRT_6) / 3.0,
    (-13.0 + 7.0 * SQRT_6) / 3.0,
    -1.0 / 3.0,
];

/// Values at `s` of the Lagrange polynomials of [`C`] in the basis that vanishes at 0: the collocation polynomial
/// of a step is `y_0 + sum_j weights[j] z_j`.
pub fn collocation_weights(s: f64) -> [f64; 3] {
    std::array::from_fn(|j| {
        let others = (0..3).filter(|&i| i != j);
        others.fold(s / C[j], |weight, i| weight * (s - C[i]) / (C[j] - C[i]))
    })
}

/// Product of a row of coefficients and three stages.
pub fn dot(row: &[f64; 3], stages: [f64; 3]) -> f64 {
    row[0] * stages[0] + row[1] * stages[1] + row[2] * stages[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;

    fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
        Matrix3::from_fn(|i, j| rows[i][j])
    }

    fn coefficients() -> Matrix3<f64> {
        let s = SQRT_6;
        matrix([
            [
                (88.0 - 7.0 * s) / 360.0,
                (296.0 - 169.0 * s) / 1800.0,
                (-2.0 + 3.0 * s) / 225.0,
            ],
            [
                (296.0 + 169.0 * s) / 1800.0,
                (88.0 + 7.0 * s) / 360.0,
                (-2.0 - 3.0 * s) / 225.0,
            ],
            [(16.0 - s) / 36.0, (16.0 + s) / 36.0, 1.0 / 9.0],
        ])
    }

    #[test]
    fn coefficients_integrate_polynomials_up_to_the_stage_order() {
        for q in 1..=3 {
            let powers = nalgebra::Vector3::from_fn(|i, _| C[i].powi(q - 1));
            let integrals = coefficients() * powers;
            for i in 0..3 {
                assert!(
                    (integrals[i] - C[i].powi(q) / f64::from(q)).abs() < 1e-15,
                    "{q} {i}"
                );
            }
        }
        let weights = coefficients().row(2).into_owned();
        assert!(
            weights
                .iter()
                .zip(B)
                .all(|(weight, b)| (weight - b).abs() < 1e-16)
        );
        for q in 4..=5 {
            let integral: f64 = (0..3).map(|i| weights[i] * C[i].powi(q - 1)).sum();
            assert!((integral - 1.0 / f64::from(q)).abs() < 1e-15, "{q}");
        }
    }

    #[test]
    fn transformation_separates_the_stages() {
        let (t, t_inverse) = (matrix(T), matrix(T_INVERSE));
        assert!((t * t_inverse - Matrix3::identity()).amax() < 1e-14);
        let inverse = coefficients().try_inverse().unwrap();
        let expected = matrix([[GAMMA, 0.0, 0.0], [0.0, ALPHA, -BETA], [0.0, BETA, ALPHA]]);
        assert!((t_inverse * inverse * t - expected).amax() < 1e-13);
    }

    #[test]
    fn error_weights_cancel_the_derivative_up_to_order_three() {
        // For z_i = (c_i h)^q the estimate h y' + sum e_i z_i must vanish for q = 1, 2 and 3.
        for q in 1..=3 {
            let derivative = if q == 1 { 1.0 } else { 0.0 };
            let estimate = derivative + dot(&ERROR, C.map(|c| c.powi(q)));
            assert!(estimate.abs() < 2e-15, "{q} {estimate}");
        }
        assert!(dot(&ERROR, C.map(|c| c.powi(4))).abs() > 0.01);
    }

    #[test]
    fn collocation_weights_reproduce_a_cubic_beyond_the_step() {
        let cubic = |s: f64| s * (0.3 + s * (-1.7 + 2.1 * s));
        for s in [0.1, C[1], 1.0, 1.9] {
            assert!((dot(&collocation_weights(s), C.map(cubic)) - cubic(s)).abs() < 1e-13);
        }
    }
}
