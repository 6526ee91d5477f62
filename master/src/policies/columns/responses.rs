//! Columns from the answers of the workers.

use super::Columns;
use super::basis::Basis;
use crate::layout::Layout;
use crate::system::LookAhead;

impl Columns {
    pub(super) fn take_responses(&mut self, layout: &Layout, ahead: &dyn LookAhead) {
        self.resolution.begin();
        let reached =
            layout.largest_position(|subsystem, place| ahead.unperturbed(subsystem)[place]);
        self.length_ahead = self.sizes.length.max(reached);
        for (number, input) in layout.inputs.iter().enumerate() {
            for (curve, place) in self.raised_of_input[number].clone().enumerate() {
                self.responses[place].clear();
                if let Some(asked) = self.raised[place].place {
                    self.take_response(ahead, asked, (input.subsystem, place));
                    self.judge_response(input.subsystem, (number, curve), place);
                }
            }
        }
        self.resolution.judge();
    }

    /// Takes answer number `asked` of a subsystem.
    fn take_response(
        &mut self,
        ahead: &dyn LookAhead,
        asked: usize,
        (subsystem, place): (usize, usize),
    ) {
        let gives_derivatives = self.gives_derivatives(subsystem);
        let raised = &mut self.raised[place];
        if gives_derivatives {
            raised.derivatives.clear();
            let derivatives = ahead.derivatives(subsystem, asked);
            raised.derivatives.extend_from_slice(derivatives);
        } else {
            let perturbed = ahead.perturbed(subsystem, asked);
            raised.difference(ahead.unperturbed(subsystem), perturbed);
        }
        raised.note_response(&self.positions[subsystem], self.length, self.sizes.length);
        std::mem::swap(&mut self.responses[place], &mut raised.derivatives);
    }

    fn judge_response(&mut self, subsystem: usize, (input, curve): (usize, usize), place: usize) {
        // A constant part of a polynomial acts from the start: the acceleration at the end of the step is none of its conditions.
        let is_part = self.basis == Basis::Powers && curve == 0 && self.needed[place + 1];
        if self.raised[place].is_load && !is_part {
            let shapes = &self.shapes[self.of_input[input].clone()];
            let shape = self.basis.curve(shapes, curve);
            let response = &self.responses[place];
            self.resolution
                .take(subsystem, (curve, &shape), self.length, response);
        }
    }

    /// The columns from the responses in the present step.
    pub(super) fn combine(&mut self) {
        for (columns, raised) in self.of_input.iter().zip(&self.raised_of_input) {
            let responses = &mut self.responses[raised.clone()];
            for (number, column) in columns.clone().enumerate() {
                let derivatives = &mut self.columns[column].derivatives;
                match self.basis {
                    Basis::Shapes => std::mem::swap(derivatives, &mut responses[number]),
                    Basis::Powers => {
                        let coefficients = self.shapes[column].coefficients();
                        add_up(responses.iter().zip(coefficients), derivatives);
                    }
                }
            }
        }
    }
}

/// `sum coefficient response`; responses that are not known have no part in it.
fn add_up<'a>(terms: impl Iterator<Item = (&'a Vec<f64>, &'a f64)>, sums: &mut Vec<f64>) {
    sums.clear();
    for (response, coefficient) in terms {
        sums.resize(sums.len().max(response.len()), 0.0);
        for (sum, one) in sums.iter_mut().zip(response) {
            *sum += coefficient * one;
        }
    }
}
