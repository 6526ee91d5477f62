//! Coupling conditions and Jacobian of the whole scene.

use faer::{Mat, unzip, zip};

use super::columns::Column;
use super::layout::{BoundJoint, Layout};
use crate::cosimulation::Parts;
use crate::joint::{End, Level, Motion};

/// `g` and `G = dg/dw` on every level, with `w` the multipliers; memory is kept from step to step.
pub struct System {
    level: Level,
    residuals: [Vec<f64>; 3],
    jacobians: [Mat<f64>; 3],
    combined_residual: Vec<f64>,
    combined_jacobian: Mat<f64>,
    rhs: Vec<f64>,
}

impl System {
    /// A system of `rows` rows on the levels up to `level`.
    pub fn new(rows: usize, level: Level) -> Self {
        Self {
            level,
            residuals: std::array::from_fn(|_| vec![0.0; rows]),
            jacobians: std::array::from_fn(|_| Mat::zeros(rows, rows)),
            combined_residual: vec![0.0; rows],
            combined_jacobian: Mat::zeros(rows, rows),
            rhs: vec![0.0; rows],
        }
    }

    /// Highest level.
    pub fn level(&self) -> Level {
        self.level
    }

    /// `g`, `g'` or `g''` of every row as last assembled.
    pub fn residual(&self, level: Level) -> &[f64] {
        &self.residuals[level as usize]
    }

    /// `dg/dw` on a level as last assembled.
    pub fn jacobian(&self, level: Level) -> &Mat<f64> {
        &self.jacobians[level as usize]
    }

    /// Assembles conditions and Jacobians from the last prediction of all subsystems and its perturbed steps.
    pub fn assemble(&mut self, parts: &Parts, columns: &mut [Column]) {
        let layout = &parts.layout;
        let predicted = |subsystem: usize| parts.subsystems[subsystem].predicted();
        for (input, column) in layout.inputs.iter().zip(&mut *columns) {
            let perturbed = &parts.subsystems[input.subsystem].reply.perturbed[input.place];
            column.difference(predicted(input.subsystem), &perturbed.values);
        }
        self.assemble_residuals(layout, predicted);
        self.assemble_jacobians(layout, predicted, columns);
    }

    /// Evaluates the conditions of all joints. `outputs[s]` are the coupling outputs of subsystem `s`.
    pub fn assemble_residuals<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
    ) {
        for (number, row) in layout.rows.iter().enumerate() {
            let motion = motion_of(layout, row.joint, outputs);
            let law = &layout.joints[row.joint].law;
            for &level in self.level.up_to() {
                self.residuals[level as usize][number] =
                    law.condition(row.condition, level, &motion);
            }
        }
    }

    /// Chain rule of S1 eq. (67): analytic derivatives of the joints times the workers' columns.
    pub fn assemble_jacobians<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        columns: &[Column],
    ) {
        for &level in self.level.up_to() {
            self.jacobians[level as usize].fill(0.0);
        }
        for row in 0..layout.rows.len() {
            let motion = motion_of(layout, layout.rows[row].joint, outputs);
            for end in End::BOTH {
                self.add_end(layout, row, end, &motion, columns);
            }
        }
    }

    fn add_end(
        &mut self,
        layout: &Layout,
        row: usize,
        end: End,
        motion: &Motion,
        columns: &[Column],
    ) {
        let condition = layout.rows[row].condition;
        let BoundJoint { law, ends, .. } = layout.joint_of(row);
        let bound = &ends[end as usize];
        let own = layout.input_range(bound.subsystem);
        for (input, column) in layout.inputs[own.clone()].iter().zip(&columns[own]) {
            for &level in self.level.up_to() {
                let mut response = 0.0;
                for &of in level.up_to() {
                    for (component, &place) in bound.outputs[of as usize].iter().enumerate() {
                        let gradient = law.gradient(condition, level, motion, end, of, component);
                        response += gradient * column.derivatives[place];
                    }
                }
                for &(variable, factor) in &input.combination {
                    self.jacobians[level as usize][(row, variable)] += response * factor;
                }
            }
        }
    }

    /// Writes `G change` of one level to `shift`.
    pub fn shift(&self, level: Level, change: &[f64], shift: &mut [f64]) {
        let jacobian = &self.jacobians[level as usize];
        for (row, shift) in shift.iter_mut().enumerate() {
            let products = change
                .iter()
                .enumerate()
                .map(|(w, change)| jacobian[(row, w)] * change);
            *shift = products.sum();
        }
    }

    /// Forms `sum_l weight_l g_l` and `sum_l weight_l G_l` over the levels.
    pub fn combine(&mut self, weights: [f64; 3]) {
        self.combined_residual.fill(0.0);
        self.combined_jacobian.fill(0.0);
        for &level in self.level.up_to() {
            let weight = weights[level as usize];
            let rows = self
                .combined_residual
                .iter_mut()
                .zip(&self.residuals[level as usize]);
            rows.for_each(|(sum, g)| *sum += weight * g);
            let jacobian = &self.jacobians[level as usize];
            zip!(&mut self.combined_jacobian, jacobian)
                .for_each(|unzip!(sum, g)| *sum += weight * *g);
        }
    }

    /// `sum_l weight_l g_l`
    pub fn combined_residual(&self) -> &[f64] {
        &self.combined_residual
    }

    /// `sum_l weight_l G_l`
    pub fn combined_jacobian(&self) -> &Mat<f64> {
        &self.combined_jacobian
    }

    /// `G` and `-g` of one level, the latter in memory that may be written over.
    pub fn level_equation(&mut self, level: Level) -> (&Mat<f64>, &mut [f64]) {
        for (rhs, g) in self.rhs.iter_mut().zip(&self.residuals[level as usize]) {
            *rhs = -g;
        }
        (&self.jacobians[level as usize], &mut self.rhs)
    }
}

/// What joint number `joint` reads of the motion of its two markers; levels that the layout does not have stay 0 and are
/// not read.
pub fn motion_of<'a>(
    layout: &Layout,
    joint: usize,
    outputs: impl Fn(usize) -> &'a [f64],
) -> Motion {
    let mut motion = Motion::default();
    for (motion, end) in motion.iter_mut().zip(&layout.joints[joint].ends) {
        let values = outputs(end.subsystem);
        for (motion, places) in motion.iter_mut().zip(&end.outputs) {
            for (component, &place) in motion.iter_mut().zip(places) {
                *component = values[place];
            }
        }
    }
    motion
}
