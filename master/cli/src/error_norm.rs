//! Errors of a run against an exact solution.

use linchpin_master::results::Row;

use crate::closed_form::{ClosedForm, Quantity};

/// Error of one column over the macro points seen so far.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ColumnError {
    squares: f64,
    exact_squares: f64,
    largest: f64,
}

impl ColumnError {
    /// Takes the value at one macro point.
    pub fn add(&mut self, value: f64, exact: f64) {
        let error = value - exact;
        self.squares += error * error;
        self.exact_squares += exact * exact;
        self.largest = self.largest.max(error.abs());
    }

    /// Root mean square of the error over that of the exact values (NRMS): 0 where there is no error, infinite where there is one
    /// of nothing.
    pub fn normalised(&self) -> f64 {
        if self.squares == 0.0 {
            return 0.0;
        }
        (self.squares / self.exact_squares).sqrt()
    }

    /// Largest absolute error.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// The errors of several columns as one: the error of the vector of their values.
    pub fn together(errors: impl IntoIterator<Item = Self>) -> Self {
        errors.into_iter().fold(Self::default(), |sum, error| Self {
            squares: sum.squares + error.squares,
            exact_squares: sum.exact_squares + error.exact_squares,
            largest: sum.largest.max(error.largest),
        })
    }
}

/// Compares rows with the closed form of their scene.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorMeter {
    closed_form: ClosedForm,
    columns: Vec<(usize, String, Quantity, ColumnError)>,
}

impl ErrorMeter {
    /// A meter for rows like `row`.
    pub fn new(closed_form: ClosedForm, row: &Row) -> Self {
        let known = row
            .columns()
            .iter()
            .enumerate()
            .filter_map(|(place, name)| {
                let quantity = closed_form.quantity(name)?;
                Some((place, name.clone(), quantity, ColumnError::default()))
            });
        Self {
            columns: known.collect(),
            closed_form,
        }
    }

    /// Takes the values of the row of one macro point.
    pub fn add(&mut self, values: &[f64]) {
        let t = values[0];
        for (place, _, quantity, error) in &mut self.columns {
            if let Some(exact) = self.closed_form.value(*quantity, t) {
                error.add(values[*place], exact);
            }
        }
    }

    /// Name and error of every column that has an exact value.
    pub fn errors(&self) -> impl Iterator<Item = (&str, &ColumnError)> {
        self.columns
            .iter()
            .map(|(_, name, _, error)| (name.as_str(), error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(points: &[(f64, f64)]) -> ColumnError {
        let mut error = ColumnError::default();
        points
            .iter()
            .for_each(|(value, exact)| error.add(*value, *exact));
        error
    }

    #[test]
    fn what_is_right_has_no_error_whatever_its_size() {
        for exact in [0.0, 1e-200, 3.0, 1e200] {
            assert_eq!(error(&[(exact, exact), (exact, exact)]).normalised(), 0.0);
        }
        assert_eq!(ColumnError::default().normalised(), 0.0);
    }

    #[test]
    fn an_error_of_nothing_is_relative_to_nothing() {
        assert_eq!(error(&[(1e-17, 0.0)]).normalised(), f64::INFINITY);
        assert_eq!(
            error(&[(3.0, 0.0), (4.0, 5.0)]).normalised(),
            (10.0 / 25.0_f64).sqrt()
        );
    }
}
