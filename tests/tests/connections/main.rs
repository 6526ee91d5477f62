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

/// Asserts the observed orders of the errors of all cases, of which `errors` gives those for a macro step.
fn assert_orders<const N: usize>(
    cases: &[(&str, [f64; N])],
    steps: &[f64],
    errors: impl Fn(&str, f64) -> [f64; N],
) {
    let mut report = String::new();
    let mut wrong = 0;
    for (case, expected) in cases {
        let of_steps: Vec<[f64; N]> = steps.iter().map(|&h| errors(case, h)).collect();
        let orders: [f64; N] = std::array::from_fn(|of| {
            let points = steps.iter().zip(&of_steps);
            slope_of(points.map(|(h, errors)| (*h, errors[of])))
        });
        let differ = |(order, expected): (&f64, &f64)| (order - expected).abs() > 0.15;
        let is_wrong = orders.iter().zip(expected).any(differ);
        let mark = if is_wrong { " <-- not as expected" } else { "" };
        report += &format!("{case}: {orders:.2?}, expected {expected:?}{mark}\n{of_steps:?}\n");
        wrong += usize::from(is_wrong);
    }
    println!("{report}");
    assert!(
        wrong == 0,
        "{wrong} of {} cases have other orders:\n{report}",
        cases.len()
    );
}
