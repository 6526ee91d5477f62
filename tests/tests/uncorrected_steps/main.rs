//! Variable macro steps of the methods without a corrector: explicit, penalty, jacobi and gauss-seidel.

#![allow(clippy::unwrap_used, missing_docs)]

mod tolerances;
mod traces;
