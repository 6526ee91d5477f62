//! Probed amplification matrices against the printed ones.

use std::f64::consts::TAU;

use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::spectrum::roots::eigenvalues;
use linchpin_models::nonsmooth::spectrum::{Amplification, Probe, SpectrumError, Variable};
use nalgebra::{DMatrix, Matrix3};

use super::{alpha, decaying, optimal};

fn amplification(scheme: SchemeKind, ratio: f64) -> Amplification {
    let mut probe = Probe::new(scheme).unwrap();
    probe.amplification(ratio).unwrap()
}

/// To the rounding of accelerations, which are larger than coordinates by `Omega^2`.
fn assert_near(own: &Matrix3<f64>, expected: &Matrix3<f64>, omega_dt: f64, what: &str) {
    let tolerance = 1e-13 + 1e-15 * omega_dt * omega_dt;
    for (own, expected) in own.iter().zip(expected) {
        let is_near = (own - expected).abs() <= tolerance * expected.abs().max(1.0);
        assert!(is_near, "{what}: {own:e} instead of {expected:e}");
    }
}

/// Eq. (96); its third variable is `dt^2 A`, since `a = -omega^2 q` at the ends of all steps.
fn generalized_alpha(alpha_m: f64, alpha_f: f64, omega_dt: f64) -> Matrix3<f64> {
    let gamma = 0.5 - alpha_m + alpha_f;
    let beta = 0.25 * (1.0 - alpha_m + alpha_f).powi(2);
    let (m, f, s) = (1.0 - alpha_m, 1.0 - alpha_f, omega_dt * omega_dt);
    #[rustfmt::skip]
    let matrix = Matrix3::new(
        m - alpha_f * beta * s, m, (0.5 - beta) * m - beta * alpha_m,
        -gamma * s, m - f * (gamma - beta) * s,
        (1.0 - gamma) * m - gamma * alpha_m - f * (0.5 * gamma - beta) * s,
        -s, -f * s, -f * (0.5 - beta) * s - alpha_m,
    );
    matrix / (m + f * beta * s)
}

/// The probed matrix of `(q, dt v, dt^2 A)` with `a` as it is at the ends of steps.
fn with_consistent_acceleration(own: &Amplification, omega_dt: f64) -> Matrix3<f64> {
    let place = |variable| own.variables.iter().position(|own| *own == variable);
    let kept = [
        Variable::Coordinate,
        Variable::Velocity,
        Variable::Auxiliary,
    ];
    let acceleration = place(Variable::Acceleration);
    Matrix3::from_fn(|row, column| {
        let row = place(kept[row]).unwrap();
        let entry = own.matrix[(row, place(kept[column]).unwrap())];
        match acceleration.filter(|_| column == 0) {
            Some(acceleration) => entry - omega_dt * omega_dt * own.matrix[(row, acceleration)],
            None => entry,
        }
    })
}

#[test]
fn generalised_alpha_has_the_matrix_of_eq_96() {
    let points = [
        (0.0, 0.0),
        (-1.0, 0.5),
        (-1.0, 0.0),
        (-1.0, -0.5),
        (0.5, 0.5),
        (0.0, 1.0 / 3.0),
        (0.2, 0.4),
    ];
    for (alpha_m, alpha_f) in points {
        for ratio in [0.01, 0.1, 0.5, 3.0, 100.0] {
            let own = amplification(alpha(alpha_m, alpha_f), ratio);
            let own = with_consistent_acceleration(&own, TAU * ratio);
            let expected = generalized_alpha(alpha_m, alpha_f, TAU * ratio);
            let what = format!("alpha ({alpha_m}, {alpha_f}), dt / T = {ratio}");
            assert_near(&own, &expected, TAU * ratio, &what);
        }
    }
}

/// Eq. (106) with rows 1 and 3 interchanged: printed are the rows of `dt^2 a`, `dt v`, `q`.
fn bathe(omega_dt: f64, order: [usize; 3]) -> Matrix3<f64> {
    let s = omega_dt * omega_dt;
    #[rustfmt::skip]
    let printed = Matrix3::new(
        -144.0 * s + 19.0 * s * s, -144.0 * s + 5.0 * s * s, -28.0 * s,
        -96.0 * s + s * s, 144.0 - 47.0 * s, 48.0 - 4.0 * s,
        144.0 - 19.0 * s, 144.0 - 5.0 * s, 28.0,
    );
    Matrix3::from_fn(|row, column| printed[(order[row], column)]) / ((16.0 + s) * (9.0 + s))
}

#[test]
fn bathe_has_the_matrix_of_eq_106_with_rows_interchanged() {
    for ratio in [0.01, 0.1, 0.5, 3.0, 100.0] {
        let own = amplification(SchemeKind::Bathe, ratio);
        let variables = [
            Variable::Coordinate,
            Variable::Velocity,
            Variable::Acceleration,
        ];
        assert_eq!(own.variables, variables);
        let matrix = Matrix3::from_fn(|row, column| own.matrix[(row, column)]);
        let what = format!("dt / T = {ratio}");
        assert_near(&matrix, &bathe(TAU * ratio, [2, 1, 0]), TAU * ratio, &what);
    }
}

/// As printed it would be unstable.
#[test]
fn eq_106_as_printed_is_no_amplification_matrix() {
    let printed = bathe(100.0, [0, 1, 2]);
    let printed = DMatrix::from_column_slice(3, 3, printed.as_slice());
    let roots = eigenvalues(&printed).unwrap();
    let radius = roots.iter().map(|root| root.re.hypot(root.im));
    let radius = radius.fold(0.0, f64::max);
    assert!((18.0..20.0).contains(&radius), "{radius}");
}

/// Both explicit schemes: `lambda^2 - (2 - Omega^2) lambda + 1`, so that the limit of stability is `Omega = 2`.
#[test]
fn explicit_schemes_have_the_polynomial_of_central_differences() {
    for scheme in [SchemeKind::Moreau, SchemeKind::Hets] {
        for ratio in [0.01, 0.1, 0.3, 0.5, 10.0] {
            let own = amplification(scheme, ratio);
            assert_eq!(own.variables, [Variable::Coordinate, Variable::Velocity]);
            let trace = 2.0 - (TAU * ratio).powi(2);
            assert!((own.matrix.trace() - trace).abs() <= 1e-12 * trace.abs().max(1.0));
            let determinant = own.matrix.determinant();
            assert!(
                (determinant - 1.0).abs() <= 1e-11 * trace * trace,
                "{determinant}"
            );
        }
        let limit = 1.0 / std::f64::consts::PI;
        let spectrum = |ratio| amplification(scheme, ratio).spectrum().unwrap();
        let (below, beyond) = (spectrum(limit - 1e-6), spectrum(limit + 1e-6));
        assert!((below.radius - 1.0).abs() < 1e-9 && below.principal.is_some());
        assert!(beyond.radius > 1.001 && beyond.principal.is_none());
        assert_eq!(
            (beyond.period_error(), beyond.damping_ratio()),
            (None, None)
        );
    }
}

#[test]
fn what_cannot_be_probed_is_an_error() {
    let mut probe = Probe::new(optimal(0.8)).unwrap();
    for ratio in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e10] {
        let error = probe.spectrum(ratio).unwrap_err();
        assert!(matches!(error, SpectrumError::StepOverPeriod(_)));
        let text = error.to_string();
        assert!(text.contains("greater than 0 and at most 1e9"), "{text}");
    }
    assert!(Probe::new(optimal(1.1)).is_err());
    assert!(Probe::new(alpha(0.3, 0.2)).is_err());
    assert!(Probe::new(decaying(0.5, 0.0)).is_err());
}
