//! Impacts of a subsystem whose partners at its joints take part in them.
//!
//! A contact that closes makes velocities jump, those of the partners as well: an impulse goes through the joints at the same instant.
//! Whoever has the contact finds that impulse if it knows how much the partners give way, their [`Interface`]; all others take it as
//! the impulses of loads.

/// An impact within a step.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Impact {
    /// Its instant, s after the start of the step.
    pub at: f64,
    /// Numbers of the contacts that take part.
    pub contacts: Vec<usize>,
    /// Impulses of the loads, one for each input in the order of [`Inputs`](crate::Inputs), 0 for inputs that are none: of impacts that are
    /// given.
    pub loads: Vec<f64>,
    /// Impulses of the multipliers, one for each row of the interface: of impacts that were found.
    pub multipliers: Vec<f64>,
}

impl Impact {
    /// Takes over all values of another one, in memory that is already there.
    pub fn take(&mut self, other: &Self) {
        self.at = other.at;
        self.contacts.clone_from(&other.contacts);
        self.loads.clone_from(&other.loads);
        self.multipliers.clone_from(&other.multipliers);
    }
}

/// How the partners of a subsystem take part in its impacts.
///
/// For every multiplier `r` of the joints there is a row. A unit of its impulse loads the inputs with `d_r` and the
/// partners so that the joints part with the velocities `Y_r`: behind an impact `d_r^T J (v^+ - v^-) = -(Y P)_r`, with the impulses `P` of
/// the multipliers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Interface {
    /// `d_r`: for each row a number for each input.
    pub directions: Vec<Vec<f64>>,
    /// `Y`, row by row: symmetric, and 0 for partners that do not move.
    pub mobility: Vec<f64>,
}

/// What a subsystem with contacts does about its impacts in the steps that follow.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Impacts {
    /// It finds them as if it had no partners.
    #[default]
    Alone,
    /// It finds them, and the impulses of the multipliers with them.
    Coupled(Interface),
    /// They are these, in the order of their instants, and no others: what closes besides stays open until the next step finds it.
    Given(Vec<Impact>),
}
