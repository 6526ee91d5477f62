//! Coupling conditions and Jacobian of the whole scene.

use std::ops::Range;

use super::column::Column;
use super::end_gradients::EndGradients;
use super::entries::visit_entries;
use super::pattern::Pattern;
use super::point::Point;
use super::solve::LinearSolver;
use super::unknowns::Unknowns;
use crate::joint::{Jet, Level, Motion};
use crate::layout::{Border, Layout};

/// `g` and its derivatives `G` with respect to the unknowns on every level. The rows are the conditions of the joints, then
/// those of the exchanged variables: `w - y = 0`, which is the same on every level; but for variables that have their rate
/// at the end of the step as a second unknown `w - y = 0`, `H (w' - y') = 0` and, only to tell `y''`, `-H^2 y''`. Memory is
/// kept from step to step.
pub struct System {
    pub(super) level: Level,
    pub(super) rows: usize,
    /// Conditions of the joints that follow from others.
    pub(super) border: Border,
    pub(super) unknowns: Unknowns,
    /// Parts of all unknowns in the conditions of exchanged variables, by level.
    pub(super) units: Vec<[f64; 3]>,
    pub(super) variables: Vec<Vec<usize>>,
    pub(super) pattern: Pattern,
    pub(super) residuals: [Vec<f64>; 3],
    pub(super) jacobians: [Vec<f64>; 3],
    pub(super) combined_residual: Vec<f64>,
    pub(super) combined_jacobian: Vec<f64>,
    pub(super) rhs: Vec<f64>,
    pub(super) motions: Vec<Motion>,
    /// Factors of the conditions of the joints.
    pub(super) factors: Vec<[Jet; 2]>,
    pub(super) end_gradients: EndGradients,
    pub(super) gradients: Vec<f64>,
    pub(super) gradient_starts: Vec<usize>,
    pub(super) moments: Option<Box<Moments>>,
}

/// The moments `integral of g(s) p_i(s) ds` of every condition on position level, `i = 0, 1, ..`, and their derivatives with respect to
/// the unknowns, as sums over the looks at the inside of the step: integrals of outputs or outputs at instants.
pub struct Moments {
    pub(super) weights: Weights,
    /// The conditions at one look. Those that are linear in outputs are integrated by the integrals of the outputs.
    pub(super) at_look: System,
    /// For each look the parts of all unknowns in the conditions of exchanged variables.
    pub(super) units: Vec<Vec<f64>>,
    /// Whether a condition is that of a connected signal.
    pub(super) is_signal: Vec<bool>,
    /// The coupling outputs at one look, subsystem by subsystem.
    pub(super) outputs: Vec<Vec<f64>>,
    pub(super) columns: Vec<Column>,
    pub(super) residuals: Vec<Vec<f64>>,
    pub(super) jacobians: Vec<Vec<f64>>,
}

/// How the values at the looks make a moment: for each moment one weight for each look. Only looks of the kind that a condition is served by
/// count.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights {
    /// Of conditions of joints and of exchanged motion.
    pub of_motion: Vec<Vec<f64>>,
    /// Of connected signals.
    pub of_signals: Vec<Vec<f64>>,
}

impl System {
    /// The system of `layout` for these unknowns.
    pub fn new(layout: &Layout, unknowns: Unknowns) -> Self {
        Self::up_to(layout.level, layout, unknowns)
    }

    /// The same on position level alone.
    pub(super) fn at_positions(layout: &Layout, unknowns: Unknowns) -> Self {
        Self::up_to(Level::Position, layout, unknowns)
    }

    fn up_to(level: Level, layout: &Layout, unknowns: Unknowns) -> Self {
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
            level,
            rows: layout.rows.len(),
            border: layout.border.clone(),
            units: unknowns.units().to_vec(),
            moments: None,
            unknowns,
            variables,
            residuals: std::array::from_fn(|_| vec![0.0; size]),
            jacobians: std::array::from_fn(|_| vec![0.0; entries]),
            combined_residual: vec![0.0; size],
            combined_jacobian: vec![0.0; entries],
            rhs: vec![0.0; size],
            motions: Vec::with_capacity(layout.joints.len()),
            factors: Vec::with_capacity(layout.rows.len()),
            end_gradients: EndGradients::default(),
            gradients: Vec::new(),
            gradient_starts: Vec::new(),
            pattern,
        }
    }

    /// The unknowns.
    pub fn unknowns(&self) -> &Unknowns {
        &self.unknowns
    }

    /// Gives the unknowns other parts in the values of exchanged variables.
    pub(super) fn set_units(&mut self, units: &[f64]) {
        for (own, unit) in self.units.iter_mut().zip(units) {
            *own = [*unit, 0.0, 0.0];
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

    /// The conditions inside the step, for systems that have them.
    pub fn moments(&self) -> Option<&Moments> {
        self.moments.as_deref()
    }

    /// The system with conditions inside the step as well.
    pub fn with_moments(mut self, moments: Moments) -> Self {
        self.moments = Some(Box::new(moments));
        self
    }

    /// Writes `G change` of one level to `shift`.
    pub fn shift(&self, level: Level, change: &[f64], shift: &mut [f64]) {
        self.pattern
            .multiply(&self.jacobians[level as usize], change, shift);
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

    /// A solver for the equations of one level, or of a sum of them.
    pub fn solver(&self) -> LinearSolver {
        self.solver_of(&self.pattern)
    }

    /// A solver for other equations of the same unknowns.
    pub fn solver_of(&self, pattern: &Pattern) -> LinearSolver {
        let unknowns: Vec<_> = (0..self.rows).map(|row| self.unknowns.of(row)).collect();
        LinearSolver::bordered(pattern, &self.border, &unknowns)
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
