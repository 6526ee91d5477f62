//! Errors of one run against the reference.

use serde::{Deserialize, Serialize};

use super::columns::{Column, Kind};
use super::reference::Reference;
use crate::error_norm::ColumnError;

/// What an error is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quantity {
    /// Positions of all markers.
    Position,
    /// Velocities of all markers.
    Velocity,
    /// Positions and velocities as one vector (the global error of S1 Figs. 6, 11, 13).
    State,
    /// Multipliers at the macro points.
    Multiplier,
    /// Multipliers that are means over a step, at the middle of the step.
    MultiplierAtMidStep,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Position,
        Self::Velocity,
        Self::State,
        Self::Multiplier,
        Self::MultiplierAtMidStep,
    ];

    /// For headings.
    pub fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::State => "state",
            Self::Multiplier => "lambda",
            Self::MultiplierAtMidStep => "lambda mid-step",
        }
    }
}

/// Root mean square errors over those of the reference (NRMS), for each [`Quantity`].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Errors([Option<f64>; 5]);

impl Errors {
    /// The error of a quantity; `None` if the reference does not know it or is 0.
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        self.0[quantity as usize]
    }
}

/// Compares a run with the reference.
pub struct RunErrors<'a> {
    reference: &'a Reference,
    columns: &'a [Column],
    errors: Vec<ColumnError>,
    at_mid_step: Option<ColumnError>,
    previous: Option<f64>,
}

impl<'a> RunErrors<'a> {
    /// `are_means`: the multipliers are means over the step.
    pub fn new(reference: &'a Reference, columns: &'a [Column], are_means: bool) -> Self {
        let knows_mid_steps = reference.is_dense();
        Self {
            reference,
            columns,
            errors: vec![ColumnError::default(); columns.len()],
            at_mid_step: (are_means && knows_mid_steps).then(ColumnError::default),
            previous: None,
        }
    }

    /// Takes the values of the columns at time `t`.
    pub fn add(&mut self, t: f64, values: &[Option<f64>]) {
        for (column, value) in values.iter().enumerate() {
            let Some(value) = *value else { continue };
            if let Some(exact) = self.reference.value(column, t) {
                self.errors[column].add(value, exact);
            }
            if let (Kind::Multiplier, Some(previous)) = (self.columns[column].kind, self.previous) {
                self.add_mid_step(column, value, f64::midpoint(previous, t));
            }
        }
        self.previous = Some(t);
    }

    /// The errors so far.
    pub fn errors(&self) -> Errors {
        let of = |wanted: &[Kind]| {
            let columns = self.columns.iter().zip(&self.errors);
            let chosen = columns.filter(|(column, _)| wanted.contains(&column.kind));
            ColumnError::together(chosen.map(|(_, error)| *error))
        };
        let errors = Quantity::ALL.map(|quantity| match quantity {
            Quantity::Position => Some(of(&[Kind::Position])),
            Quantity::Velocity => Some(of(&[Kind::Velocity])),
            Quantity::State => Some(of(&[Kind::Position, Kind::Velocity])),
            Quantity::Multiplier => Some(of(&[Kind::Multiplier])),
            Quantity::MultiplierAtMidStep => self.at_mid_step,
        });
        let known = |error: ColumnError| Some(error.normalised()).filter(|norm| norm.is_finite());
        Errors(errors.map(|error| error.and_then(known)))
    }

    fn add_mid_step(&mut self, column: usize, value: f64, middle: f64) {
        if let Some(error) = &mut self.at_mid_step
            && let Some(exact) = self.reference.value(column, middle)
        {
            error.add(value, exact);
        }
    }
}
