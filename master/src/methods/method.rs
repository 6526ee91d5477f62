//! What a coupling method does in a macro step.

use std::ops::Range;

use serde::Serialize;

use super::condition::SingularRow;
use super::saved::{Saved, Unreadable};
use crate::accuracy::Attempts;
use crate::joint::Level;
use crate::layout::{Exchanged, Layout};
use crate::signal::{Curves, ErrorShares, Held, Nodes};
use crate::system::unknowns::Unknowns;
use crate::system::{Outputs, Point, System};

/// A coupling method: `predict`, `accept`, `reached`, step after step. It stands at the present macro point `T_N`, and `accept` takes it
/// to `T_{N+1}`, or `reached` where nothing is corrected; until then every `predict` begins an attempt at the step anew, as if there had
/// been none before.
pub trait CouplingMethod: Send {
    /// Predicts the coupling variables over a step of length `length` (s).
    fn predict(&mut self, length: f64);

    /// Lends the curves over the step, as predicted or corrected last, and curves with the same values at its end in which inputs can be
    /// raised.
    fn lend(&self, to: &mut dyn FnMut(&dyn Curves, &dyn Curves));

    /// The values at the end of the step, as predicted or corrected last; after [`CouplingMethod::reached`] those that were reached.
    fn ends(&self) -> &[f64];

    /// The step is taken, with the curves that [`CouplingMethod::lend`] lends.
    fn accept(&mut self) {}

    /// The workers have reached the end of the step, or the start of the run. `point` are the conditions at that macro point, linearised,
    /// for methods with [`CouplingMethod::held`].
    ///
    /// # Errors
    /// The conditions determine no multiplier.
    fn reached(&mut self, reached: Reached<'_>) -> Result<(), SingularRow>;

    /// Multipliers at the present macro point.
    fn multipliers(&self) -> &[f64];

    /// Writes the multipliers `tau` (s) after the start of the last step, where the outputs were `outputs`.
    fn multipliers_at(
        &self,
        tau: f64,
        layout: &Layout,
        outputs: &dyn Outputs,
        multipliers: &mut [f64],
    );

    /// What it remembers at a macro point, to be written.
    fn state(&self) -> Saved;

    /// Goes on from a state that was written.
    ///
    /// # Errors
    /// It belongs to another method.
    fn resume(&mut self, state: &Saved) -> Result<(), Unreadable>;

    /// In which order the subsystems advance.
    fn order(&self) -> Order {
        Order::Jacobi
    }

    /// Subsystem number `stepped` has reached the end of the step, before those behind it start.
    fn advanced(&mut self, _layout: &Layout, _stepped: usize, _outputs: &dyn Outputs) {}

    /// The variables at the present macro point, for methods that solve conditions there.
    fn held(&self) -> Option<Held<'_>> {
        None
    }

    /// The method as one that corrects its prediction, if it does.
    fn corrected(&mut self) -> Option<&mut dyn Corrected> {
        None
    }
}

/// A macro point that is reached.
pub struct Reached<'a> {
    /// The coupled quantities.
    pub layout: &'a Layout,
    /// The coupling outputs.
    pub outputs: &'a dyn Outputs,
    /// The conditions there, linearised, for methods with [`CouplingMethod::held`].
    pub point: Option<&'a mut System>,
}

/// A method that corrects its prediction by what the workers answer to a look-ahead.
pub trait Corrected: CouplingMethod {
    /// The point about which the conditions at the end of the step are linearised.
    fn point(&self) -> Point<'_>;

