//! Built-in subsystem solvers behind [`linchpin_worker::Model`].
//!
//! * [`oscillator`]: one mass on a spring and a damper;
//! * [`integrators`]: time integration that several models share;
//! * [`mod@reference`]: solutions that coupled runs are compared with.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod integrators;
mod mechanics;
pub mod oscillator;
pub mod reference;

use linchpin_worker::Model;

/// All built-in models.
pub fn models() -> Vec<Box<dyn Model>> {
    vec![
        Box::new(oscillator::Oscillator),
    ]
}
