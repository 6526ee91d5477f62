//! The unknowns of a macro step: what a method solves for of every coupling variable.

use std::ops::Range;

use crate::layout::{DrivenInput, Layout, Source};

/// Which unknowns there are, and how the inputs are raised to learn the response to them.
///
/// The curve of a variable over the step is a known part plus `sum_j unknown_j shape_j`. An input that is a sum of variables
/// is raised in the shapes of its variables, one after the other. The load of a joint whose direction turns is no sum: it
/// is raised in the shapes of the multipliers, which are 1 at one share of the step and 0 at the others; its derivatives
/// are taken at these shares.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknowns {
    starts: Vec<usize>,
    column_starts: Vec<usize>,
    shares: Vec<f64>,
    /// For each variable the values of its shapes at the shares, shape by shape.
    shapes: Vec<Vec<f64>>,
    /// For each unknown its part in value, `H` times the rate and `H^2` times the second derivative of its variable at the end of the step.
    units: Vec<[f64; 3]>,
}

/// A term of the derivative of a raised input: which entry of the input's gradient, times which factor, for which unknown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// Entry of [`DrivenInput::gradient`].
    pub entry: usize,
    /// Number of the unknown.
    pub unknown: usize,
    /// Value of the unknown's shape at the share of the raised node.
    pub factor: f64,
}

impl Unknowns {
    /// One unknown for each variable: its value at the end of the step.
    pub fn ends(layout: &Layout) -> Self {
        let size = layout.variables();
        Self::new(
            layout,
            vec![1.0],
            vec![vec![1.0]; size],
            vec![[1.0; 3]; size],
        )
    }

    /// Unknowns by the values of their shapes at `shares` of the step; `shapes[v]` holds those of variable `v`, shape by
    /// shape. `units` are the parts of all unknowns in the conditions `w - y = 0` of exchanged variables, by level.
    pub fn new(
        layout: &Layout,
        shares: Vec<f64>,
        shapes: Vec<Vec<f64>>,
        units: Vec<[f64; 3]>,
    ) -> Self {
        let numbers = shapes.iter().map(|shapes| shapes.len() / shares.len());
        let starts = sums(numbers);
        let mut unknowns = Self {
            starts,
            column_starts: Vec::new(),
            shares,
            shapes,
            units,
        };
        let raised = layout.inputs.iter().map(|input| unknowns.raised(input));
        unknowns.column_starts = sums(raised);
        unknowns
    }

    /// Number of all unknowns.
    pub fn len(&self) -> usize {
        self.starts.last().copied().unwrap_or(0)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The unknowns of one variable.
    pub fn of(&self, variable: usize) -> Range<usize> {
        self.starts[variable]..self.starts[variable + 1]
    }

    /// Parts of all unknowns in the conditions of exchanged variables, by level.
    pub fn units(&self) -> &[[f64; 3]] {
        &self.units
    }

    /// The variable of an unknown.
    pub fn variable(&self, unknown: usize) -> usize {
        self.starts.partition_point(|&start| start <= unknown) - 1
    }

    /// Shares of the step at which loads are raised.
    pub fn shares(&self) -> &[f64] {
        &self.shares
    }

    /// Numbers of the columns of one input.
    pub fn columns(&self, input: usize) -> Range<usize> {
        self.column_starts[input]..self.column_starts[input + 1]
    }

    /// In how many ways an input is raised.
    fn raised(&self, input: &DrivenInput) -> usize {
        match &input.source {
            Source::Sum(terms) => terms
                .first()
                .map_or(0, |&(variable, _)| self.of(variable).len()),
            Source::Attitude { .. } => 0,
            Source::Load(_) => self.shares.len(),
        }
    }

    /// The variable whose shapes an input is raised in.
    pub fn leading(input: &DrivenInput) -> usize {
        match &input.source {
            Source::Sum(terms) => terms.first().map_or(0, |&(variable, _)| variable),
            Source::Attitude { .. } => 0,
            Source::Load(load) => load.leading(),
        }
    }

    /// Visits the terms of an input that is raised in its shape number `raised`; `variables` are those of the input's
    /// gradient.
    pub fn visit_terms(
        &self,
        input: &DrivenInput,
        variables: &[usize],
        raised: usize,
        visit: &mut dyn FnMut(Term),
    ) {
        for (entry, &variable) in variables.iter().enumerate() {
            let unknowns = self.of(variable);
            match &input.source {
                Source::Sum(_) => visit(Term {
                    entry,
                    unknown: unknowns.start + raised,
                    factor: 1.0,
                }),
                Source::Load(_) | Source::Attitude { .. } => {
                    let shapes = self.shapes[variable].chunks(self.shares.len());
                    for (unknown, shape) in unknowns.zip(shapes) {
                        let factor = shape[raised];
                        if factor != 0.0 {
                            visit(Term {
                                entry,
                                unknown,
                                factor,
                            });
                        }
                    }
                }
            }
        }
    }
}

/// `0, n_0, n_0 + n_1, ...`
fn sums(numbers: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut sums = vec![0];
    for number in numbers {
        sums.push(sums[sums.len() - 1] + number);
    }
    sums
}
