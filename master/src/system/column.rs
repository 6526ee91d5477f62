//! The response to one raised input, and how much it is raised.

use std::ops::Range;

use crate::layout::{DrivenInput, Layout, Position};
use serde::{Deserialize, Serialize};

/// Relative increment when it is chosen automatically. Loads enter nearly linearly, so a large one costs no accuracy
/// and stands above the noise of a solver with step-size control.
const AUTOMATIC: f64 = 1e-3;

/// Share of the size of the mechanism by which a raised load moves it over a step at least: that much above rounding its response is known to
/// a millionth.
const ABOVE_ROUNDING: f64 = 1e-10;

/// A response to an increment stands at least this many times above the noise of the worker.
const ABOVE_NOISE: f64 = 1e3;

/// Relative increment of an exchanged variable when it is chosen automatically: its influence is not linear.
const AUTOMATIC_EXCHANGED: f64 = 1e-6;

/// Positions that move by less than this share of the sizes tell nothing.
const ROUNDING: f64 = 1e-13;

/// Part of what moves the mechanism over the whole run by its size by which a load may be raised for the sake of rounding.
const MOST_NATURAL: f64 = 0.1;

/// Part of a load by which it may be raised for that.
const MOST_OF_LOAD: f64 = 1e-2;

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

/// What motion at the joints is measured by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sizes {
    /// Size of the mechanism in m; angles are measured by 1.
    pub length: f64,
    /// Time span of the run in s.
    pub span: f64,
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

/// Acceleration of the positions of a subsystem under a unit of an input; over a step they move by half of it times the square of the length.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Response {
    /// The largest, in m/s^2 or rad/s^2.
    pub value: f64,
    /// The largest as a share of the sizes, per s^2.
    pub share: f64,
}

/// What a response has to be heard through.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Listening {
    /// Length of the step in s.
    pub length: f64,
    /// Size of the solver's errors that do not cancel in a difference, if it is more than rounding.
    pub noise: Option<f64>,
    /// Time span of the run in s.
    pub span: f64,
    /// The response to the input raised in other curves, and part of that to other loads of its kind: what a load does not do in one curve, or
    /// in one direction, is no measure of how much it may be raised.
    pub of_others: Response,
}

impl Response {
    /// The larger one of each.
    pub fn larger(self, other: Self) -> Self {
        Self {
            value: self.value.max(other.value),
            share: self.share.max(other.share),
        }
    }

