//! Signal connections: subsystems without joints, algebraic chains and loops, and an electric drive of a mechanism.

#![allow(clippy::unwrap_used, missing_docs)]

mod drive;
mod feedthrough;
mod mechanism;
mod mistakes;
mod processes;

use linchpin::error_norm::ColumnError;
use linchpin_tests::convergence::slope_of;

/// Far below the errors of the coupling.
const TIGHT: &str = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }";

/// Error of the vector of several columns, each with its exact values (NRMS).
fn error_of(columns: &[(Vec<f64>, Vec<f64>)]) -> f64 {
    let errors = columns.iter().map(|(found, exact)| {
        assert_eq!(found.len(), exact.len());
        let mut error = ColumnError::default();
        for (found, exact) in found.iter().zip(exact) {
            error.add(*found, *exact);
        }
        error
    });
    ColumnError::together(errors).normalised()
}

/// Asserts the observed orders of errors that `errors` gives for every macro step.
fn assert_orders<const N: usize>(
    what: &str,
    steps: &[f64],
    expected: [f64; N],
    errors: impl Fn(f64) -> [f64; N],
) {
    let of_steps: Vec<[f64; N]> = steps.iter().map(|&h| errors(h)).collect();
    let orders: [f64; N] = std::array::from_fn(|of| {
        let points = steps.iter().zip(&of_steps);
        slope_of(points.map(|(h, errors)| (*h, errors[of])))
    });
    println!("{what}: {orders:.2?}, expected {expected:?}\n{of_steps:.2e?}");
    let differ = |(order, expected): (&f64, &f64)| (order - expected).abs() > 0.2;
    assert!(
        !orders.iter().zip(&expected).any(differ),
        "{what}: {orders:.2?}, expected {expected:?}\n{of_steps:.2e?}"
    );
}
