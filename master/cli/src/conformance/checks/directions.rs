//! Directional derivatives are limits of difference quotients.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::inputs::Inputs;
use crate::conformance::instance::Instance;
use crate::conformance::measured::{LIMIT_SHARE, allowed, in_the_limit};
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Directional derivatives of steps and evaluations.
pub struct Directions;

impl Check for Directions {
    fn about(&self) -> About {
        About {
            name: "directions",
            title: "directional derivatives are the limits of difference quotients",
            equation: "dy/de = (y(p + e q) - y(p - e q))/(2 e) + O(e^2)",
            tolerance: "1e-3 of the derivative, at the one of the changes e = 1, 1/4, .. of the inputs' sizes that misses it least",
            look_at: "which input and which polynomial a direction belongs to, and whether derivatives with respect to the state are carried along",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        if !bench.subject.capabilities.directional_derivatives {
            return Err(Stop::not_applicable(
                "the model offers no directional derivatives",
            ));
        }
        let highest = bench.subject.highest_degree();
        let inputs = bench.loaded(highest);
        let mut instance = bench.in_motion()?;
        let start = instance.keep()?;
        let step = bench.step();
        for power in [0, highest] {
            let nothing = Inputs::constant(&vec![0.0; bench.sizes.len()]);
            let direction = |input: usize| nothing.clone().plus(input, 1.0, power);
            let signals = (0..bench.sizes.len())
                .map(|input| direction(input).signal(input, [0.0, 1.0], step));
            instance.go_back(&start)?;
            let rows = instance.derivatives(step, &inputs, signals.collect())?;
            for (input, row) in rows.iter().enumerate() {
                let comparison = against_quotients(bench, (input, row), |change| {
                    instance.go_back(&start)?;
                    instance.step(step, &inputs.clone().plus(input, change, power))
                })?;
                let text = format!("not the derivative of a step with respect to s^{power}");
                verdict.judge(comparison, Grade::Fail, text);
            }
        }
        instance.go_back(&start)?;
        feedthrough(bench, &instance, &inputs, verdict)
    }
}

fn feedthrough(
    bench: &Bench<'_>,
    instance: &Instance<'_>,
    inputs: &Inputs,
    verdict: &mut Verdict,
) -> Result<(), Stop> {
    let values = inputs.values(0.0);
    for (input, row) in instance.feedthrough(&values)?.iter().enumerate() {
        let comparison = against_quotients(bench, (input, row), |change| {
            let mut changed = values.clone();
            changed[input] += change;
            instance.evaluate(&changed)
        })?;
        verdict.judge(
            comparison,
            Grade::Fail,
            "not the derivative of an evaluation",
        );
    }
    Ok(())
}

/// Derivatives with respect to an input against quotients of what `end` answers when the input is changed.
fn against_quotients(
    bench: &Bench<'_>,
    (input, row): (usize, &[f64]),
    mut end: impl FnMut(f64) -> Result<Vec<f64>, Stop>,
) -> Result<Comparison, Stop> {
    let subject = &bench.subject;
    let limit = in_the_limit(bench.sizes[input], |change| {
        let (plus, minus) = (end(change)?, end(-change)?);
        let quotients: Vec<f64> = plus
            .iter()
            .zip(&minus)
            .map(|(plus, minus)| (plus - minus) / (2.0 * change))
            .collect();
        let largest: Vec<f64> = quotients
            .iter()
            .zip(row)
            .map(|(a, b)| a.abs().max(b.abs()))
            .collect();
        let sizes = subject.sizes_of_groups(&largest);
        let mut comparison = Comparison::default();
        for (output, name) in subject.outputs.iter().enumerate() {
            let floor = bench.floor(output, &[plus[output], minus[output]]) / change;
            if let Some(allowed) = allowed(LIMIT_SHARE, sizes[output], floor) {
                let name = format!("{name} per {}", subject.inputs[input]);
                comparison.near(name, row[output], quotients[output], allowed);
            }
        }
        Ok(comparison)
    })?;
    Ok(limit.comparison)
}
