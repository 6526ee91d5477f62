//! The error of a macro step, before any worker has taken it, and with it the degrees of the next one.

use super::correcting::Correcting;
use super::jacobian::Jacobian;
use crate::accuracy::{Correction, Estimate, Suspect, Tolerance};
use crate::layout::Layout;
use crate::methods::LoadErrors;
use crate::policies::degree::{AutomaticDegrees, Group, Prospect, Prospects, Purpose};
use crate::policies::step_size::{Rule, StepSize};
use crate::system::Outputs;
use crate::time::MacroStep;

impl Correcting<'_> {
    /// The error of the step that was corrected last, from predicted against corrected coupling variables: with polynomials of the present
    /// degrees of multipliers and exchanged variables, or of others. Positions hardly feel which degree the corrected values were solved
    /// with, so one correction tells the errors of all.
    ///
    /// Positions feel the columns times the errors of the multipliers. A joint closes again what its multipliers have missed, so these
    /// errors do not add up over the steps. Those by exchanged variables, the mean errors of their curves, do, which makes the error of
    /// the motion as large, relative to its size, as that of the curves.
    pub fn error(
        &mut self,
        step: MacroStep,
        tolerance: &Tolerance,
        degrees: [Option<usize>; 2],
    ) -> Estimate {
        let mut estimate = Estimate::NONE;
        let loads = self.add_errors_of_multipliers(step, tolerance, degrees[0], &mut estimate);
        let now = self.workers.now();
        let own = &mut *self.own;
        let solved = (&own.end, &own.change[..], &own.errors[..]);
        let correction = correction(self.layout, &now, step, solved, loads);
        own.position_errors
            .add_openings(correction, tolerance, &mut estimate);
        self.add_errors_of_exchanged(tolerance, degrees[1], &mut estimate);
        estimate
    }

    fn add_errors_of_multipliers(
        &mut self,
        step: MacroStep,
        tolerance: &Tolerance,
        degree: Option<usize>,
        estimate: &mut Estimate,
    ) -> LoadErrors {
        let rows = self.layout.rows.len();
        let now = self.workers.now();
        let own = &mut *self.own;
        let unknowns = own.end.system.unknowns();
        own.errors.fill(0.0);
        let loads = self
            .method
            .load_errors(unknowns, rows, &own.change, degree, &mut own.errors);
        estimate.change = estimate.change.max(loads.change);
        let solved = (&own.end, &own.change[..], &own.errors[..]);
        let correction = correction(self.layout, &now, step, solved, loads);
        own.position_errors
            .add_errors(correction, tolerance, estimate);
        loads
    }

    fn add_errors_of_exchanged(
        &self,
        tolerance: &Tolerance,
        degree: Option<usize>,
        estimate: &mut Estimate,
    ) {
        let own = &*self.own;
        let correction = (own.end.system.unknowns(), &own.change[..]);
        for exchanged in &self.layout.exchanged {
            let allowed = tolerance.allowed_of_variable(exchanged.subsystem, exchanged.what);
            for variable in exchanged.first..exchanged.first + exchanged.size() {
                let (error, order) = self.method.exchanged_error(
                    exchanged,
                    variable,
                    correction,
                    degree,
                    &own.attempts,
                );
                let suspect = Suspect::Variable(variable);
                estimate.add(error.abs() / allowed, order, suspect);
            }
        }
    }

    /// Chooses the degrees of the next attempt or step, where they follow the estimates; the error that the present step would have had
    /// with them: that `found` if they stay.
    pub fn choose_degrees(
        &mut self,
        degrees: Option<&mut AutomaticDegrees>,
        step: MacroStep,
        step_size: &StepSize,
        found: &Estimate,
    ) -> Estimate {
        let Some(degrees) = degrees else {
            return *found;
        };
        let purpose = match step_size.rule() {
            Rule::Free if found.scaled > 1.0 => Purpose::Repetition,
            Rule::Free | Rule::Given => Purpose::LongestStep,
            Rule::Equal => Purpose::SmallestError,
        };
        let tolerance = step_size.tolerance();
        let prospects = |group: &Group| self.prospects(step, tolerance, group);
        let changed = degrees.choose(prospects, step.length, purpose);
        if purpose == Purpose::Repetition {
            degrees.repeat();
            self.apply(degrees);
        }
        match changed {
            [None, None] => *found,
            degrees => self.error(step, tolerance, degrees),
        }
    }

    /// What the polynomials of the degrees around that of a group would have made of the step.
    fn prospects(&mut self, step: MacroStep, tolerance: &Tolerance, group: &Group) -> Prospects {
        let smooth_points = self.method.smooth_points(group.first());
        let known = |degree: usize| degree < smooth_points;
        let mut error = |degree: usize| {
            let mut estimate = Estimate::NONE;
            match group.are_multipliers() {
                true => {
                    self.add_errors_of_multipliers(step, tolerance, Some(degree), &mut estimate);
                }
                false => self.add_errors_of_exchanged(tolerance, Some(degree), &mut estimate),
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

    /// The multipliers jump in the present step.
    pub fn restart(&mut self, degrees: Option<&mut AutomaticDegrees>) {
        self.method.restart();
        if let Some(degrees) = degrees {
            degrees.restart();
            self.apply(degrees);
        }
    }

    /// Gives the polynomials their degrees.
    pub fn apply(&mut self, degrees: &AutomaticDegrees) {
        for (variables, degree) in degrees.present() {
            self.method.set_degree(variables, degree);
        }
    }
}

/// What the errors of the multipliers make of a correction: that was solved with this Jacobian, for this change, with these errors.
fn correction<'a>(
    layout: &'a Layout,
    outputs: &'a dyn Outputs,
    step: MacroStep,
    (end, change, errors): (&'a Jacobian, &'a [f64], &'a [f64]),
    loads: LoadErrors,
) -> Correction<'a> {
    Correction {
        layout,
        outputs,
        step: step.length,
        system: &end.system,
        columns: end.columns.all(),
        change,
        errors,
        share: loads.shares.position,
        order: loads.shares.order + 2,
    }
}
