//! Where the macro points lie, and what controls the steps.

use super::options::Options;
use crate::accuracy::Tolerance;
use crate::layout::Layout;
use crate::policies::step_size::{Rule, StepSize};
use crate::scene::{Scene, StepControl};
use crate::system::Outputs;
use crate::time::TimePlan;
use crate::workers::Workers;

/// Where the macro points lie: as the scene says, unless a study gives the steps.
pub(super) fn plan_of(scene: &Scene, options: &Options) -> TimePlan {
    let (start, end, first) = (scene.t_start, scene.t_end, scene.coupling.macro_step);
    match (&options.step_lengths, scene.coupling.step_control) {
        (Some(lengths), _) => TimePlan::given(start, end, lengths.clone()),
        (None, Some(_)) => TimePlan::variable(start, end, first),
        (None, None) => TimePlan::equidistant(start, end, first),
    }
}

/// Motion below this share of the size of a mechanism need not be accurate.
const LEAST_SIZE: f64 = 1e-3;

/// Against which the errors of degrees are compared where no error is too large: only their ratios matter.
const ANY_ERROR: StepControl = StepControl {
    tolerance: 1.0,
    absolute_tolerance: None,
    least_step: 0.0,
    greatest_step: f64::INFINITY,
};

/// The control of the steps, if the scene asks for one, or of the degrees; outputs at the start are known.
pub(super) fn step_size_of(
    scene: &Scene,
    options: &Options,
    layout: &Layout,
    workers: &Workers,
) -> Option<StepSize> {
    let coupling = &scene.coupling;
    let (rule, control) = match (coupling.step_control, &options.step_lengths) {
        (Some(control), None) => (Rule::Free, control),
        (Some(control), Some(_)) => (Rule::Given, control),
        (None, _) if coupling.has_automatic_degree() => (Rule::Equal, ANY_ERROR),
        (None, _) => return None,
    };
    let now = workers.now();
    let tolerance = control.tolerance;
    let absolute = match control.absolute_tolerance {
        Some(given) => [given; 2],
        None => {
            let size = layout.size(|subsystem, place| now.of(subsystem)[place]);
            [size, 1.0].map(|size| LEAST_SIZE * size * tolerance)
        }
    };
    let tolerance = Tolerance::new(
        tolerance,
        absolute,
        layout,
        solver_tolerances(workers),
        &now,
    );
    let span = [coupling.macro_step, scene.t_end];
    Some(StepSize::new(rule, control, span, tolerance))
}

/// For each subsystem the error that its solver allows itself; 0 where it tells none.
pub(super) fn solver_tolerances(workers: &Workers) -> Vec<f64> {
    let subsystems = workers.subsystems.iter();
    subsystems
        .map(|own| own.tolerance.unwrap_or_default())
        .collect()
}
