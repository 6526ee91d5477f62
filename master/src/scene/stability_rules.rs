//! Combinations of method, index and degree that are known to be unstable before anything is run.

use super::resolved::{Coupling, Degree};
use super::warning::Warning;
use super::whole::Scene;
use crate::methods::Method;
use crate::signal::MAX_DEGREE;

impl Coupling {
    /// Whether a multiplier at `T_{N+1}` is its mean over the step before: the corrector of degree 0 holds it over the
    /// whole step, so as a value in time it belongs to the middle of the step. Not where the degree may change.
    pub fn multipliers_are_step_means(&self) -> bool {
        let highest = match self.degree {
            Degree::Fixed(degree) => degree,
            Degree::Automatic => highest_stable_degree(self.method, self.macro_step),
        };
        self.method.parameters().has_step_means() && highest == 0
    }
}

/// The known instability of a scene.
pub(super) fn warning(scene: &Scene) -> Option<Warning> {
    if scene.joints.is_empty() {
        return None;
    }
    let coupling = &scene.coupling;
    let macro_step = shortest_step(coupling);
    // A degree that follows the estimates does not go beyond the limits.
    let degree = coupling.degree.fixed();
    let instability = coupling.method.parameters().instability(degree, macro_step);
    instability.map(|found| Warning {
        key: found.key,
        place: scene.place(found.key),
        what: found.what,
        rule: found.rule,
        remedy: found.remedy,
    })
}

/// A variable step that is unstable is repeated with a shorter one, so what counts is the shortest.
fn shortest_step(coupling: &Coupling) -> f64 {
    coupling
        .step_control
        .map_or(coupling.macro_step, |control| control.least_step)
}

/// The highest degree of the polynomials of multipliers that keeps the rules for a macro step of this length in s, as all lower ones do.
pub(crate) fn highest_stable_degree(method: Method, macro_step: f64) -> usize {
    let parameters = method.parameters();
    let is_unstable = |degree: &usize| parameters.instability(Some(*degree), macro_step).is_some();
    let highest = parameters
        .own_curves()
        .map_or(MAX_DEGREE, |own| own.multipliers);
    let unstable = (1..=highest).find(is_unstable);
    unstable.map_or(highest, |degree| degree - 1)
}
