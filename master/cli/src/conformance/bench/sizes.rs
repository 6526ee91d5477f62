//! How much each input is changed.

use crate::conformance::instance::Instance;
use crate::conformance::subject::Motion;

/// Accelerations that inputs are to cause where the model has no larger ones: m/s^2 and rad/s^2.
const LIVELY: [(Motion, f64); 2] = [(Motion::Translation, 10.0), (Motion::Rotation, 30.0)];

/// Share of an acceleration below which its change under a load of 1 is rounding: a body that a contact holds does not answer.
const NOTHING: f64 = 1e-12;

/// For each input the change that makes no acceleration of a marker change by more than the largest acceleration of its kind,
/// or [`LIVELY`]; 1 where no acceleration answers.
pub fn sizes(instance: &Instance<'_>) -> Vec<f64> {
    let subject = instance.subject;
    let unit = vec![1.0; subject.inputs.len()];
    let Ok(rest) = instance.evaluate(&subject.defaults) else {
        return unit;
    };
    let accelerations: Vec<(usize, Motion)> = subject
        .markers
        .iter()
        .flat_map(|marker| {
            let places = marker.acceleration.iter().enumerate();
            places.map(|(component, &output)| (output, marker.motion(component)))
        })
        .collect();
    let largest = |of: Motion, least: f64| {
        let own = accelerations.iter().filter(|(_, motion)| *motion == of);
        own.fold(least, |largest, (output, _)| {
            largest.max(rest[*output].abs())
        })
    };
    let scales = LIVELY.map(|(motion, least)| (motion, largest(motion, least)));
    let scale = |motion| {
        let own = scales.iter().find(|(of, _)| *of == motion);
        own.map_or(1.0, |(_, scale)| *scale)
    };
    let size = |input: usize| {
        let mut values = subject.defaults.clone();
        values[input] += 1.0;
        let changed = instance.evaluate(&values).ok()?;
        accelerations
            .iter()
            .filter_map(|&(output, motion)| {
                let change = (changed[output] - rest[output]).abs();
                (change > NOTHING * scale(motion)).then(|| scale(motion) / change)
            })
            .min_by(f64::total_cmp)
    };
    (0..subject.inputs.len())
        .map(|input| size(input).unwrap_or(1.0))
        .collect()
}
