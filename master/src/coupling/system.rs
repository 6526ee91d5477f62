//! Coupling conditions and Jacobian of the whole scene.

use std::ops::Range;

use nalgebra::UnitQuaternion;

use super::columns::Column;
use super::layout::{DrivenInput, Layout};
use super::pattern::Pattern;
use super::unknowns::{Term, Unknowns};
use crate::joint::{End, Level, Motion, ROUNDING};

/// `g` and its derivatives `G` with respect to the unknowns on every level. The rows are the conditions of the joints, then
/// those of the exchanged variables: `w - y = 0`, which is the same on every level; but for variables that have their rate
/// at the end of the step as a second unknown `w - y = 0`, `H (w' - y') = 0` and, only to tell `y''`, `-H^2 y''`. Memory is
/// kept from step to step.
pub struct System {
    level: Level,
    rows: usize,
    unknowns: Unknowns,
    variables: Vec<Vec<usize>>,
    pattern: Pattern,
    residuals: [Vec<f64>; 3],
    jacobians: [Vec<f64>; 3],
    combined_residual: Vec<f64>,
    combined_jacobian: Vec<f64>,
    rhs: Vec<f64>,
    motions: Vec<Motion>,
    gradients: Vec<f64>,
    gradient_starts: Vec<usize>,
}

/// The values about which the system is linearised.
#[derive(Clone, Copy)]
pub struct Point<'a> {
    /// Coupling variables at the end of the step.
    pub w: &'a [f64],
    /// Coupling variables at the shares of the step at which loads are raised, without the last one, which is the end.
    pub inner: &'a [Vec<f64>],
    /// `H w'` at the end of the step, looked at for variables that have it as an unknown.
    pub rates: &'a [f64],
    /// `H`
    pub step: f64,
    /// Attitudes to which rotation vectors are relative.
    pub attitudes: &'a [UnitQuaternion<f64>],
}

impl<'a> Point<'a> {
    /// A point where the only unknowns are the values at the end of the step.
    pub fn ends(w: &'a [f64], attitudes: &'a [UnitQuaternion<f64>]) -> Self {
        Self {
            w,
            inner: &[],
            rates: &[],
            step: 0.0,
            attitudes,
        }
    }

    /// Coupling variables at share number `share`.
    fn at(&self, share: usize) -> &'a [f64] {
        self.inner.get(share).map_or(self.w, Vec::as_slice)
    }
}

impl System {
    /// The system of `layout` for these unknowns.
    pub fn new(layout: &Layout, unknowns: Unknowns) -> Self {
        let size = layout.variables();
        let variables = layout.inputs.iter().map(|input| {
            let mut variables = Vec::new();
            input.variables(&mut variables);
            variables
        });
        let variables: Vec<_> = variables.collect();
        let pattern = Pattern::new(unknowns.len(), |visit| {
            visit_entries(layout, &unknowns, &variables, visit);
        });
        let entries = pattern.entries();
        Self {
            level: layout.level,
            rows: layout.rows.len(),
            unknowns,
            variables,
            residuals: std::array::from_fn(|_| vec![0.0; size]),
            jacobians: std::array::from_fn(|_| vec![0.0; entries]),
            combined_residual: vec![0.0; size],
            combined_jacobian: vec![0.0; entries],
            rhs: vec![0.0; size],
            motions: Vec::with_capacity(layout.joints.len()),
            gradients: Vec::new(),
            gradient_starts: Vec::new(),
            pattern,
        }
    }

    /// The unknowns.
    pub fn unknowns(&self) -> &Unknowns {
        &self.unknowns
    }

    /// Highest level.
    pub fn level(&self) -> Level {
        self.level
    }

    /// Which entries of the Jacobians may differ from 0.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// `g`, `g'` or `g''` of every row as last assembled.
    pub fn residual(&self, level: Level) -> &[f64] {
        &self.residuals[level as usize]
    }

    /// `G` of one level, entry by entry of the pattern.
    pub fn jacobian(&self, level: Level) -> &[f64] {
        &self.jacobians[level as usize]
    }

