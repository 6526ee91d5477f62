//! Corrections of Hermite coupling in a macro step.

use std::ops::Range;

use crate::accuracy::{Attempts, CHORD_ORDER};
use crate::joint::Level;
use crate::layout::Exchanged;
use crate::methods::condition::SingularRow;
use crate::methods::hermite::reduced::top_share;
use crate::methods::hermite::variant::LEAST_DEGREE;
use crate::methods::method::{Corrected, LoadErrors};
use crate::signal::Curves;
use crate::system::solve::SingularColumn;
use crate::system::unknowns::Unknowns;
use crate::system::{Point, System};

use super::HermiteCoupling;

/// Mean error of exchanged motion over the step, per difference between predicted and corrected end: the curve of degree 4 misses
/// `s^3 (s - 1)^2`, whose mean is 1/60, times a term that falls faster than the difference does.
const MOTION_SHARE: f64 = 1.0 / 60.0;

/// The power of the step with which that difference falls.
const MOTION_ORDER: usize = 4;

/// The degree of the first step, where the degree follows the errors.
const FIRST_DEGREE: usize = LEAST_DEGREE + 1;

impl HermiteCoupling {
    /// Puts the equations of the step together for multipliers of this degree: conditions at its end and inside it, columns at its start, and
    /// what is missed there.
    fn assemble(&mut self, end: &System, [start, missed]: [Option<&System>; 2], degree: usize) {
        let step = self.curves.length();
        self.stack.assemble_jacobian(end, start, step);
        self.stack.assemble_end(end, step);
        if let Some(missed) = missed {
            self.stack.assemble_start(missed);
        }
        self.stack.reduce(degree, &self.curves);
    }

    fn solve_stack(&mut self, end: &System, solution: &mut [f64]) -> Result<(), SingularRow> {
        let (pattern, jacobian, change) = self.stack.equation();
        let solved = self.solver.solve(pattern, jacobian, change);
        solved.map_err(|SingularColumn(unknown)| SingularRow {
            row: end.unknowns().variable(unknown),
            level: self.family.variant.level(),
        })?;
        solution.copy_from_slice(change);
        Ok(())
    }

    /// The second derivatives of exchanged motion at the end of the step: linearised outputs.
    fn foresee_accelerations(&mut self, solution: &[f64], end: &System) {
        if self.family.variant.level() < Level::Acceleration {
            return;
        }
        let step = self.curves.length();
        let accelerations = &mut self.accelerations;
        end.shift(Level::Acceleration, solution, accelerations);
        let residual = end.residual(Level::Acceleration);
        for (acceleration, residual) in accelerations.iter_mut().zip(residual) {
            *acceleration = -(residual + *acceleration) / (step * step);
        }
    }
}

