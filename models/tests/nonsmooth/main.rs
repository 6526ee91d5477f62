//! Nonsmooth mechanics against golden data, closed forms and theory. Golden data: tests/golden/s2, from an independent
//! prototype of S2 in another language.

#![allow(clippy::unwrap_used)]

mod ball;
mod bilateral;
mod contact_problems;
mod defaults;
mod golden;
mod golden_masses;
mod golden_rigid;
mod hard;
mod incline;
mod invariants;
mod painleve;
mod rocking;
mod slider;
mod stand;
mod woodpecker;
