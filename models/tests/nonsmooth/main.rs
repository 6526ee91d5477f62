//! Nonsmooth mechanics against golden data, closed forms and theory. Golden data: tests/golden/s2, from an independent
//! prototype of S2 in another language.

#![allow(clippy::unwrap_used)]

mod figures;
mod flexible_forms;
mod flexible_motion;
mod golden;
mod golden_flexible;
mod golden_masses;
mod golden_rigid;
mod mistakes;
mod model_problem;
mod quadrature;
mod rod;
mod spectrum;
mod stand;
