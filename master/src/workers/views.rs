//! What the workers have answered, as values.

use super::subsystem::{Ahead, Subsystem};
use crate::system::{LookAhead, Outputs};

/// Coupling outputs at the present macro point.
#[derive(Clone, Copy)]
pub struct Now<'a>(pub(super) &'a [Subsystem]);

impl Outputs for Now<'_> {
    fn of(&self, subsystem: usize) -> &[f64] {
        self.0[subsystem].coupling_values()
    }

    fn inside(&self, subsystem: usize) -> &[f64] {
        self.0[subsystem].advanced_inside()
    }
}

/// The answers to the last look-ahead.
#[derive(Clone, Copy)]
pub struct Looked<'a> {
    pub(super) subsystems: &'a [Subsystem],
    pub(super) ahead: Ahead,
}

impl Outputs for Looked<'_> {
    fn of(&self, subsystem: usize) -> &[f64] {
        let subsystem = &self.subsystems[subsystem];
        match self.ahead {
            Ahead::Step => subsystem.predicted(),
            Ahead::Now => subsystem.coupling_values(),
        }
    }

    fn inside(&self, subsystem: usize) -> &[f64] {
        let subsystem = &self.subsystems[subsystem];
        match self.ahead {
            Ahead::Step => subsystem
                .predicted()
                .get(subsystem.coupling_outputs..)
                .unwrap_or_default(),
            Ahead::Now => &[],
        }
    }
}

impl LookAhead for Looked<'_> {
    fn unperturbed(&self, subsystem: usize) -> &[f64] {
        self.subsystems[subsystem].looked(self.ahead).0
    }

    fn perturbed(&self, subsystem: usize, number: usize) -> &[f64] {
        &self.subsystems[subsystem].looked(self.ahead).1[number].values
    }

    fn derivatives(&self, subsystem: usize, number: usize) -> &[f64] {
        &self.subsystems[subsystem].derivatives(self.ahead)[number].values
    }
}

/// Outputs at a sample inside the last macro step.
#[derive(Clone, Copy)]
pub struct Sampled<'a> {
    pub(super) subsystems: &'a [Subsystem],
    pub(super) place: usize,
}

impl Outputs for Sampled<'_> {
    /// All outputs, the coupling outputs first.
    fn of(&self, subsystem: usize) -> &[f64] {
        self.subsystems[subsystem].sample(self.place)
    }
}