    /// On what past the curves in which inputs are raised depend.
    fn nodes(&self) -> Nodes<'_> {
        Nodes::default()
    }

    /// Whether there was a step before.
    fn has_past(&self) -> bool {
        true
    }

    /// Solves the linearised conditions for the change of the unknowns: those at the `end` of the step, and those at its start for methods
    /// with [`CouplingMethod::held`]. `is_first` for the first correction of the step.
    ///
    /// # Errors
    /// No unique solution.
    fn solve(
        &mut self,
        end: &mut System,
        start: Option<&System>,
        is_first: bool,
        solution: &mut [f64],
    ) -> Result<(), SingularRow>;

    /// Solves the conditions of the first correction for the change of the unknowns with polynomials of so many `fewer` degrees, whose
    /// difference from the solution tells the error. Gives whether there is such a solution.
    fn nested(
        &mut self,
        _end: &System,
        _start: Option<&System>,
        _fewer: usize,
        _change: &mut [f64],
    ) -> bool {
        false
    }

    /// The next corrections are expected to miss this share of what they change; not known at first.
    fn expect_rate(&mut self, _rate: Option<f64>) {}

    /// Whether solutions with polynomials of fewer degrees tell the error of a step.
    fn tells_error(&self) -> bool {
        false
    }

    /// Degree of the multipliers' polynomials over the step, for methods with [`Corrected::nested`].
    fn degree(&self) -> usize {
        0
    }

    /// The degree of the first step, where the degree follows the errors; otherwise the highest.
    fn first_degree(&self) -> Option<usize> {
        None
    }

    /// The lowest degree that it may have.
    fn lowest_degree(&self) -> usize {
        0
    }

    /// The largest ratio of the top coefficient of a corrected multiplier to those before it.
    fn top_share(&self) -> f64 {
        0.0
    }

    /// Whether a condition was relaxed, since the step does not resolve its multiplier.
    fn is_limited(&self) -> bool {
        false
    }

    /// Changes the unknowns of the curves. `solution` is what the conditions at the `end` asked for.
    fn correct(&mut self, change: &[f64], solution: &[f64], end: &System);

    /// How far the equations of the last correction are from having no unique solution: their least pivot, as a share of the largest entry of
    /// its column.
    fn least_pivot(&self) -> f64;

    /// By what the multipliers' curves are off as positions feel it, one error for each of their unknowns, written to `errors`; with
    /// polynomials of the present degree or of another one. `change` is the correction.
    fn load_errors(
        &self,
        unknowns: &Unknowns,
        rows: usize,
        change: &[f64],
        degree: Option<usize>,
        errors: &mut [f64],
    ) -> LoadErrors;

    /// The mean error of the curve of an exchanged variable, and the power of the step with which it falls.
    fn exchanged_error(
        &self,
        exchanged: &Exchanged,
        variable: usize,
        correction: (&Unknowns, &[f64]),
        degree: Option<usize>,
        attempts: &Attempts,
    ) -> (f64, usize);

    /// The solution for the conditions of `end` at the outputs that the workers reached, with the matrix of the last correction.
    fn remaining(&mut self, end: &mut System, remaining: &mut [f64]);

    /// The point that the step was corrected to, after [`CouplingMethod::accept`].
    fn corrected_point(&self) -> Point<'_>;

    /// The multipliers jump in the present step: what they were before is no help.
    fn restart(&mut self) {}

    /// Exchanged variables jump in the present step, which is taken: what they were before it is no help.
    fn restart_exchanged(&mut self) {}

    /// Gives the polynomials of some variables another degree.
    fn set_degree(&mut self, _variables: Range<usize>, _degree: usize) {}

    /// Number of past points since a variable has jumped.
    fn smooth_points(&self, _variable: usize) -> usize {
        0
    }

    /// Degree of the polynomial of a variable over the last step.
    fn degree_of_last_step(&self, _variable: usize) -> usize {
        0
    }
}

/// What the differences between predicted and corrected multipliers tell.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LoadErrors {
    /// Shares of the differences that are errors.
    pub shares: ErrorShares,
    /// Largest difference.
    pub change: f64,
}

/// A method that was made, and the conditions that have to be linearised for it, each with the levels of the outputs that count.
pub struct Built {
    /// The method.
    pub method: Box<dyn CouplingMethod>,
    /// Those at the end of the step, for methods that correct.
    pub end: Option<(System, &'static [Level])>,
    /// Those at the macro points, for methods with [`CouplingMethod::held`].
    pub point: Option<(System, &'static [Level])>,
}

/// In which order the subsystems step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// All at once, from extrapolated inputs.
    Jacobi,
    /// One after the other as the scene lists them; later ones know what earlier ones have reached.
    GaussSeidel,
}