    /// Of a force from that of a moment and the other way round, by an arm of this many m.
    pub fn times(self, arm: f64) -> Self {
        Self {
            value: self.value * arm,
            share: self.share * arm,
        }
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

    /// The power of two by which the input is to be raised so that the largest response has the size of the largest of the `outputs` that
    /// respond; `None` where nothing responds, or these are 0.
    pub fn increment_of_size(&self, outputs: &[f64]) -> Option<f64> {
        let (mut response, mut size): (f64, f64) = (0.0, 0.0);
        for (derivative, output) in self.derivatives.iter().zip(outputs) {
            if *derivative != 0.0 {
                response = response.max(derivative.abs());
                size = size.max(output.abs());
            }
        }
        let exponent = (size / response).log2().round();
        Some(exponent.exp2()).filter(|power| power.is_normal())
    }

    /// Chooses the increment for the next step, in which the input is predicted as `input`.
    ///
    /// S1 Sect. 3.3: `eps max(1, |u|)`. Automatically `eps max(unit, |u|)`, for loads with `eps = 1e-3` and at least `least`, where
    /// that is known, in place of the unit, which is 1; for exchanged variables with `eps = 1e-6`.
    pub fn choose_increment(&mut self, rule: Increment, input: f64, least: Option<f64>, unit: f64) {
        let size = input.abs();
        self.increment = match rule {
            Increment::Relative(epsilon) => epsilon * size.max(1.0),
            Increment::Automatic | Increment::Derivatives if self.is_load => {
                (AUTOMATIC * size).max(least.unwrap_or(AUTOMATIC))
            }
            Increment::Automatic | Increment::Derivatives => AUTOMATIC_EXCHANGED * size.max(unit),
        };
    }

    /// The response over a look-ahead of this length was measured; the outputs `positions` tell what increments are chosen by. Over nothing
    /// positions do not respond, and over the shortest steps what they respond is rounding: then the last known response stays.
    ///
    /// Single ones may hardly respond, such as a coordinate across a force: an increment after them would leave the range in which a load
    /// acts linearly.
    pub fn note_response(&mut self, positions: &[Position], length: f64, size: f64) {
        if length == 0.0 {
            return;
        }
        let pace = 2.0 / (length * length);
        let mut found = Response::default();
        for position in positions {
            if let Some(response) = self.derivatives.get(position.place) {
                let value = pace * response.abs();
                let measure = if position.is_length { size } else { 1.0 };
                let share = value / measure;
                found = found.larger(Response { value, share });
            }
        }
        if found.share * self.increment.abs() > pace * ROUNDING {
            self.response = found;
        }
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

    /// The least increment of a load of this size, by the last known response: it stands a thousand times above the noise of the solver, and
    /// moves over the whole span by a thousandth of the sizes. It stands well above rounding, if that takes neither a load that
    /// moves over the span by a tenth of the sizes, nor a hundredth of the load: over the shortest steps rounding is all that there is. Over nothing
    /// only accelerations respond, which are linear in loads: one that moves over the span by the sizes is as good as any. Not known if
    /// nothing responds.
    pub fn least(&self, load: f64, listening: Listening) -> Option<f64> {
        let Listening {
            length,
            noise,
            span,
            of_others,
        } = listening;
        let Response { value, share } = self.kept.larger(of_others);
        if share <= 0.0 {
            return None;
        }
        let natural = 2.0 / (span * span * share);
        let least = AUTOMATIC * natural;
        if length == 0.0 {
            return Some(natural);
        }
        let pace = 2.0 / (length * length);
        let above_noise = noise.map_or(0.0, |noise| pace * ABOVE_NOISE * noise / value);
        let above_rounding = pace * ABOVE_ROUNDING / share;
        let bearable = (MOST_NATURAL * natural).max(MOST_OF_LOAD * load.abs());
        Some(least.max(above_noise).max(above_rounding.min(bearable)))
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

    /// A force across the first coordinate, along the second; behind them an angle and a velocity.
    fn measured() -> Column {
        let mut column = Column {
            derivatives: vec![-3e-13, -5e-7, 1e-9, 1e-3],
            increment: 1.0,
            is_load: true,
            ..Column::default()
        };
        let positions = [(0, true), (1, true), (2, false)];
        let positions = positions.map(|(place, is_length)| Position { place, is_length });
        column.note_response(&positions, 1e-3, 2.0);
        column
    }

    fn alone(column: &Column, length: f64, noise: Option<f64>, span: f64) -> Option<f64> {
        let listening = Listening {
            length,
            noise,
            span,
            of_others: Response::default(),
        };
        column.least(0.0, listening)
    }

    #[test]
    fn increments_stand_above_noise_and_rounding() {
        let mut column = measured();
        assert_eq!(alone(&column, 1e-3, Some(1e-8), 1.0), None);
        column.keep_response();
        let is = |found: Option<f64>, right: f64| {
            let found = found.expect("the response is known");
            assert!((found / right - 1.0).abs() < 1e-12, "{found:e}, {right:e}");
        };
        is(alone(&column, 1e-3, Some(1e-8), 1.0), 1e3 * 1e-8 / 5e-7);
        is(alone(&column, 2e-3, Some(1e-8), 1.0), 1e3 * 1e-8 / 2e-6);
        is(alone(&column, 1e-3, None, 10.0), 1e-10 / 2.5e-7);
        is(alone(&column, 1e-3, None, 1e3), 0.1 / 2.5e5);
        is(alone(&column, 1e-3, None, 1e-2), 1e-3 / 2.5e-5);
        // On small mechanisms the angle tells.
        column.derivatives[2] = 4e-7;
        let positions = [(1, true), (2, false)];
        let positions = positions.map(|(place, is_length)| Position { place, is_length });
        column.note_response(&positions, 1e-3, 1e3);
        column.keep_response();
        is(alone(&column, 1e-3, None, 10.0), 1e-10 / 4e-7);
        // What is drowned tells nothing.
        column.increment = 1e-8;
        column.derivatives.fill(0.0);
        column.note_response(&positions, 1e-3, 1e3);
        column.keep_response();
        is(alone(&column, 1e-3, None, 10.0), 1e-10 / 4e-7);
        let foreseen = Response {
            value: 6.0,
            share: 2.0,
        };
        column.resume_response(foreseen);
        is(alone(&column, 1e-3, None, 10.0), 1e-10 / 1e-6);
    }

    #[test]
    fn increments_scale_with_the_scene() {
        let mut scaled = measured();
        scaled.keep_response();
        let plain = alone(&scaled, 1e-3, Some(1e-8), 1.0).expect("known");
        let (mass, length, time) = (2.0_f64.powi(-30), 2.0_f64.powi(30), 2.0_f64.powi(15));
        scaled.derivatives = vec![-3e-13, -5e-7];
        for derivative in &mut scaled.derivatives {
            *derivative *= time * time / mass;
        }
        let positions = [0, 1].map(|place| Position {
            place,
            is_length: true,
        });
        scaled.note_response(&positions, time * 1e-3, length * 2.0);
        scaled.keep_response();
        let least = alone(&scaled, time * 1e-3, Some(length * 1e-8), time * 1.0);
        assert_eq!(least, Some(plain * mass * length / (time * time)));
    }

    #[test]
    fn increments_follow_their_rule() {
        let mut column = measured();
        column.choose_increment(Increment::Relative(1e-5), 333.0, Some(1e9), 1.0);
        assert_eq!(column.increment, 1e-5 * 333.0);
        column.choose_increment(Increment::Automatic, 0.0, None, 1.0);
        assert_eq!(column.increment, 1e-3);
        column.choose_increment(Increment::Automatic, 333.0, Some(1.0), 1.0);
        assert_eq!(column.increment, 1.0);
        column.choose_increment(Increment::Automatic, 1e6, Some(1.0), 1.0);
        assert_eq!(column.increment, 1e3);
        column.is_load = false;
        column.choose_increment(Increment::Automatic, 5.0, Some(1e9), 1.0);
        assert_eq!(column.increment, 1e-6 * 5.0);
        column.choose_increment(Increment::Automatic, 5e-9, None, 1e-3);
        assert_eq!(column.increment, 1e-9);
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
