//! A second opinion: Siconos (INRIA's platform for nonsmooth dynamics, Debian's python3-siconos) on the same problems.
//!
//! `tests/siconos/run.py` runs its Moreau-Jean scheme with compiled callbacks. Both sides approximate the same motion:
//! they agree to the order of that scheme, which is 1. Where Siconos or a C compiler is missing the tests say so and pass.
//!
//! * [`other`]: its runs; [`own`]: ours; [`compare`]: both on one problem;
//! * [`slider_crank`], [`ball`], [`block`]: the problems.

#![allow(clippy::unwrap_used)]

mod ball;
mod block;
mod compare;
mod other;
mod own;
mod slider_crank;

/// Closing speeds that count as an impact (m/s): slower ones belong to the end of an accumulation of impacts.
const SLOWEST: f64 = 0.01;
