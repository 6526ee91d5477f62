//! The equations of all unknowns of a macro step.

use super::variant::{ENDS, Family};
use crate::joint::Level;
use crate::layout::Layout;
use crate::system::System;
use crate::system::pattern::Pattern;
use crate::system::solve::LinearSolver;

/// The conditions of one macro step, one for each unknown: of a joint's row `g'' = 0` at the start where the variant has it,
/// `g = 0` and `g' = 0` at the end and moments of `g` over the step, of exchanged motion `w - y = 0`, `H (w' - y') = 0` and moments of
/// `w - y`, of a connected signal `w - y = 0` and moments of it. Positions of joints and their moments are divided by `H^2` and velocities
/// by `H`: all rows of a joint then have the size of an acceleration.
pub struct Stack {
    pattern: Pattern,
    jacobian: Vec<f64>,
    residual: Vec<f64>,
    rhs: Vec<f64>,
    rows: Vec<StackedRow>,
    /// Number of joint rows.
    joint_rows: usize,
    /// For each row its entries, and those of the unknowns of its own variable.
    entries: Vec<Vec<usize>>,
    own_entries: Vec<Vec<usize>>,
}

/// The conditions of one row of the coupling system.
struct StackedRow {
    first: usize,
    starts_anew: bool,
    ends: &'static [Level],
    moments: usize,
    /// Power of the load of a multiplier of 1 per unit of `g'`.
    power: f64,
}

impl StackedRow {
    fn of_end(&self) -> impl Iterator<Item = (usize, Level)> {
        let first = self.first + usize::from(self.starts_anew);
        (first..).zip(self.ends.iter().copied())
    }

    /// Places of the moments, the lowest first.
    fn of_moments(&self) -> impl Iterator<Item = (usize, usize)> {
        let first = self.first + usize::from(self.starts_anew) + self.ends.len();
        (first..).zip(0..self.moments)
    }
}

impl Stack {
    /// The equations of a family; `end` is the system at the end of the step, `start` that at its start.
    pub fn new(layout: &Layout, family: Family, end: &System, start: Option<&System>) -> Self {
        let joint_rows = layout.rows.len();
        let mut rows = Vec::with_capacity(layout.variables());
        for variable in 0..layout.variables() {
            let unknowns = end.unknowns().of(variable);
            let is_joint = variable < joint_rows;
            let (ends, moments) = match layout.is_signal(variable) {
                true => (&ENDS[..1], family.moments_of_signals()),
                false => (&ENDS[..], family.moments_of_motion()),
            };
            rows.push(StackedRow {
                first: unknowns.start,
                starts_anew: is_joint && family.variant.starts_anew(),
                ends,
                moments,
                power: match is_joint {
                    true => {
                        let condition = layout.rows[variable].condition;
                        layout.joint_of(variable).joint.condition(condition).load_power()
                    }
                    false => 1.0,
                },
            });
        }
        let size = end.unknowns().len();
        let visit = |visit: &mut dyn FnMut(usize, usize)| {
            visit_end(&rows, end, &mut |row, _, entry| {
                visit(row, end.pattern().columns()[entry]);
            });
            visit_moments(&rows, end, &mut |row, _, entry| {
                visit(row, end.pattern().columns()[entry]);
            });
            if let Some(start) = start {
                visit_start(&rows, joint_rows, end, start, &mut |row, column, _| {
                    visit(row, column);
                });
            }
        };
        let pattern = Pattern::new(size, visit);
        let mut entries = vec![Vec::new(); size];
        let mut own_entries = vec![Vec::new(); size];
        let places = pattern.rows().iter().zip(pattern.columns());
        for (entry, (&row, &column)) in places.enumerate() {
            entries[row].push(entry);
            if end.unknowns().variable(row) == end.unknowns().variable(column) {
                own_entries[row].push(entry);
            }
        }
        Self {
            entries,
            own_entries,
            jacobian: vec![0.0; pattern.entries()],
            residual: vec![0.0; size],
            rhs: vec![0.0; size],
            pattern,
            rows,
            joint_rows,
        }
    }

