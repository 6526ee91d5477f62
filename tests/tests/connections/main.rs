//! Signal connections: subsystems without joints, algebraic chains and loops, and an electric drive of a mechanism.

#![allow(clippy::unwrap_used, missing_docs)]

mod drive;
mod feedthrough;
mod mechanism;
mod mistakes;
mod nonlinear_loops;
mod processes;
mod unresolved;

use linchpin::error_norm::ColumnError;

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
