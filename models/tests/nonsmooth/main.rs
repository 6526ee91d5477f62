//! Nonsmooth mechanics against golden data, closed forms and theory. Golden data: tests/golden/s2, from an independent
//! prototype of S2 in another language.

#![allow(clippy::unwrap_used)]

mod ball;
mod ball_model;
mod bilateral;
mod block_model;
#[path = "../common/mod.rs"]
mod common;
mod contact_problems;
mod defaults;
mod figures;
mod flexible_forms;
mod flexible_motion;
mod golden;
mod golden_flexible;
mod golden_masses;
mod golden_rigid;
mod hard;
mod incline;
mod invariants;
mod markers;
mod mistakes;
mod model_problem;
mod painleve;
mod partners;
mod pending;
mod quadrature;
mod rocking;
mod rod;
mod slider;
mod spectrum;
mod stand;
mod woodpecker;
mod woodpecker_model;
