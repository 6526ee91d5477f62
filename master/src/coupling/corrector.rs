//! What a predictor/corrector method does in a macro step; in which order is told by the co-simulation.

use super::columns::Resolution;
use super::degree_choice::Purpose;
use super::error_estimate::{ErrorScales, Estimate};
use crate::coupling::measure::Change;
use crate::error::RunError;
use crate::results::StepDegrees;
use crate::results::Verdict;
use crate::time::MacroStep;
use crate::workers::Parts;

/// A method that predicts the coupling variables over a macro step and corrects them from what the workers answer.
///
/// It stands at the present macro point `T_N`, from where it predicts; [`Corrector::move_on`] takes it to `T_{N+1}`.
pub(crate) trait Corrector: Again + Send {
    /// Multipliers at the present macro point.
    fn multipliers(&self) -> &[f64];

    /// Fills in the look-ahead over `step` from the present macro point: predicted inputs, and a perturbed one for each
    /// column of the coupling Jacobian if `with_columns`; otherwise the last columns stay in use.
    fn request_prediction(
        &mut self,
        parts: &mut Parts,
        step: MacroStep,
        with_columns: bool,
    ) -> Result<(), RunError>;

    /// Solves for the coupling variables at the end of `step` from the answers to the look-ahead over it.
    fn correct(&mut self, parts: &Parts, step: MacroStep) -> Result<(), RunError>;

    /// The error of the step that [`Corrector::correct`] has just solved, before any worker has taken it: from predicted against
    /// corrected coupling variables.
    fn error_estimate(&mut self, parts: &Parts, step: MacroStep, scales: &ErrorScales) -> Estimate;

    /// Chooses the degrees of the polynomials, where they follow the estimates, for the next step or for a repetition of this one. Comes
    /// after [`Corrector::error_estimate`]; the error that the step would have had with them: the `estimate` itself if they stay.
    fn choose_degrees(
        &mut self,
        _parts: &Parts,
        _step: MacroStep,
        _scales: &ErrorScales,
        estimate: &Estimate,
        _purpose: Purpose,
    ) -> Estimate {
        *estimate
    }

    /// Degrees of the polynomials over the step that [`Corrector::move_on`] took, as far as they follow the estimates.
    fn degrees(&self) -> StepDegrees {
        StepDegrees::default()
    }

    /// The loads jump in the present step: what they were before is no help.
    fn restart(&mut self);

    /// Fills in the advance over `step` with the corrected inputs.
    fn request_advance(&mut self, parts: &mut Parts, step: MacroStep);

    /// Moves on to the end of `step`.
    fn move_on(&mut self, step: MacroStep);

    /// Writes the multipliers at `tau` after the start of the last step, `length` long, that [`Corrector::move_on`] took.
    fn multipliers_at(&self, tau: f64, length: f64, multipliers: &mut [f64]);

    /// How well the macro steps have resolved the responses to loads.
    fn resolution(&self) -> &Resolution;

    /// How well the outputs after the advance meet what their linearisation promised.
    fn judge(&mut self, parts: &Parts) -> Verdict;
}

/// How a method corrects a macro step more than once, and keeps columns.
pub(crate) trait Again {
    /// Fills in another look-ahead over `step` from the same macro point, with the corrected inputs in place of the predicted
    /// ones, and perturbed ones if `with_columns`: [`Corrector::correct`] then corrects them further.
    fn request_pass(&mut self, parts: &mut Parts, step: MacroStep, with_columns: bool);

    /// The step is accepted: its first correction counts among those that later ones are compared with. Gives whether it has columns
    /// and shape of the step before.
    fn accept(&mut self) -> bool;

    /// Whether the step was predicted without a past: its correction is large, and what one linearisation leaves of it counts.
    fn is_blind(&self) -> bool;

    /// Size of the last correction.
    fn last_change(&self) -> Change;

    /// Looks for columns of earlier steps for a look-ahead over `step`. Gives the share of them that may be wrong because they were measured
    /// over other lengths; `None` if there are none.
    fn prepare_columns(&mut self, parts: &Parts, step: MacroStep) -> Option<f64>;

    /// Learns from the outputs after the advance what the first correction of the step has missed, so that the next first
    /// correction takes it into account; of a step `with_new_columns`, what even they leave. Comes after [`Corrector::move_on`].
    fn learn(&mut self, parts: &Parts, with_new_columns: bool) -> Missed;
}

/// What corrections of a step have missed, relative to the first corrections of the last macro steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Missed {
    /// What another correction with the matrix at hand would change after the last one.
    pub by_last: f64,
    /// What the first one would have missed if nothing had been foreseen.
    pub by_first: f64,
}
