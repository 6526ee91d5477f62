//! Columns of the workers' responses: finite differences with respect to their driven inputs (S1 eqs. 62, 63).

use std::ops::Range;

use super::carriage::{Carriage, Nodes};
use super::layout::{DrivenInput, Layout, Over};
use super::unknowns::Unknowns;
use crate::cosimulation::{Ahead, Parts};
use crate::scene::Increment;
use crate::signal::Curves;

/// Relative increment when it is chosen automatically. Loads enter nearly linearly, so a large one costs no accuracy
/// and stands above the noise of a solver with step-size control.
const AUTOMATIC: f64 = 1e-3;

/// A response to an increment stands at least this many times above the noise of the worker.
const ABOVE_NOISE: f64 = 1e3;

/// Relative increment of an exchanged variable when it is chosen automatically: its influence is not linear.
const AUTOMATIC_EXCHANGED: f64 = 1e-6;

/// The columns of all driven inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    rule: Increment,
    ahead: Ahead,
    columns: Vec<Column>,
    /// The columns of each input.
    of_input: Vec<Range<usize>>,
    /// Number of columns of each subsystem.
    of_subsystem: Vec<usize>,
    /// Places of the markers' positions in the coupling outputs of each subsystem.
    positions: Vec<Vec<usize>>,
    /// Whether the last look-ahead was asked for columns that were not taken yet.
    are_fresh: bool,
    carriage: Carriage,
}

/// A look-ahead: what it is asked for.
#[derive(Clone, Copy)]
pub struct Look<'a> {
    /// The predicted curves (S1 eq. 56).
    pub predicted: &'a dyn Curves,
    /// Curves with the same values at the end of the step that can be raised (S1 eq. 59).
    pub raised: &'a dyn Curves,
    /// Predicted values of all variables at the end of the step.
    pub ends: &'a [f64],
    /// Whether the response to every raised input is asked for.
    pub with_columns: bool,
}

impl Columns {
    /// The columns of the driven inputs of `layout` over a look-ahead, one for each shape that an input is raised in.
    pub fn new(rule: Increment, ahead: Ahead, layout: &Layout, unknowns: &Unknowns) -> Self {
        let mut own = Self {
            rule,
            ahead,
            columns: Vec::new(),
            of_input: Vec::new(),
            of_subsystem: vec![0; layout.outputs.len()],
            positions: positions_of(layout),
            are_fresh: false,
            carriage: Carriage::new(layout),
        };
        for (number, input) in layout.inputs.iter().enumerate() {
            let numbers = unknowns.columns(number);
            for _ in numbers.clone() {
                let count = &mut own.of_subsystem[input.subsystem];
                let place = input.is_perturbed.then_some(*count);
                *count += usize::from(input.is_perturbed);
                own.columns.push(Column {
                    place,
                    ..Column::new(input, layout)
                });
            }
            own.of_input.push(numbers);
        }
        own
    }

    /// The columns in the order of the inputs; those of inputs that are not perturbed are empty.
    pub fn all(&self) -> &[Column] {
        &self.columns
    }

    /// Fills in the look-ahead that was prepared: the predicted curve of every input, and for each perturbed one the curves
    /// that are raised in each of its shapes, if columns are asked for. `memory` has room for one value of every variable.
    pub fn request(&mut self, parts: &mut Parts, look: Look<'_>, memory: &mut [f64]) {
        self.are_fresh = look.with_columns;
        self.make_room(parts);
        let mut over = Over {
            curves: look.predicted,
            memory,
        };
        for (input, columns) in parts.layout.inputs.iter().zip(&self.of_input) {
            let subsystem = &mut parts.subsystems[input.subsystem];
            if !subsystem.is_read() {
                continue;
            }
            over.curves = look.predicted;
            input.signal(&mut over, subsystem.look_signal(self.ahead, input.place));
            if !(input.is_perturbed && look.with_columns) {
                continue;
            }
            let end = input.value(look.ends, look.raised.attitudes());
            let length = look.raised.length();
            over.curves = look.raised;
            let gives_derivatives = subsystem.gives_derivatives(self.rule);
            for (raised, column) in self.columns[columns.clone()].iter_mut().enumerate() {
                let Some(place) = column.place else {
                    continue;
                };
                if gives_derivatives {
                    let signal = subsystem.direction_signal(self.ahead, place, input.place);
                    input.direction(&mut over, raised, signal);
                } else {
                    let audible = subsystem.noise().map(|noise| column.audible(length, noise));
                    column.choose_increment(self.rule, end, audible);
                    let signal = subsystem.perturbed_signal(self.ahead, place, input.place);
                    input.raised_signal(&mut over, raised, column.increment, signal);
                }
            }
        }
    }

