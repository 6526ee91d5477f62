//! The derivatives of the conditions with respect to the unknowns.

use super::column::Column;
use super::equations::System;
use super::point::Point;
use crate::joint::End;
use crate::layout::{DrivenInput, Layout};

impl System {
    /// Chain rule of S1 eq. (67): analytic derivatives of the joints times the workers' columns times the derivatives of the
    /// inputs with respect to the coupling variables.
    pub(super) fn assemble_jacobians<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        columns: &[Column],
        point: Point<'_>,
    ) {
        self.differentiate_inputs(layout, point);
        self.assemble_responses(layout, outputs, columns, point);
    }

    /// The same with the derivatives of the inputs as they are.
    pub(super) fn assemble_responses<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        columns: &[Column],
        point: Point<'_>,
    ) {
        for &level in self.level.up_to() {
            self.jacobians[level as usize].fill(0.0);
        }
        let slot = self.add_joints(layout, outputs, columns);
        self.add_exchanged(layout, outputs, columns, point, slot);
    }

    pub(super) fn differentiate_inputs(&mut self, layout: &Layout, point: Point<'_>) {
        self.gradients.clear();
        self.gradient_starts.clear();
        for (number, input) in layout.inputs.iter().enumerate() {
            for raised in 0..self.unknowns.columns(number).len() {
                self.gradient_starts.push(self.gradients.len());
                input.gradient(point.at(raised), point.attitudes, &mut self.gradients);
            }
        }
    }

    /// In the order of [`super::entries::visit_entries`].
    fn add_joints<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64],
        columns: &[Column],
    ) -> usize {
        let (mut slot, mut first_row) = (0, 0);
        let mut gradients = std::mem::take(&mut self.end_gradients);
        for (number, joint) in layout.joints.iter().enumerate() {
            let rows = first_row..first_row + joint.joint.len();
            for end in End::BOTH {
                let bound = &joint.ends[end as usize];
                let factors = &self.factors[rows.clone()];
                let at = (&*joint.joint, &self.motions[number], factors);
                gradients.differentiate(self.level, at, (end, bound), outputs(bound.subsystem));
                for input in layout.input_range(bound.subsystem) {
                    for (raised, column) in self.unknowns.columns(input).enumerate() {
                        if columns[column].derivatives.is_empty() {
                            continue;
                        }
                        let derivatives = &columns[column].derivatives;
                        let raised = Raised::new(layout, input, raised, column);
                        for condition in 0..joint.joint.len() {
                            let responses =
                                gradients.responses(condition, self.level, bound, derivatives);
                            slot = self.spread(raised, responses, slot);
                        }
                    }
                }
            }
            first_row = rows.end;
        }
        self.end_gradients = gradients;
        slot
    }

    fn add_exchanged<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64],
        columns: &[Column],
        point: Point<'_>,
        mut slot: usize,
    ) {
        for exchanged in &layout.exchanged {
            let own = outputs(exchanged.subsystem);
            let shown = exchanged.read(own, point.attitudes, point.w);
            for variable in exchanged.first..exchanged.first + exchanged.size() {
                for unknown in self.unknowns.of(variable) {
                    self.add(slot, self.units[unknown]);
                    slot += 1;
                }
            }
            for input in layout.input_range(exchanged.subsystem) {
                for (raised, column) in self.unknowns.columns(input).enumerate() {
                    let derivatives = &columns[column].derivatives;
                    if derivatives.is_empty() {
                        continue;
                    }
                    let unknowns = (&self.unknowns, self.level);
                    let changes =
                        exchanged.changes(unknowns, (own, &shown), point.step, derivatives);
                    let raised = Raised::new(layout, input, raised, column);
                    for component in 0..exchanged.size() {
                        let responses = changes.map(|change| -change[component]);
                        slot = self.spread(raised, responses, slot);
                    }
                }
            }
        }
    }

    /// Adds the responses of one row to one raised input, one for each level, to the entries of the unknowns behind the
    /// input.
    fn spread(&mut self, raised: Raised<'_>, responses: [f64; 3], slot: usize) -> usize {
        let Self {
            unknowns,
            variables,
            gradients,
            gradient_starts,
            jacobians,
            pattern,
            level,
            ..
        } = self;
        let gradient = &gradients[gradient_starts[raised.column]..];
        let mut next = slot;
        unknowns.visit_terms(
            raised.input,
            &variables[raised.number],
            raised.raised,
            &mut |term| {
                let factor = gradient[term.entry] * term.factor;
                let entry = pattern.entry(next);
                for &level in level.up_to() {
                    jacobians[level as usize][entry] += responses[level as usize] * factor;
                }
                next += 1;
            },
        );
        next
    }

    fn add(&mut self, slot: usize, values: [f64; 3]) {
        let entry = self.pattern.entry(slot);
        for &level in self.level.up_to() {
            self.jacobians[level as usize][entry] += values[level as usize];
        }
    }

    /// Writes for each column how far its input is raised in its shape where the unknowns change by `change`.
    pub fn raise(&self, layout: &Layout, change: &[f64], raised: &mut Vec<f64>) {
        raised.clear();
        for (number, input) in layout.inputs.iter().enumerate() {
            for (shape, column) in self.unknowns.columns(number).enumerate() {
                let gradient = &self.gradients[self.gradient_starts[column]..];
                let mut sum = 0.0;
                self.unknowns
                    .visit_terms(input, &self.variables[number], shape, &mut |term| {
                        sum += gradient[term.entry] * term.factor * change[term.unknown];
                    });
                raised.push(sum);
            }
        }
    }
}

/// An input that is raised in one of its shapes.
#[derive(Clone, Copy)]
struct Raised<'a> {
    input: &'a DrivenInput,
    /// Its number.
    number: usize,
    /// Number of the shape.
    raised: usize,
    /// Number of its column.
    column: usize,
}

impl<'a> Raised<'a> {
    fn new(layout: &'a Layout, number: usize, raised: usize, column: usize) -> Self {
        Self {
            input: &layout.inputs[number],
            number,
            raised,
            column,
        }
    }
}