    /// Conditions and Jacobians at `point`. `outputs(s)` are the coupling outputs of subsystem `s`, `columns` belong to the
    /// inputs of `layout`.
    pub fn assemble<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        columns: &[Column],
        point: Point<'_>,
    ) {
        self.assemble_residuals(layout, outputs, point);
        self.assemble_jacobians(layout, outputs, columns, point);
    }

    /// Only the conditions; the Jacobians stay as they are.
    pub fn assemble_residuals<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        point: Point<'_>,
    ) {
        self.motions.clear();
        let joints = 0..layout.joints.len();
        self.motions
            .extend(joints.map(|joint| motion_of(layout, joint, outputs)));
        let mut row = 0;
        for (joint, motion) in layout.joints.iter().zip(&self.motions) {
            for condition in joint.joint.conditions() {
                let values = condition.values(self.level, motion);
                for &level in self.level.up_to() {
                    self.residuals[level as usize][row] = values[level as usize];
                }
                row += 1;
            }
        }
        for exchanged in &layout.exchanged {
            let shown = exchanged.read(outputs(exchanged.subsystem), point.attitudes, point.w);
            let variables = exchanged.first..exchanged.first + exchanged.size();
            for (&shown, variable) in shown.iter().zip(variables) {
                for &level in self.level.up_to() {
                    self.residuals[level as usize][variable] = point.w[variable] - shown;
                }
            }
            if let Some(rates) = exchanged.rates_among(&self.unknowns) {
                let own = outputs(exchanged.subsystem);
                let phi = exchanged.vector(&shown);
                let speed = rates.speed(own, &phi);
                let acceleration = rates.acceleration(own);
                for component in 0..exchanged.size() {
                    let variable = exchanged.first + component;
                    self.residuals[Level::Velocity as usize][variable] =
                        point.rates[variable] - point.step * speed[component];
                    self.residuals[Level::Acceleration as usize][variable] =
                        -point.step * point.step * acceleration[component];
                }
            }
        }
    }

    /// Chain rule of S1 eq. (67): analytic derivatives of the joints times the workers' columns times the derivatives of the
    /// inputs with respect to the coupling variables.
    fn assemble_jacobians<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        columns: &[Column],
        point: Point<'_>,
    ) {
        for &level in self.level.up_to() {
            self.jacobians[level as usize].fill(0.0);
        }
        self.differentiate_inputs(layout, point);
        let slot = self.add_joints(layout, outputs, columns);
        self.add_exchanged(layout, outputs, columns, point, slot);
    }

    fn differentiate_inputs(&mut self, layout: &Layout, point: Point<'_>) {
        self.gradients.clear();
        self.gradient_starts.clear();
        for (number, input) in layout.inputs.iter().enumerate() {
            for raised in 0..self.unknowns.columns(number).len() {
                self.gradient_starts.push(self.gradients.len());
                input.gradient(point.at(raised), point.attitudes, &mut self.gradients);
            }
        }
    }

    /// In the order of [`visit_entries`].
    fn add_joints<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64],
        columns: &[Column],
    ) -> usize {
        let mut slot = 0;
        for (number, joint) in layout.joints.iter().enumerate() {
            for end in End::BOTH {
                let bound = &joint.ends[end as usize];
                let own = outputs(bound.subsystem);
                for input in layout.input_range(bound.subsystem) {
                    for (raised, column) in self.unknowns.columns(input).enumerate() {
                        if columns[column].derivatives.is_empty() {
                            continue;
                        }
                        let change = bound.change(own, &columns[column].derivatives);
                        let raised = Raised {
                            input: &layout.inputs[input],
                            number: input,
                            raised,
                            column,
                        };
                        for condition in joint.joint.conditions() {
                            let motion = &self.motions[number];
                            let responses = condition.changes(self.level, motion, end, &change);
                            slot = self.spread(raised, responses, slot);
                        }
                    }
                }
            }
        }
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
            for _ in 0..exchanged.size() {
                for unit in exchanged.units(&self.unknowns) {
                    self.add(slot, *unit);
                    slot += 1;
                }
            }
            for input in layout.input_range(exchanged.subsystem) {
                for (raised, column) in self.unknowns.columns(input).enumerate() {
                    let derivatives = &columns[column].derivatives;
                    if derivatives.is_empty() {
                        continue;
                    }
                    let changes = exchanged.changes(&self.unknowns, own, point, derivatives);
                    let raised = Raised {
                        input: &layout.inputs[input],
                        number: input,
                        raised,
                        column,
                    };
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

    /// Writes `G change` of one level to `shift`.
    pub fn shift(&self, level: Level, change: &[f64], shift: &mut [f64]) {
        self.pattern
            .multiply(&self.jacobians[level as usize], change, shift);
    }

    /// Takes what is rounding in the residuals as 0, so that a condition that is met asks for no change.
    pub fn drop_rounding(&mut self, layout: &Layout, point: Point<'_>) {
        let mut row = 0;
        for (joint, motion) in layout.joints.iter().zip(&self.motions) {
            for condition in joint.joint.conditions() {
                for &level in self.level.up_to() {
                    let residual = &mut self.residuals[level as usize][row];
                    drop_below(ROUNDING * condition.extent(level, motion), residual);
                }
                row += 1;
            }
        }
        for (row, variable) in point.w.iter().enumerate().skip(self.rows) {
            for &level in self.level.up_to() {
                drop_below(
                    ROUNDING * variable.abs(),
                    &mut self.residuals[level as usize][row],
                );
            }
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

    /// Numbers of the columns of one subsystem.
    pub fn columns_of(&self, layout: &Layout, subsystem: usize) -> Range<usize> {
        let inputs = layout.input_range(subsystem);
        let columns = inputs.map(|input| self.unknowns.columns(input));
        columns
            .reduce(|all, own| all.start..own.end)
            .unwrap_or_default()
    }

    /// Forms `sum_l weight_l g_l` and `sum_l weight_l G_l` over the levels for the rows of joints; the rows of exchanged
    /// variables are the same on every level and stay as they are.
    pub fn combine(&mut self, weights: [f64; 3]) {
        self.combine_residuals(weights);
        self.combined_jacobian.fill(0.0);
        for &level in self.level.up_to() {
            let jacobian = &self.jacobians[level as usize];
            let sums = self.combined_jacobian.iter_mut().zip(jacobian);
            for ((sum, g), &row) in sums.zip(self.pattern.rows()) {
                *sum += weight_of_row(row < self.rows, level, weights) * g;
            }
        }
    }

    /// Forms `sum_l weight_l g_l` alone.
    pub fn combine_residuals(&mut self, weights: [f64; 3]) {
        self.combined_residual.fill(0.0);
        for &level in self.level.up_to() {
            let residual = &self.residuals[level as usize];
            for (row, (sum, g)) in self.combined_residual.iter_mut().zip(residual).enumerate() {
                *sum += weight_of_row(row < self.rows, level, weights) * g;
            }
        }
    }

    /// `sum_l weight_l G_l` and `-sum_l weight_l g_l`, the latter in memory that may be written over.
    pub fn combined_equation(&mut self) -> (&Pattern, &[f64], &mut [f64]) {
        negate(&self.combined_residual, &mut self.rhs);
        (&self.pattern, &self.combined_jacobian, &mut self.rhs)
    }

    /// `-sum_l weight_l g_l`, in memory that may be written over.
    pub fn combined_rhs(&mut self) -> &mut [f64] {
        self.combined_equation().2
    }

    /// `G` and `-g` of one level, the latter in memory that may be written over.
    pub fn level_equation(&mut self, level: Level) -> (&Pattern, &[f64], &mut [f64]) {
        negate(&self.residuals[level as usize], &mut self.rhs);
        (
            &self.pattern,
            &self.jacobians[level as usize],
            &mut self.rhs,
        )
    }

    /// `-g` of one level, in memory that may be written over.
    pub fn level_rhs(&mut self, level: Level) -> &mut [f64] {
        self.level_equation(level).2
    }
}

/// The rows of exchanged variables are the same on every level, so they count once.
fn weight_of_row(is_of_joint: bool, level: Level, weights: [f64; 3]) -> f64 {
    match level {
        _ if is_of_joint => weights[level as usize],
        Level::Position => 1.0,
        Level::Velocity | Level::Acceleration => 0.0,
    }
}

fn negate(values: &[f64], rhs: &mut [f64]) {
    for (rhs, value) in rhs.iter_mut().zip(values) {
        *rhs = -value;
    }
}

fn drop_below(least: f64, residual: &mut f64) {
    if residual.abs() <= least {
        *residual = 0.0;
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

/// Visits row and column of every term of the Jacobian, in the order in which they are assembled.
fn visit_entries(
    layout: &Layout,
    unknowns: &Unknowns,
    variables: &[Vec<usize>],
    visit: &mut dyn FnMut(usize, usize),
) {
    let visit_row = |subsystem: usize, rows: Range<usize>, visit: &mut dyn FnMut(usize, usize)| {
        for input in layout.input_range(subsystem) {
            let driven = &layout.inputs[input];
            if !driven.is_perturbed {
                continue;
            }
            for raised in 0..unknowns.columns(input).len() {
                for row in rows.clone() {
                    let mut visit = |term: Term| visit(row, term.unknown);
                    unknowns.visit_terms(driven, &variables[input], raised, &mut visit);
                }
            }
        }
    };
    let mut first_row = 0;
    for joint in &layout.joints {
        let rows = first_row..first_row + joint.joint.len();
        for bound in &joint.ends {
            visit_row(bound.subsystem, rows.clone(), visit);
        }
        first_row = rows.end;
    }
    for exchanged in &layout.exchanged {
        let own = exchanged.first..exchanged.first + exchanged.size();
        for variable in own.clone() {
            unknowns
                .of(variable)
                .for_each(|unknown| visit(variable, unknown));
        }
        visit_row(exchanged.subsystem, own, visit);
    }
}

/// What joint number `joint` reads of the motion of its two markers; levels that the layout does not have stay 0 and are
/// not read.
pub fn motion_of<'a>(
    layout: &Layout,
    joint: usize,
    outputs: impl Fn(usize) -> &'a [f64],
) -> Motion {
    let ends = &layout.joints[joint].ends;
    ends.each_ref()
        .map(|end| end.motion(outputs(end.subsystem)))
}
