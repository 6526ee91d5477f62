//! The conditions of exchanged variables, differentiated.

use nalgebra::Vector3;

use super::unknowns::Unknowns;
use crate::joint::Level;
use crate::layout::Exchanged;
use crate::layout::exchanged::Rates;
use crate::layout::marker::vector;
use crate::signal::attitude::vector_change_rate;

impl Exchanged {
    /// Where its rates stand, if they are among the unknowns.
    pub(super) fn rates_among(&self, unknowns: &Unknowns) -> Option<&Rates> {
        let has_rate = unknowns.of(self.first).len() > 1;
        self.rates.as_ref().filter(|_| has_rate)
    }

    /// The changes of the variables, `H` times their rates and `H^2` times their second derivatives that go with a change
    /// `column` of the outputs; where rates are no unknowns, or on position level alone, the change of the variables on every level.
    /// `shown` is what the outputs say about the variables.
    pub(super) fn changes(
        &self,
        (unknowns, level): (&Unknowns, Level),
        (outputs, shown): (&[f64], &Vector3<f64>),
        step: f64,
        column: &[f64],
    ) -> [Vector3<f64>; 3] {
        let change = self.change(outputs, shown, column);
        let Some(rates) = self
            .rates_among(unknowns)
            .filter(|_| level > Level::Position)
        else {
            return [change; 3];
        };
        let phi = self.vector(shown);
        let turned =
            vector_change_rate(&phi, &vector(&rates.speed, outputs), &self.vector(&change));
        let speed = rates.speed(column, &phi) + turned;
        let acceleration = rates.acceleration(column);
        [change, step * speed, step * step * acceleration]
    }
}