    fn make_room(&self, parts: &mut Parts) {
        for (subsystem, &columns) in parts.subsystems.iter_mut().zip(&self.of_subsystem) {
            if subsystem.is_read() {
                let columns = if self.are_fresh { columns } else { 0 };
                let (perturbed, directions) = match subsystem.gives_derivatives(self.rule) {
                    true => (0, columns),
                    false => (columns, 0),
                };
                let look = subsystem.look(self.ahead);
                look.perturbed.resize_with(perturbed, Default::default);
                look.directions.resize_with(directions, Default::default);
            }
        }
    }

    /// Whether there are columns of an earlier macro step for a look-ahead of this length with these past nodes.
    pub fn has(&self, length: f64, nodes: Nodes<'_>) -> bool {
        self.carriage.has(length, nodes)
    }

    /// Begins with the first look-ahead over a macro step, or over a repeated one, of this length and with these past nodes. Gives
    /// whether the macro step before was such a one.
    pub fn begin(&mut self, length: f64, nodes: Nodes<'_>) -> bool {
        self.carriage.begin(length, nodes)
    }

    /// The step of this length is done: its columns may serve later ones, and its responses are what increments are chosen by.
    pub fn settle(&mut self, length: f64) {
        self.carriage.settle();
        for column in &mut self.columns {
            column.keep_response(length);
        }
    }

    /// Takes the difference quotients of the last answers of all workers, if columns were asked for; otherwise carries the last
    /// ones along to the attitudes of the last prediction.
    pub fn difference(&mut self, parts: &Parts) {
        let ahead = self.ahead;
        let looked = |subsystem: usize| match ahead {
            Ahead::Step => parts.subsystems[subsystem].predicted(),
            Ahead::Now => parts.subsystems[subsystem].coupling_values(),
        };
        if !std::mem::take(&mut self.are_fresh) {
            let (columns, own) = (&mut self.columns, &self.of_input);
            return self.carriage.carry(&parts.layout, looked, columns, own);
        }
        for (input, columns) in parts.layout.inputs.iter().zip(&self.of_input) {
            let subsystem = &parts.subsystems[input.subsystem];
            let (predicted, perturbed) = subsystem.looked(self.ahead);
            for column in &mut self.columns[columns.clone()] {
                if let Some(place) = column.place {
                    match subsystem.gives_derivatives(self.rule) {
                        true => {
                            let derivatives = &subsystem.derivatives(self.ahead)[place].values;
                            column.derivatives.clone_from(derivatives);
                        }
                        false => column.difference(predicted, &perturbed[place].values),
                    }
                    column.response = column.largest(&self.positions[input.subsystem]);
                }
            }
        }
        self.carriage.keep(&parts.layout, looked, &self.columns);
    }
}

/// Response of one subsystem's coupling outputs to one driven input at the end of the step, per unit of that input.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Column {
    /// `d output / d input`, in the order of the coupling outputs.
    pub derivatives: Vec<f64>,
    /// The increment that was used.
    pub increment: f64,
    /// Whether the input is a load: it enters linearly or nearly so.
    pub is_load: bool,
    /// Place among the perturbed steps of its subsystem; absent if the input is not perturbed.
    pub place: Option<usize>,
    /// Largest response of a position.
    response: f64,
    /// The same in the last step that was done.
    kept: Response,
}

/// Response of an output to a unit of an input over a step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Response {
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

    /// The largest response of the outputs `positions`. Single ones may hardly respond, such as a coordinate across a force:
    /// an increment after them would leave the range in which a load acts linearly.
    fn largest(&self, positions: &[usize]) -> f64 {
        let derivatives = positions
            .iter()
            .filter_map(|&position| self.derivatives.get(position));
        derivatives.fold(0.0, |largest: f64, one| largest.max(one.abs()))
    }

    /// The step of this length is done: its response is what increments are chosen by.
    pub fn keep_response(&mut self, length: f64) {
        let value = self.response;
        self.kept = Response { value, length };
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

/// Places of the markers' positions in the coupling outputs of each subsystem.
fn positions_of(layout: &Layout) -> Vec<Vec<usize>> {
    let mut positions = vec![Vec::new(); layout.outputs.len()];
    for end in layout.joints.iter().flat_map(|joint| &joint.ends) {
        positions[end.subsystem].extend(end.positions());
    }
    positions
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
            kept: Response {
                value: 5e-7,
                length: 1e-3,
            },
            ..Column::default()
        };
        column.kept.value = column.largest(&[0, 1]);
        let audible = column.audible(1e-3, 1e-8);
        assert!((audible * 5e-7 / 1e-8 - 1e3).abs() < 1e-9);
        let over_a_longer_step = column.audible(2e-3, 1e-8);
        assert!((over_a_longer_step * 2e-6 / 1e-8 - 1e3).abs() < 1e-9);
        assert_eq!(column.largest(&[]), 0.0);
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
