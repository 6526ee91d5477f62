//! The error of a macro step by the degree of the polynomials, and with it the degrees of the next one.

use super::SemiImplicit;
use crate::coupling::attempts::CHORD_ORDER;
use crate::coupling::automatic_degrees::Group;
use crate::coupling::degree_choice::{Prospect, Prospects, Purpose};
use crate::coupling::error_estimate::{ErrorScales, Estimate, Suspect};
use crate::coupling::position_error::Correction;
use crate::signal::ErrorShares;
use crate::time::MacroStep;
use crate::workers::Parts;

/// The step that was corrected and what is allowed of it.
#[derive(Clone, Copy)]
struct Solved<'a> {
    parts: &'a Parts,
    step: MacroStep,
    scales: &'a ErrorScales,
}

impl SemiImplicit {
    /// Positions: the columns times the errors of the multipliers. Exchanged variables: the mean error of their curves over the step.
    ///
    /// A joint closes again what its multipliers have missed, so errors of position by multipliers do not add up over the steps. Those
    /// by exchanged variables do, which makes the error of the motion as large, relative to its size, as that of the curves.
    pub(super) fn estimate(
        &mut self,
        parts: &Parts,
        step: MacroStep,
        scales: &ErrorScales,
    ) -> Estimate {
        let solved = Solved {
            parts,
            step,
            scales,
        };
        self.estimate_with(solved, [None, None])
    }

    /// The error with polynomials of these degrees; `None` is the present one. Positions hardly feel which degree the corrected values
    /// were solved with, so one correction tells the errors of all.
    fn estimate_with(&mut self, solved: Solved<'_>, degrees: [Option<usize>; 2]) -> Estimate {
        let Solved { parts, scales, .. } = solved;
        let mut estimate = Estimate::NONE;
        let shares = self.add_errors_of_multipliers(solved, degrees[0], &mut estimate);
        let correction = Correction {
            system: &self.system,
            columns: &self.columns,
            change: &self.change,
            errors: &self.load_errors,
            share: shares.position,
            order: shares.order + 2,
        };
        self.position_errors
            .add_openings(parts, correction, scales, &mut estimate);
        self.add_errors_of_exchanged(solved, degrees[1], &mut estimate);
        estimate
    }

    fn add_errors_of_multipliers(
        &mut self,
        solved: Solved<'_>,
        degree: Option<usize>,
        estimate: &mut Estimate,
    ) -> ErrorShares {
        let mut shares = ErrorShares::default();
        for row in 0..self.rows {
            let miss;
            (miss, shares) = self.miss(row, degree, solved.step);
            self.load_errors[row] = shares.position * miss;
            estimate.change = estimate.change.max(miss.abs());
        }
        let correction = Correction {
            system: &self.system,
            columns: &self.columns,
            change: &self.change,
            errors: &self.load_errors,
            share: shares.position,
            order: shares.order + 2,
        };
        let Solved {
            parts,
            step,
            scales,
        } = solved;
        self.position_errors
            .add_errors(parts, step, correction, scales, estimate);
        shares
    }

    fn add_errors_of_exchanged(
        &self,
        solved: Solved<'_>,
        degree: Option<usize>,
        estimate: &mut Estimate,
    ) {
        for exchanged in &solved.parts.layout.exchanged {
            let allowed = solved
                .scales
                .allowed_of_variable(exchanged.subsystem, exchanged.what);
            for variable in exchanged.first..exchanged.first + exchanged.size() {
                let (error, order) = match self.chord_error(variable) {
                    Some(error) => (error, CHORD_ORDER),
                    None => {
                        let (miss, shares) = self.miss(variable, degree, solved.step);
                        (shares.mean * miss, shares.order)
                    }
                };
                let suspect = Suspect::Variable(variable);
                estimate.add(error.abs() / allowed, order, suspect);
            }
        }
    }

    /// At the start, from the second attempt at the first step on.
    fn chord_error(&self, variable: usize) -> Option<f64> {
        let is_chord = self.history.is_chord(variable);
        let start = self.history.newest()[variable];
        is_chord
            .then(|| self.attempts.chord_error(variable, start))
            .flatten()
    }

    /// Difference between the corrected end value of a variable and its extrapolation, and what it tells.
    fn miss(&self, variable: usize, degree: Option<usize>, step: MacroStep) -> (f64, ErrorShares) {
        match degree {
            None => (
                self.change[variable],
                self.history.error_shares(variable, step.length),
            ),
            Some(degree) => {
                let end = self.corrected[variable];
                self.history
                    .miss_of_degree(variable, degree, end, step.length)
            }
        }
    }

    /// Chooses the degrees of the next attempt or step; the error that the present step would have had with them.
    pub(super) fn choose(
        &mut self,
        parts: &Parts,
        step: MacroStep,
        scales: &ErrorScales,
        estimate: &Estimate,
        purpose: Purpose,
    ) -> Estimate {
        let Some(mut automatic) = self.automatic.take() else {
            return *estimate;
        };
        let solved = Solved {
            parts,
            step,
            scales,
        };
        let prospects = |group: &Group| self.prospects(solved, group);
        let changed = automatic.choose(prospects, step.length, purpose);
        if purpose == Purpose::Repetition {
            automatic.repeat(&mut self.history);
        }
        self.automatic = Some(automatic);
        match changed {
            [None, None] => *estimate,
            degrees => self.estimate_with(solved, degrees),
        }
    }

    /// What the polynomials of the degrees around that of a group would have made of the step.
    fn prospects(&mut self, solved: Solved<'_>, group: &Group) -> Prospects {
        let smooth_points = group.smooth_points(&self.history);
        let known = |degree: usize| degree < smooth_points;
        let mut error = |degree: usize| {
            let mut estimate = Estimate::NONE;
            match group.are_multipliers() {
                true => {
                    self.add_errors_of_multipliers(solved, Some(degree), &mut estimate);
                }
                false => self.add_errors_of_exchanged(solved, Some(degree), &mut estimate),
            }
            Prospect {
                scaled: estimate.scaled,
                order: estimate.order,
            }
        };
        let degree = group.degree();
        let mut of = |degree: Option<usize>| degree.filter(|degree| known(*degree)).map(&mut error);
        Prospects {
            smooth_points,
            lower: of(degree.checked_sub(1)),
            present: of(Some(degree)),
            higher: of(Some(degree + 1)),
        }
    }
}
