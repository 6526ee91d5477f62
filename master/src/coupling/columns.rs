//! Columns of the workers' responses: finite differences with respect to their driven inputs (S1 eqs. 62, 63).

use super::layout::{Layout, Over};
use crate::cosimulation::Parts;
use crate::scene::Increment;
use crate::signal::{Curve, History};

/// Relative increment when it is chosen automatically. Loads enter nearly linearly, so a large one costs no accuracy
/// and stands above the noise of a solver with step-size control.
const AUTOMATIC: f64 = 1e-3;

/// A response to an increment stands at least this many solver tolerances above zero.
const ABOVE_TOLERANCE: f64 = 1e3;

/// Relative increment of an exchanged variable when it is chosen automatically: its influence is not linear.
const AUTOMATIC_EXCHANGED: f64 = 1e-6;

/// The columns of all driven inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    rule: Increment,
    columns: Vec<Column>,
    /// Whether the last look-ahead was asked for columns.
    are_fresh: bool,
}

impl Columns {
    /// One column for each driven input of `layout`.
    pub fn new(rule: Increment, layout: &Layout) -> Self {
        let column = |input: &super::layout::DrivenInput| Column {
            is_load: input.drives_load(layout.rows.len()),
            ..Column::default()
        };
        Self {
            rule,
            columns: layout.inputs.iter().map(column).collect(),
            are_fresh: false,
        }
    }

    /// The columns in the order of the inputs; those of inputs that are not perturbed are empty.
    pub fn all(&self) -> &[Column] {
        &self.columns
    }

    /// Fills in the look-ahead over `length` that was prepared: the extrapolation of every input (S1 eq. 56), and for each
    /// perturbed one the interpolation through its raised end value (59), if `with_columns`. `ends` are the extrapolated values of all
    /// variables at the end, `memory` has room for as many.
    pub fn request(
        &mut self,
        parts: &mut Parts,
        history: &History,
        ends: &[f64],
        length: f64,
        with_columns: bool,
        memory: &mut [f64],
    ) {
        self.are_fresh = with_columns;
        let mut over = Over {
            history,
            curve: Curve::Extrapolated,
            step: length,
            memory,
        };
        for (input, column) in parts.layout.inputs.iter().zip(&mut self.columns) {
            let subsystem = &mut parts.subsystems[input.subsystem];
            if !subsystem.is_read() {
                continue;
            }
            over.curve = Curve::Extrapolated;
            input.signal(&mut over, subsystem.prediction_signal(input.place));
            let Some(place) = input.perturbed.filter(|_| with_columns) else {
                continue;
            };
            let end = input.value(ends, history.attitudes());
            column.choose_increment(self.rule, end, subsystem.tolerance);
            over.curve = Curve::Interpolated(ends);
            let raised = subsystem.perturbed_signal(place, input.place);
            input.raised_signal(&mut over, column.increment, raised);
        }
    }

    /// Takes the difference quotients of the last answers of all workers, if columns were asked for.
    pub fn difference(&mut self, parts: &Parts) {
        if !self.are_fresh {
            return;
        }
        for (input, column) in parts.layout.inputs.iter().zip(&mut self.columns) {
            let subsystem = &parts.subsystems[input.subsystem];
            if let Some(place) = input.perturbed {
                column.difference(
                    subsystem.predicted(),
                    &subsystem.reply.perturbed[place].values,
                );
            }
        }
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
}

impl Column {
    /// Takes the difference quotient of two answers of a worker.
    pub fn difference(&mut self, predicted: &[f64], perturbed: &[f64]) {
        self.derivatives.clear();
        let quotients = predicted.iter().zip(perturbed);
        self.derivatives
            .extend(quotients.map(|(y, raised)| (raised - y) / self.increment));
    }

    /// Chooses the increment for the next step, in which the input is predicted as `input`.
    ///
    /// S1 Sect. 3.3: `eps max(1, |u|)`. Automatically, `eps = 1e-3` for loads and `1e-6` for exchanged variables, and if the
    /// worker reports a tolerance the increment of a load is large enough for the last known response to stand a thousand
    /// tolerances high.
    pub fn choose_increment(&mut self, rule: Increment, input: f64, tolerance: Option<f64>) {
        let scale = input.abs().max(1.0);
        self.increment = match rule {
            Increment::Relative(epsilon) => epsilon * scale,
            Increment::Automatic if self.is_load => {
                (AUTOMATIC * scale).max(self.audible(tolerance))
            }
            Increment::Automatic => AUTOMATIC_EXCHANGED * scale,
        };
    }

    fn audible(&self, tolerance: Option<f64>) -> f64 {
        let response = self
            .derivatives
            .first()
            .map_or(0.0, |derivative| derivative.abs());
        match tolerance {
            Some(tolerance) if response > 0.0 => ABOVE_TOLERANCE * tolerance / response,
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn increments_follow_their_rule() {
        let mut column = Column {
            derivatives: vec![5e-7],
            increment: 0.0,
            is_load: true,
        };
        column.choose_increment(Increment::Relative(1e-5), 333.0, Some(1e-8));
        assert_eq!(column.increment, 1e-5 * 333.0);
        column.choose_increment(Increment::Automatic, 0.0, None);
        assert_eq!(column.increment, 1e-3);
        column.choose_increment(Increment::Automatic, 333.0, Some(1e-8));
        assert!((column.increment * 5e-7 / 1e-8 - 1e3).abs() < 1e-9);
        column.is_load = false;
        column.choose_increment(Increment::Automatic, 5.0, Some(1e-8));
        assert_eq!(column.increment, 1e-6 * 5.0);
    }

    #[test]
    fn a_difference_is_per_unit_of_the_input() {
        let mut column = Column {
            derivatives: Vec::new(),
            increment: 0.5,
            is_load: true,
        };
        column.difference(&[1.0, 2.0], &[1.5, 0.0]);
        assert_eq!(column.derivatives, [1.0, -4.0]);
    }
}