impl Corrected for HermiteCoupling {
    fn point(&self) -> Point<'_> {
        self.sample.point(self.curves.length(), self.curves.attitudes())
    }

    fn has_past(&self) -> bool {
        self.curves.has_past()
    }

    fn solve(
        &mut self,
        end: &mut System,
        start: Option<&System>,
        is_first: bool,
        solution: &mut [f64],
    ) -> Result<(), SingularRow> {
        // The accelerations are linear in the multipliers: the first correction meets the conditions at the start.
        let missed = start.filter(|_| is_first);
        let degree = self.degree;
        self.assemble(end, [start, missed], degree);
        if !self.family.variant.starts_anew() {
            self.stack
                .find_relaxed(degree, &self.curves, None, &mut self.relaxed);
        } else if is_first {
            self.relaxed.clear();
        }
        self.stack.relax(&self.relaxed, &self.curves);
        self.solve_stack(end, solution)?;
        if is_first && self.has_limiter && self.family.variant.starts_anew() {
            let solved = Some(&*solution);
            self.stack
                .find_relaxed(degree, &self.curves, solved, &mut self.relaxed);
            if !self.relaxed.is_empty() {
                self.assemble(end, [start, missed], degree);
                self.stack.relax(&self.relaxed, &self.curves);
                self.solve_stack(end, solution)?;
            }
        }
        Ok(())
    }

    fn nested(
        &mut self,
        end: &System,
        start: Option<&System>,
        fewer: usize,
        change: &mut [f64],
    ) -> bool {
        let Some(degree) = self.degree.checked_sub(fewer) else {
            return false;
        };
        self.assemble(end, [start, start], degree);
        let (pattern, jacobian, own) = self.stack.equation();
        let solved = self.nested_solver.solve(pattern, jacobian, own);
        change.copy_from_slice(own);
        solved.is_ok()
    }

    fn expect_rate(&mut self, rate: Option<f64>) {
        self.curves.expect_rate(rate);
    }

    fn tells_error(&self) -> bool {
        true
    }

    fn degree(&self) -> usize {
        self.degree
    }

    /// Of the degrees whose errors moments tell the one with the fewest columns: a first step is short.
    fn first_degree(&self) -> Option<usize> {
        Some(FIRST_DEGREE.min(self.family.degree))
    }

    fn lowest_degree(&self) -> usize {
        LEAST_DEGREE
    }

    fn top_share(&self) -> f64 {
        top_share(self.degree, &self.curves)
    }

    fn is_limited(&self) -> bool {
        self.relaxed.iter().any(|one| one.is_heard)
    }

    fn restart_exchanged(&mut self) {
        self.curves.restart_exchanged();
    }

    fn set_degree(&mut self, variables: Range<usize>, degree: usize) {
        if variables.start == 0 {
            self.degree = degree.clamp(LEAST_DEGREE, self.family.degree);
            self.curves.set_degree(self.degree);
        }
    }

    fn degree_of_last_step(&self, _variable: usize) -> usize {
        self.last_degree
    }

    fn correct(&mut self, change: &[f64], solution: &[f64], end: &System) {
        self.curves.change(change);
        self.sample.take(&self.curves);
        self.foresee_accelerations(solution, end);
    }

    fn least_pivot(&self) -> f64 {
        self.solver.least_pivot()
    }

    fn load_errors(
        &self,
        unknowns: &Unknowns,
        rows: usize,
        change: &[f64],
        _degree: Option<usize>,
        errors: &mut [f64],
    ) -> LoadErrors {
        let mut found = LoadErrors {
            shares: self.curves.load_error(),
            change: 0.0,
        };
        let loads = (0..rows).map(|row| unknowns.of(row).end).max().unwrap_or(0);
        for (error, change) in errors[..loads].iter_mut().zip(change) {
            *error = found.shares.position * change;
            found.change = found.change.max(change.abs());
        }
        found
    }

    fn exchanged_error(
        &self,
        exchanged: &Exchanged,
        variable: usize,
        (unknowns, change): (&Unknowns, &[f64]),
        _degree: Option<usize>,
        attempts: &Attempts,
    ) -> (f64, usize) {
        let unknowns = unknowns.of(variable);
        let change = change[unknowns.start];
        // The solutions with fewer degrees tell the errors of curves with moments, but for what curves make of a signal inside the step.
        if exchanged.rates.is_none() && unknowns.len() > 1 {
            return (self.curves.signal_effect(variable), 2 * self.degree + 1);
        }
        if unknowns.len() > 2 {
            return (0.0, 2 * self.degree + 2);
        }
        if exchanged.rates.is_some() {
            return (MOTION_SHARE * change, MOTION_ORDER);
        }
        let start = self.curves.chord_start(variable);
        match start.and_then(|start| attempts.chord_error(variable, start)) {
            Some(error) => (error, CHORD_ORDER),
            None => {
                let shares = self.curves.signal_error(variable, self.curves.length());
                (shares.mean * change, shares.order)
            }
        }
    }

    fn remaining(&mut self, end: &mut System, remaining: &mut [f64]) {
        self.stack.assemble_end(end, self.before.length());
        self.stack.meet_reduced(self.last_degree, &self.before);
        self.stack.relax_residual(&self.relaxed, &self.before);
        let rhs = self.stack.rhs();
        self.solver.solve_again(rhs);
        remaining.copy_from_slice(rhs);
    }

    fn corrected_point(&self) -> Point<'_> {
        self.settled
            .point(self.before.length(), self.before.attitudes())
    }
}
