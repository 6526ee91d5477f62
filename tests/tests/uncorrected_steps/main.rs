//! Variable macro steps of the methods without a corrector: explicit, penalty, jacobi and gauss-seidel. The tolerance is met, stiff springs
//! stay stable, and steps that were taken back leave no trace.

#![allow(clippy::unwrap_used, missing_docs)]

mod mistakes;
mod stiff;
mod tolerances;
mod traces;
