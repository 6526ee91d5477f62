//! The response to one raised input, and how much it is raised.

use std::ops::Range;

use crate::layout::{DrivenInput, Layout};
use serde::{Deserialize, Serialize};

/// Relative increment when it is chosen automatically. Loads enter nearly linearly, so a large one costs no accuracy
/// and stands above the noise of a solver with step-size control.
const AUTOMATIC: f64 = 1e-3;

/// A response to an increment stands at least this many times above the noise of the worker.
const ABOVE_NOISE: f64 = 1e3;

/// Relative increment of an exchanged variable when it is chosen automatically: its influence is not linear.
const AUTOMATIC_EXCHANGED: f64 = 1e-6;

/// Increments of the finite differences that give the coupling Jacobian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Increment {
    /// Chosen so that the response stands well above the tolerance that the worker reports.
    Automatic,
    /// None where a worker offers directional derivatives; otherwise as automatic.
    Derivatives,
    /// eps max(1, |u|) for the coupling variable u; eps greater than 0 (Schweizer & Lu, Sect. 3.3).
    Relative(f64),
}

/// Response of one subsystem's coupling outputs to one driven input at the end of the step, per unit of that input.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Column {
    /// `d output / d input`, in the order of the coupling outputs; empty if it is not known.
    pub derivatives: Vec<f64>,
    /// The increment that was used.
    pub increment: f64,
    /// Whether the input is a load: it enters linearly or nearly so.
    pub is_load: bool,
    /// Place among the perturbed steps of its subsystem; absent if it is not asked for.
    pub place: Option<usize>,
    /// The largest one of a position, as it was last measured.
    response: Response,
    /// The same as of the last step that was done.
    kept: Response,
}

/// Response of an output to a unit of an input over a step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Response {
    value: f64,
    length: f64,
}

impl Response {
    /// Its size over a step of another length: that of a position to a load goes with the square.
    fn over(&self, length: f64) -> f64 {
        let ratio = if length == self.length {
            1.0
        } else {
            length / self.length
        };
        self.value.abs() * ratio * ratio
    }
}

impl Column {
    /// The column of an input, not known yet.
    pub fn new(input: &DrivenInput, layout: &Layout) -> Self {
        Self {
            is_load: input.drives_load(layout.rows.len()),
            ..Self::default()
        }
    }

    /// Takes the difference quotient of two answers of a worker.
    pub fn difference(&mut self, predicted: &[f64], perturbed: &[f64]) {
        self.derivatives.clear();
        let quotients = predicted.iter().zip(perturbed);
        self.derivatives
            .extend(quotients.map(|(y, raised)| (raised - y) / self.increment));
    }

    /// Chooses the increment for the next step, in which the input is predicted as `input`.
    ///
    /// S1 Sect. 3.3: `eps max(1, |u|)`. Automatically, `eps = 1e-3` for loads and `1e-6` for exchanged variables, and the
    /// increment of a load is at least `audible`, if that is given.
    pub fn choose_increment(&mut self, rule: Increment, input: f64, audible: Option<f64>) {
        let scale = input.abs().max(1.0);
        self.increment = match rule {
            Increment::Relative(epsilon) => epsilon * scale,
            Increment::Automatic | Increment::Derivatives if self.is_load => {
                (AUTOMATIC * scale).max(audible.unwrap_or_default())
            }
            Increment::Automatic | Increment::Derivatives => AUTOMATIC_EXCHANGED * scale,
        };
    }

    /// The response over a look-ahead of this length was measured; the outputs `positions` tell what increments are chosen by.
    ///
    /// Single ones may hardly respond, such as a coordinate across a force: an increment after them would leave the range in which a load
    /// acts linearly.
    pub fn note_response(&mut self, positions: &[usize], length: f64) {
        let known = positions
            .iter()
            .filter_map(|&position| self.derivatives.get(position));
        let value = known.fold(0.0, |largest: f64, one| largest.max(one.abs()));
        self.response = Response { value, length };
    }

    /// The step is done: its response is what increments are chosen by.
    pub fn keep_response(&mut self) {
        self.kept = self.response;
    }

    /// What increments are chosen by, to be written.
    pub fn kept_response(&self) -> Response {
        self.kept
    }

    /// Goes on from what was written.
    pub fn resume_response(&mut self, response: Response) {
        (self.response, self.kept) = (response, response);
    }

    /// What was measured for a step that is not taken counts for nothing.
    pub fn drop_response(&mut self) {
        self.response = self.kept;
    }

    /// The increment under which the last known response stands a thousand times above `noise` over a step of this length; 0
    /// if nothing responds.
    pub fn audible(&self, length: f64, noise: f64) -> f64 {
        let response = self.kept.over(length);
        if response > 0.0 {
            ABOVE_NOISE * noise / response
        } else {
            0.0
        }
    }
}

/// By how much an output moves where its inputs are raised by so much: `sum derivative raised` over the columns `own` of its subsystem.
pub fn moved(columns: &[Column], own: Range<usize>, output: usize, raised: &[f64]) -> f64 {
    let responses = own.filter_map(|column| {
        let response = columns[column].derivatives.get(output)?;
        Some(response * raised[column])
    });
    responses.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn increments_follow_their_rule() {
        let mut column = Column {
            // A force across the first coordinate, along the second; behind them a velocity.
            derivatives: vec![-3e-13, -5e-7, 1e-3],
            is_load: true,
            ..Column::default()
        };
        column.note_response(&[0, 1], 1e-3);
        assert_eq!(column.audible(1e-3, 1e-8), 0.0);
        column.keep_response();
        let audible = column.audible(1e-3, 1e-8);
        assert!((audible * 5e-7 / 1e-8 - 1e3).abs() < 1e-9);
        let over_a_longer_step = column.audible(2e-3, 1e-8);
        assert!((over_a_longer_step * 2e-6 / 1e-8 - 1e3).abs() < 1e-9);
        column.choose_increment(Increment::Relative(1e-5), 333.0, Some(audible));
        assert_eq!(column.increment, 1e-5 * 333.0);
        column.choose_increment(Increment::Automatic, 0.0, None);
        assert_eq!(column.increment, 1e-3);
        column.choose_increment(Increment::Automatic, 333.0, Some(audible));
        assert_eq!(column.increment, audible);
        column.choose_increment(Increment::Automatic, 1e6 * audible, Some(audible));
        assert_eq!(column.increment, 1e3 * audible);
        column.is_load = false;
        column.choose_increment(Increment::Automatic, 5.0, Some(audible));
        assert_eq!(column.increment, 1e-6 * 5.0);
    }

    #[test]
    fn a_difference_is_per_unit_of_the_input() {
        let mut column = Column {
            increment: 0.5,
            ..Column::default()
        };
        column.difference(&[1.0, 2.0], &[1.5, 0.0]);
        assert_eq!(column.derivatives, [1.0, -4.0]);
    }
}
