//! The equations of all unknowns of a macro step.

use super::variant::Variant;
use crate::joint::Level;
use crate::layout::Layout;
use crate::system::System;
use crate::system::pattern::Pattern;

/// The conditions of one macro step, one for each unknown: of a joint's row `g'' = 0` at the start where the variant has it
/// and the variant's conditions at the end, of exchanged motion `w - y = 0` and `H (w' - y') = 0`, of a connected signal
/// `w - y = 0`. Positions of joints are divided by `H^2` and velocities by `H`: all rows of a joint then have the size of
/// an acceleration.
pub struct Stack {
    pattern: Pattern,
    jacobian: Vec<f64>,
    residual: Vec<f64>,
    rhs: Vec<f64>,
    rows: Vec<StackedRow>,
    /// Number of joint rows.
    joint_rows: usize,
}

/// The conditions of one row of the coupling system.
struct StackedRow {
    first: usize,
    starts_anew: bool,
    ends: &'static [Level],
}

impl StackedRow {
    fn of_end(&self) -> impl Iterator<Item = (usize, Level)> {
        let first = self.first + usize::from(self.starts_anew);
        (first..).zip(self.ends.iter().copied())
    }
}

impl Stack {
    /// The equations of a variant; `end` is the system at the end of the step, `start` that at its start.
    pub fn new(layout: &Layout, variant: Variant, end: &System, start: Option<&System>) -> Self {
        let joint_rows = layout.rows.len();
        let mut rows = Vec::with_capacity(layout.variables());
        for variable in 0..layout.variables() {
            let unknowns = end.unknowns().of(variable);
            let is_joint = variable < joint_rows;
            let ends = match unknowns.len() {
                _ if is_joint => variant.ends(),
                1 => &[Level::Position],
                _ => &[Level::Position, Level::Velocity][..],
            };
            rows.push(StackedRow {
                first: unknowns.start,
                starts_anew: is_joint && variant.starts_anew(),
                ends,
            });
        }
        let size = end.unknowns().len();
        let visit = |visit: &mut dyn FnMut(usize, usize)| {
            visit_end(&rows, end, &mut |row, _, entry| {
                visit(row, end.pattern().columns()[entry]);
            });
            if let Some(start) = start {
                visit_start(&rows, joint_rows, end, start, &mut |row, column, _| {
                    visit(row, column);
                });
            }
        };
        let pattern = Pattern::new(size, visit);
        Self {
            jacobian: vec![0.0; pattern.entries()],
            residual: vec![0.0; size],
            rhs: vec![0.0; size],
            pattern,
            rows,
            joint_rows,
        }
    }

    /// Which entries the Jacobian may have.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Puts the Jacobian together for a step of length `step`.
    pub fn assemble_jacobian(&mut self, end: &System, start: Option<&System>, step: f64) {
        let Self {
            pattern,
            jacobian,
            rows,
            joint_rows,
            ..
        } = self;
        jacobian.fill(0.0);
        let mut slot = 0;
        visit_end(rows, end, &mut |_, level, entry| {
            let row = end.pattern().rows()[entry];
            let scale = scale(level, row < *joint_rows, step);
            jacobian[pattern.entry(slot)] += scale * end.jacobian(level)[entry];
            slot += 1;
        });
        let Some(start) = start else { return };
        visit_start(rows, *joint_rows, end, start, &mut |_, _, entry| {
            jacobian[pattern.entry(slot)] += start.jacobian(Level::Acceleration)[entry];
            slot += 1;
        });
    }

    /// Puts the conditions at the end together; those at the start are met.
    pub fn assemble_end(&mut self, end: &System, step: f64) {
        for (number, row) in self.rows.iter().enumerate() {
            if row.starts_anew {
                self.residual[row.first] = 0.0;
            }
            for (place, level) in row.of_end() {
                let scale = scale(level, number < self.joint_rows, step);
                self.residual[place] = scale * end.residual(level)[number];
            }
        }
    }

    /// Puts the conditions at the start together.
    pub fn assemble_start(&mut self, start: &System) {
        for (number, row) in self.rows.iter().enumerate() {
            if row.starts_anew {
                self.residual[row.first] = start.residual(Level::Acceleration)[number];
            }
        }
    }

    /// The Jacobian and minus the conditions, the latter in memory that may be written over.
    pub fn equation(&mut self) -> (&Pattern, &[f64], &mut [f64]) {
        self.rhs();
        (&self.pattern, &self.jacobian, &mut self.rhs)
    }

    /// Minus the conditions, in memory that may be written over.
    pub fn rhs(&mut self) -> &mut [f64] {
        for (rhs, g) in self.rhs.iter_mut().zip(&self.residual) {
            *rhs = -g;
        }
        &mut self.rhs
    }
}

fn scale(level: Level, is_joint: bool, step: f64) -> f64 {
    match level {
        _ if !is_joint => 1.0,
        Level::Position => 1.0 / (step * step),
        Level::Velocity => 1.0 / step,
        Level::Acceleration => 1.0,
    }
}

/// Visits stacked row, level and entry of the end's Jacobian.
fn visit_end(rows: &[StackedRow], end: &System, visit: &mut dyn FnMut(usize, Level, usize)) {
    for (entry, &row) in end.pattern().rows().iter().enumerate() {
        for (place, level) in rows[row].of_end() {
            visit(place, level, entry);
        }
    }
}

/// Visits stacked row and column, and the entry of the start's Jacobian: multipliers at the start change accelerations.
fn visit_start(
    rows: &[StackedRow],
    joint_rows: usize,
    end: &System,
    start: &System,
    visit: &mut dyn FnMut(usize, usize, usize),
) {
    let places = start.pattern().rows().iter().zip(start.pattern().columns());
    for (entry, (&row, &variable)) in places.enumerate() {
        if rows[row].starts_anew && variable < joint_rows {
            visit(rows[row].first, end.unknowns().of(variable).start, entry);
        }
    }
}
