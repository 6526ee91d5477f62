//! A step against its two halves.

use super::allowed;
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::inputs::Inputs;
use crate::conformance::instance::{Instance, Kept};
use crate::conformance::verdict::Stop;

/// Share of the response to the inputs by which a step and its halves may differ.
pub const HALVES_SHARE: f64 = 0.02;

/// A larger share, up to which a solver of low order with one internal step is coarse and not wrong.
pub const COARSE_SHARE: f64 = 0.15;

/// How many times longer a step is over which a solver of low order takes enough internal steps.
pub const LONGER: f64 = 16.0;

/// By what part the difference must fall over a step that is [`LONGER`].
const FALLS: f64 = 0.25;

/// Compares the end of a step of `step` s under `inputs` with the end of two halves of it under the same polynomials. The size
/// of each output is that of the response, largest of its group: what `inputs` change against the defaults.
pub fn halves(
    bench: &Bench<'_>,
    (instance, start): (&mut Instance<'_>, &Kept),
    step: f64,
    inputs: &Inputs,
) -> Result<Comparison, Stop> {
    instance.go_back(start)?;
    let rest = instance.step(step, &bench.unloaded())?;
    instance.go_back(start)?;
    let whole = instance.step(step, inputs)?;
    instance.go_back(start)?;
    instance.step_part([0.0, 0.5], step, inputs)?;
    let halves = instance.step_part([0.5, 1.0], step, inputs)?;

    let response = |own: usize| {
        (whole[own] - rest[own])
            .abs()
            .max((halves[own] - rest[own]).abs())
    };
    let response: Vec<f64> = (0..rest.len()).map(response).collect();
    let sizes = bench.subject.sizes_of_groups(&response);
    let mut comparison = Comparison::default();
    for (output, name) in bench.subject.outputs.iter().enumerate() {
        let floor = bench.floor(output, &[whole[output], rest[output]]);
        if let Some(allowed) = allowed(HALVES_SHARE, sizes[output], floor) {
            comparison.near(name, whole[output], halves[output], allowed);
        }
    }
    Ok(comparison)
}

/// Whether the difference between step and halves, `at_step`, falls where the step is [`LONGER`], as that of a solver does
/// that takes more internal steps then. Inputs that are sampled once in a macro step are as wrong over a long one.
pub fn resolves_longer(
    bench: &Bench<'_>,
    from: (&mut Instance<'_>, &Kept),
    step: f64,
    inputs: &Inputs,
    at_step: &Comparison,
) -> bool {
    // A model that does not take so long a step has shown nothing in its favour.
    let longer = halves(bench, from, LONGER * step, inputs);
    longer.is_ok_and(|longer| longer.compared > 0 && longer.ratio() <= FALLS * at_step.ratio())
}