    /// A solver for the equations, whose unknowns are those of the system at the `end` of the step. A condition of a joint that follows from others
    /// does so at the start, at the end and inside the step.
    pub fn solver(&self, end: &System) -> LinearSolver {
        end.solver_of(&self.pattern)
    }

    /// The place of the first condition of a variable at the end of the step.
    pub fn first_end(&self, variable: usize) -> usize {
        let row = &self.rows[variable];
        row.first + usize::from(row.starts_anew)
    }

    /// Power of the load of a multiplier of 1 per unit of `g'` of its condition.
    pub fn power(&self, variable: usize) -> f64 {
        self.rows[variable].power
    }

    /// Entries of one row for the unknowns of a variable, which the row belongs to.
    pub fn own_entries(&self, place: usize) -> impl Iterator<Item = f64> {
        self.own_entries[place].iter().map(|&entry| self.jacobian[entry])
    }

    /// Puts another condition in the place of one: that `sum part unknown` of the unknowns of its variable, which is `value` now, vanishes;
    /// in the size of the condition before.
    pub fn replace(&mut self, place: usize, parts: impl Iterator<Item = f64>, value: f64) {
        let Self {
            jacobian,
            entries,
            own_entries,
            residual,
            ..
        } = self;
        let mut size: f64 = 0.0;
        for &entry in &entries[place] {
            size = size.max(jacobian[entry].abs());
            jacobian[entry] = 0.0;
        }
        let size = if size > 0.0 { size } else { 1.0 };
        for (&entry, part) in own_entries[place].iter().zip(parts) {
            jacobian[entry] = size * part;
        }
        residual[place] = size * value;
    }

    /// Adds to the entries of one row for the unknowns of its variable.
    pub fn add_to_row(&mut self, place: usize, parts: impl Iterator<Item = f64>) {
        for (&entry, part) in self.own_entries[place].iter().zip(parts) {
            self.jacobian[entry] += part;
        }
    }

    /// One row is met.
    pub fn meet(&mut self, place: usize) {
        self.residual[place] = 0.0;
    }

    /// Adds to the residual of one row.
    pub fn add_residual(&mut self, place: usize, value: f64) {
        self.residual[place] += value;
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
        visit_moments(rows, end, &mut |_, moment, entry| {
            if let Some(moments) = end.moments() {
                let row = end.pattern().rows()[entry];
                let scale = scale(Level::Position, row < *joint_rows, step);
                jacobian[pattern.entry(slot)] += scale * moments.jacobian(moment)[entry];
            }
            slot += 1;
        });
        let Some(start) = start else { return };
        visit_start(rows, *joint_rows, end, start, &mut |_, _, entry| {
            jacobian[pattern.entry(slot)] += start.jacobian(Level::Acceleration)[entry];
            slot += 1;
        });
    }

    /// Puts the conditions at the end and inside the step together; those at the start are met.
    pub fn assemble_end(&mut self, end: &System, step: f64) {
        for (number, row) in self.rows.iter().enumerate() {
            if row.starts_anew {
                self.residual[row.first] = 0.0;
            }
            for (place, level) in row.of_end() {
                let scale = scale(level, number < self.joint_rows, step);
                self.residual[place] = scale * end.residual(level)[number];
            }
            let Some(moments) = end.moments() else {
                continue;
            };
            for (place, moment) in row.of_moments() {
                let scale = scale(Level::Position, number < self.joint_rows, step);
                self.residual[place] = scale * moments.residual(moment)[number];
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

/// Visits stacked row, moment and entry of the Jacobians inside the step, which have the pattern of the end's.
fn visit_moments(rows: &[StackedRow], end: &System, visit: &mut dyn FnMut(usize, usize, usize)) {
    for (entry, &row) in end.pattern().rows().iter().enumerate() {
        for (place, moment) in rows[row].of_moments() {
            visit(place, moment, entry);
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
