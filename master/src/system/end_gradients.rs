//! The derivatives of a joint's conditions with respect to what one of its ends tells.

use crate::joint::{End, Jet, Joint, Level, Motion};
use crate::layout::marker::BoundEnd;

/// For each condition and each level the derivatives with respect to the outputs that the end reads, so that the response of
/// a condition to a column is one scalar product, however many columns there are. Memory is kept from step to step.
#[derive(Default)]
pub(super) struct EndGradients {
    values: Vec<f64>,
    /// How many of them a condition has.
    of_condition: usize,
}

impl EndGradients {
    /// Takes the derivatives at this motion, where the conditions have these factors and the subsystem these `outputs`.
    pub(super) fn differentiate(
        &mut self,
        highest: Level,
        (joint, motion, factors): (&Joint, &Motion, &[[Jet; 2]]),
        (end, bound): (End, &BoundEnd),
        outputs: &[f64],
    ) {
        self.values.clear();
        for (condition, factors) in joint.conditions().zip(factors) {
            for &level in highest.up_to() {
                let gradient = condition.gradient(level, (motion, factors), end);
                bound.add_gradient(level, outputs, &gradient, &mut self.values);
            }
        }
        self.of_condition = self.values.len().checked_div(joint.len()).unwrap_or(0);
    }

    /// What condition number `condition` changes by on every level where the outputs change by `column`.
    pub(super) fn responses(
        &self,
        condition: usize,
        highest: Level,
        bound: &BoundEnd,
        column: &[f64],
    ) -> [f64; 3] {
        let mut own = &self.values[condition * self.of_condition..];
        let mut responses = [0.0; 3];
        for &level in highest.up_to() {
            let places = bound.places_up_to(level);
            let (gradient, rest) = own.split_at(places.len());
            let terms = places.iter().zip(gradient);
            responses[level as usize] = terms.map(|(&place, by)| by * column[place]).sum();
            own = rest;
        }
        responses
    }
}
