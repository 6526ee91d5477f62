//! What a method without a corrector does in a macro step; in which order is told by the co-simulation.

use std::time::Duration;

use super::error_estimate::{ErrorScales, Estimate, Suspect};
use crate::error::RunError;
use crate::layout::Layout;
use crate::scene::Spring;
use crate::signal::History;
use crate::time::MacroStep;
use crate::workers::Parts;

/// A method that takes a macro step with extrapolated coupling variables and knows only at its end how wrong they were.
///
/// It stands at the present macro point `T_N`, from where it advances; [`Uncorrected::move_on`] takes it to `T_{N+1}`. Until then the
/// step is an attempt: after [`Parts::go_back`] the method advances over a shorter one, as if there had been none before.
pub(crate) trait Uncorrected: Send {
    /// Multipliers at the present macro point.
    fn multipliers(&self) -> &[f64];

    /// Makes ready to estimate the error of `step`, which the workers stand before.
    fn prepare_estimate(
        &mut self,
        _parts: &mut Parts,
        _step: MacroStep,
        _scales: &ErrorScales,
    ) -> Result<(), RunError> {
        Ok(())
    }

    /// Lets all workers advance over `step` and finds the coupling variables at its end. The time that was spent on solving for
    /// them.
    fn advance(&mut self, parts: &mut Parts, step: MacroStep) -> Result<Duration, RunError>;

    /// The error of the step that [`Uncorrected::advance`] has just tried: from the extrapolated coupling variables against those
    /// that the outputs at its end tell.
    fn error_estimate(&mut self, parts: &Parts, step: MacroStep, scales: &ErrorScales) -> Estimate;

    /// Moves on to the end of `step`.
    fn move_on(&mut self, step: MacroStep);

    /// Writes the multipliers at sample number `sample` inside the last step that was taken.
    fn multipliers_at(&self, parts: &Parts, sample: usize, multipliers: &mut [f64]);
}

/// Adds the error of the exchanged variables, which were extrapolated to `used` and are `found` at the end of the step: the mean error of
/// their curves. Loads that turn with a motion that is off by a share make a motion that is off by about that share.
pub(super) fn add_exchanged_errors(
    layout: &Layout,
    history: &History,
    [used, found]: [&[f64]; 2],
    step: MacroStep,
    scales: &ErrorScales,
    estimate: &mut Estimate,
) {
    for exchanged in &layout.exchanged {
        let allowed = scales.allowed_of_variable(exchanged.subsystem, exchanged.what);
        for variable in exchanged.first..exchanged.first + exchanged.size() {
            let miss = history.extrapolation_miss(variable, step.length);
            let error = miss.mean * (found[variable] - used[variable]);
            estimate.add(
                error.abs() / allowed,
                miss.order,
                Suspect::Variable(variable),
            );
        }
    }
}

/// By how much a joint that is held by a spring-damper would have to be displaced for its load to change by `error`, if that lasted for
/// `span` at most: `K d + D d' = error` from `d = 0` gives `d = (error / K) (1 - exp(-K span / D))`.
pub(super) fn displacement(spring: &Spring, error: f64, span: f64) -> f64 {
    let Spring { stiffness, damping } = *spring;
    let held = match damping > 0.0 {
        true => -(-stiffness * span / damping).exp_m1(),
        false => 1.0,
    };
    error / stiffness * held
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_damper_gives_way_slowly() {
        let spring = |damping| Spring {
            stiffness: 20.0,
            damping,
        };
        assert_eq!(displacement(&spring(0.0), 3.0, 0.7), 0.15);
        assert!((displacement(&spring(1e-3), 3.0, 0.7) - 0.15).abs() < 1e-15);
        // A damper that is far too strong for its spring moves with error / D.
        let slow = displacement(&spring(1e9), 3.0, 0.7);
        assert!((slow / (3.0 * 0.7 / 1e9) - 1.0).abs() < 1e-6, "{slow:e}");
    }
}
