//! Coupling conditions and Jacobian of the whole scene.

use nalgebra::UnitQuaternion;

use super::columns::Column;
use super::layout::{Exchanged, Layout};
use super::pattern::Pattern;
use crate::joint::{End, Level, Motion};

/// `g` and `G = dg/dw` on every level, with `w` the coupling variables: multipliers, then exchanged variables. The rows are
/// the conditions of the joints, then those of the exchanged variables, `w - y = 0`, which are the same on every level.
/// Memory is kept from step to step.
pub struct System {
    level: Level,
    rows: usize,
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
    /// Coupling variables.
    pub w: &'a [f64],
    /// Attitudes to which rotation vectors are relative.
    pub attitudes: &'a [UnitQuaternion<f64>],
}

impl System {
    /// The system of `layout`.
    pub fn new(layout: &Layout) -> Self {
        let size = layout.variables();
        let pattern = Pattern::new(size, |visit| visit_entries(layout, visit));
        let entries = pattern.entries();
        Self {
            level: layout.level,
            rows: layout.rows.len(),
            residuals: std::array::from_fn(|_| vec![0.0; size]),
            jacobians: std::array::from_fn(|_| vec![0.0; entries]),
            combined_residual: vec![0.0; size],
            combined_jacobian: vec![0.0; entries],
            rhs: vec![0.0; size],
            motions: Vec::with_capacity(layout.joints.len()),
            gradients: Vec::new(),
            gradient_starts: Vec::with_capacity(layout.inputs.len() + 1),
            pattern,
        }
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

    /// Conditions and Jacobians at `point`. `outputs(s)` are the coupling outputs of subsystem `s`, `columns` belong to the
    /// inputs of `layout`.
    pub fn assemble<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        columns: &[Column],
        point: Point<'_>,
    ) {
        self.motions.clear();
        let joints = 0..layout.joints.len();
        self.motions
            .extend(joints.map(|joint| motion_of(layout, joint, outputs)));
        self.assemble_residuals(layout, outputs, point);
        self.assemble_jacobians(layout, outputs, columns, point);
    }

    fn assemble_residuals<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        point: Point<'_>,
    ) {
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
            for (component, shown) in shown.iter().take(exchanged.size()).enumerate() {
                let variable = exchanged.first + component;
                for &level in self.level.up_to() {
                    self.residuals[level as usize][variable] = point.w[variable] - shown;
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
        for input in &layout.inputs {
            self.gradient_starts.push(self.gradients.len());
            input.gradient(point.w, point.attitudes, &mut self.gradients);
        }
        self.gradient_starts.push(self.gradients.len());
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
                    if columns[input].derivatives.is_empty() {
                        continue;
                    }
                    let change = bound.change(own, &columns[input].derivatives);
                    for condition in joint.joint.conditions() {
                        let motion = &self.motions[number];
                        let responses = condition.changes(self.level, motion, end, &change);
                        slot = self.spread(input, responses, slot);
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
                self.add(slot, [1.0; 3]);
                slot += 1;
            }
            for input in layout.input_range(exchanged.subsystem) {
                let column = &columns[input].derivatives;
                if column.is_empty() {
                    continue;
                }
                let change = exchanged.change(own, point.attitudes, point.w, column);
                for component in 0..exchanged.size() {
                    slot = self.spread(input, [-change[component]; 3], slot);
                }
            }
        }
    }

    /// Adds the responses of one row to one input, one for each level, to the entries of the variables behind the input.
    fn spread(&mut self, input: usize, responses: [f64; 3], slot: usize) -> usize {
        let gradient = self.gradient_starts[input]..self.gradient_starts[input + 1];
        let next = slot + gradient.len();
        for (slot, factor) in (slot..).zip(gradient) {
            let factor = self.gradients[factor];
            self.add(slot, responses.map(|response| response * factor));
        }
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

    /// Forms `sum_l weight_l g_l` and `sum_l weight_l G_l` over the levels for the rows of joints; the rows of exchanged
    /// variables are the same on every level and stay as they are.
    pub fn combine(&mut self, weights: [f64; 3]) {
        self.combined_residual.fill(0.0);
        self.combined_jacobian.fill(0.0);
        for &level in self.level.up_to() {
            let own = |row: usize| match level {
                _ if row < self.rows => weights[level as usize],
                Level::Position => 1.0,
                Level::Velocity | Level::Acceleration => 0.0,
            };
            let residual = &self.residuals[level as usize];
            for (row, (sum, g)) in self.combined_residual.iter_mut().zip(residual).enumerate() {
                *sum += own(row) * g;
            }
            let jacobian = &self.jacobians[level as usize];
            let sums = self.combined_jacobian.iter_mut().zip(jacobian);
            for ((sum, g), &row) in sums.zip(self.pattern.rows()) {
                *sum += own(row) * g;
            }
        }
    }

    /// `sum_l weight_l G_l` and `-sum_l weight_l g_l`, the latter in memory that may be written over.
    pub fn combined_equation(&mut self) -> (&Pattern, &[f64], &mut [f64]) {
        for (rhs, g) in self.rhs.iter_mut().zip(&self.combined_residual) {
            *rhs = -g;
        }
        (&self.pattern, &self.combined_jacobian, &mut self.rhs)
    }

    /// `G` and `-g` of one level, the latter in memory that may be written over.
    pub fn level_equation(&mut self, level: Level) -> (&Pattern, &[f64], &mut [f64]) {
        for (rhs, g) in self.rhs.iter_mut().zip(&self.residuals[level as usize]) {
            *rhs = -g;
        }
        (
            &self.pattern,
            &self.jacobians[level as usize],
            &mut self.rhs,
        )
    }
}

/// Visits row and column of every term of the Jacobian, in the order in which they are assembled.
fn visit_entries(layout: &Layout, visit: &mut dyn FnMut(usize, usize)) {
    let mut variables = Vec::new();
    let mut first_row = 0;
    for joint in &layout.joints {
        let conditions = joint.joint.len();
        for bound in &joint.ends {
            for input in layout.inputs_of(bound.subsystem) {
                for row in first_row..first_row + conditions {
                    variables.clear();
                    if input.perturbed.is_some() {
                        input.variables(&mut variables);
                    }
                    variables.iter().for_each(|&variable| visit(row, variable));
                }
            }
        }
        first_row += conditions;
    }
    for exchanged in &layout.exchanged {
        visit_exchanged(layout, exchanged, visit);
    }
}

fn visit_exchanged(layout: &Layout, exchanged: &Exchanged, visit: &mut dyn FnMut(usize, usize)) {
    let own = exchanged.first..exchanged.first + exchanged.size();
    own.clone().for_each(|variable| visit(variable, variable));
    let mut variables = Vec::new();
    let perturbed = layout.inputs_of(exchanged.subsystem).iter();
    for input in perturbed.filter(|input| input.perturbed.is_some()) {
        variables.clear();
        input.variables(&mut variables);
        for row in own.clone() {
            variables.iter().for_each(|&variable| visit(row, variable));
        }
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
