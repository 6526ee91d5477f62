//! Columns of the workers' responses: finite differences with respect to their driven inputs (S1 eqs. 62, 63).

use super::layout::Layout;
use crate::cosimulation::Parts;
use crate::scene::Increment;

/// Relative increment when it is chosen automatically. Loads enter nearly linearly, so a large one costs no accuracy
/// and stands above the noise of a solver with step-size control.
const AUTOMATIC: f64 = 1e-3;

/// A response to an increment stands at least this many solver tolerances above zero.
const ABOVE_TOLERANCE: f64 = 1e3;

/// Relative increment of an exchanged variable when it is chosen automatically: its influence is not linear.
const AUTOMATIC_EXCHANGED: f64 = 1e-6;

/// Which increments the columns are formed with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Increments(pub Increment);

/// The columns of all driven inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    rule: Increment,
    columns: Vec<Column>,
}

impl Columns {
    /// One column for each driven input of `layout`.
    pub fn new(Increments(rule): Increments, layout: &Layout) -> Self {
        let column = |input: &super::layout::DrivenInput| Column {
            is_load: input.drives_load(layout.rows.len()),
            ..Column::default()
        };
        Self {
            rule,
            columns: layout.inputs.iter().map(column).collect(),
        }
    }

    /// The columns in the order of the inputs; those of inputs that are not perturbed are empty.
    pub fn all(&self) -> &[Column] {
        &self.columns
    }

    /// Chooses the increment of input number `input`, which is predicted as `value`, and returns it.
    pub fn choose_increment(&mut self, input: usize, value: f64, tolerance: Option<f64>) -> f64 {
        let column = &mut self.columns[input];
        column.choose_increment(self.rule, value, tolerance);
        column.increment
    }

    /// Takes the difference quotients of the last answers of all workers.
    pub fn difference(&mut self, parts: &Parts) {
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
