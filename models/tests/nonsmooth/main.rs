//! Nonsmooth mechanics against golden data, closed forms and theory. Golden data: tests/golden/s2, from an independent
//! prototype of S2 in another language.

#![allow(clippy::unwrap_used)]

mod ball;
mod bilateral;
mod golden;
mod golden_masses;
mod golden_rigid;
mod incline;
mod invariants;
mod rocking;
mod slider;
mod stand;
mod woodpecker;
