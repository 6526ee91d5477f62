//! The error of a macro step, before any worker has taken it, and with it the degrees of the next one.

use super::correcting::Correcting;
use super::jacobian::Jacobian;
use crate::accuracy::{Correction, Difference, Estimate, StepErrors, Suspect, Tolerance};
use crate::layout::Layout;
use crate::methods::LoadErrors;
use crate::policies::degree::{
    Anew, AutomaticDegrees, Cost, Group, Nested, Outlook, Prospect, Prospects, Purpose,
};
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
        if let Some(estimate) = self.nested_error(step, tolerance, degrees[0]) {
            return estimate;
        }
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

    /// The error that the step most likely has, to be told: where [`Correcting::error`] keeps something in hand, without that.
    pub fn likely_error(&mut self, step: MacroStep, errors: &mut StepErrors) -> Estimate {
        let tolerance = errors.bearable();
        // What other attempts at the step have told is left out: a step is told the same error whatever was tried before it.
        let attempts = std::mem::take(&mut self.own.attempts);
        let estimate = match self.nested(step, tolerance) {
            None => self.error(step, tolerance, [None, None]),
            Some((nested, last)) => {
                let likely = nested.likely(errors.lower_before(step, nested.lower_order()));
                let estimate = self.with_exchanged(likely, nested.degree, (last, tolerance));
                errors.note_lower(step, nested.lower);
                estimate
            }
        };
        self.own.attempts = attempts;
        estimate
    }

    /// The error from the solutions with polynomials of fewer degrees, for methods that have them.
    fn nested_error(
        &mut self,
        step: MacroStep,
        tolerance: &Tolerance,
        degree: Option<usize>,
    ) -> Option<Estimate> {
        let (nested, last) = self.nested(step, tolerance)?;
        let degree = degree.unwrap_or(nested.degree);
        let scaled = nested.prospect(degree).scaled;
        Some(self.with_exchanged(scaled, degree, (last, tolerance)))
    }

    /// An error of the multipliers with polynomials of this degree, which `last` tells what has it, and those of exchanged variables.
    fn with_exchanged(
        &mut self,
        scaled: f64,
        degree: usize,
        (last, tolerance): (Estimate, &Tolerance),
    ) -> Estimate {
        let rows = self.layout.rows.len();
        let unknowns = self.own.end.system.unknowns();
        let multipliers = (0..rows).flat_map(|row| unknowns.of(row));
        let changes = multipliers.map(|unknown| self.own.change[unknown].abs());
        let mut estimate = Estimate {
            scaled,
            order: 2 * degree + 1,
            is_of_step_alone: true,
            change: changes.fold(0.0, f64::max),
            ..last
        };
        self.add_errors_of_exchanged(tolerance, None, &mut estimate);
        self.add_unresolved_signals(tolerance, &mut estimate);
        estimate
    }

    /// Solves with polynomials of one degree and of two degrees less, once for each first correction. Gives whether there are such.
    fn solve_nested(&mut self) -> bool {
        let own = &mut *self.own;
        let start = self.point.as_ref().map(|point| point.system());
        let system = &own.end.system;
        let [lower, lowest] = &mut own.nested;
        let method = &mut *self.method;
        *own.has_nested.get_or_insert_with(|| {
            method.nested(system, start, 1, lower) && method.nested(system, start, 2, lowest)
        })
    }

    /// By how much the solution with polynomials of the present degree differs from that of one degree less, which is the error of the latter,
    /// and before that by how much these differ from those of two degrees less.
    fn nested_differences(
        &mut self,
        step: MacroStep,
        tolerance: &Tolerance,
    ) -> Option<[Estimate; 2]> {
        if !self.solve_nested() {
            return None;
        }
        let now = self.workers.now();
        let own = &mut *self.own;
        let system = &own.end.system;
        let [lower, lowest] = &own.nested;
        let mut differ = |higher: &[f64], lower: &[f64]| {
            let differences = own.errors.iter_mut().zip(higher.iter().zip(lower));
            differences.for_each(|(error, (higher, lower))| *error = higher - lower);
            let difference = Difference {
                layout: self.layout,
                outputs: Some(&now),
                step: step.length,
                system,
                columns: own.end.columns.all(),
                unknowns: &own.errors,
            };
            own.position_errors.largest(difference, tolerance)
        };
        Some([differ(lower, lowest), differ(&own.solution, lower)])
    }

    /// What the solutions with polynomials of fewer degrees tell, and the last of their differences.
    fn nested(&mut self, step: MacroStep, tolerance: &Tolerance) -> Option<(Nested, Estimate)> {
        let [before, last] = self.nested_differences(step, tolerance)?;
        let nested = Nested {
            degree: self.method.degree(),
            difference: last.scaled,
            lower: before.scaled,
            top_share: self.method.top_share(),
        };
        Some((nested, last))
    }

    /// What is known of the degrees of the multipliers' polynomials, where they are found anew in every step.
    fn anew(&mut self, step: MacroStep, step_size: &StepSize, every_step: bool) -> Option<Anew> {
        let (nested, _) = self.nested(step, step_size.tolerance())?;
        let highest = match self.method.is_limited() {
            true => nested.degree,
            false => usize::MAX,
        };
        Some(Anew {
            nested,
            degrees: [self.method.lowest_degree(), highest],
            cost: Cost {
                of_step: self.integrations_of_step(),
                of_power: self.integrations_of_power(),
                every_step,
                rest: step_size.rest(step),
                most_growth: step_size.most_growth_alone(),
            },
        })
    }

    /// Integrations of all subsystems over a step, without columns and passes.
    fn integrations_of_step(&self) -> f64 {
        2.0 * self.layout.outputs.len() as f64
    }

    /// Integrations for one power of all inputs that are raised.
    fn integrations_of_power(&self) -> f64 {
        let raised = self.layout.inputs.iter().filter(|input| input.is_perturbed);
        raised.count() as f64
    }

    /// What the columns over another length cost, in steps; nothing where every step has columns of its own.
    pub fn cost_of_columns(&self) -> f64 {
        let powers = match self.own.end.columns.stay() {
            true => self.method.degree() + 1,
            false => 0,
        };
        self.integrations_of_power() * powers as f64 / self.integrations_of_step()
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
                estimate.add_error(error.abs(), allowed, order, suspect);
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
        let every_step = !self.own.end.columns.stay();
        let outlook = |group: &Group| {
            let anew = group
                .are_multipliers()
                .then(|| self.anew(step, step_size, every_step));
            match anew.flatten() {
                Some(anew) => Outlook::Anew(anew),
                None => Outlook::Past(self.prospects(step, tolerance, group)),
            }
        };
        let growth =
            |prospect: Prospect| step_size.growth(step.length, prospect.scaled, prospect.order);
        let changed = degrees.choose(outlook, growth, step.length, purpose);
        let next = match changed {
            [None, None] => *found,
            degrees => self.error(step, tolerance, degrees),
        };
        if purpose == Purpose::Repetition {
            degrees.repeat();
            self.apply(degrees);
        }
        next
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
