//! Both runs of one problem.

use crate::other::{self, Other, Problem};
use crate::own::Own;

/// Largest difference of numbers at the samples.
pub fn largest_difference(theirs: &[Vec<f64>], own: &[Vec<f64>]) -> f64 {
    assert_eq!(theirs.len(), own.len());
    let pairs = theirs.iter().flatten().zip(own.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// What must agree.
#[derive(Debug, Clone, Copy)]
pub struct Expected {
    /// Steps of Siconos, the coarse one first.
    pub steps: [f64; 2],
    /// Differences of coordinates over the step are at most this.
    pub constant: f64,
    /// How differences fall from step to step, at least and at most.
    pub ratio: [f64; 2],
    /// Energy that is lost, if it is not that of our run.
    pub loss: Option<f64>,
}

/// Differences fall with the step of Siconos; the time of the first impact, the number of impacts and the loss of
/// energy are the same. Our own run is so much finer that its errors do not matter.
pub fn assert_agreement(problem: Problem<'_>, own: &Own, own_dt: f64, expected: Expected) {
    let mut runs: Vec<Other> = Vec::new();
    for dt in expected.steps {
        let Some(run) = other::run(problem, dt) else {
            return;
        };
        assert_eq!(run.impacts, own.impacts, "{problem:?}: dt {dt}");
        let [theirs, ours] = [run.first_impact, own.first_impact].map(Option::unwrap);
        assert!(
            (theirs - ours).abs() <= 1.5 * dt + own_dt,
            "{problem:?}: first impact {theirs}, own {ours}"
        );
        runs.push(run);
    }
    let differences: Vec<f64> = runs
        .iter()
        .map(|run| largest_difference(&run.samples, &own.samples))
        .collect();
    println!("{problem:?}: {differences:?}");
    for (difference, dt) in differences.iter().zip(expected.steps) {
        assert!(
            *difference < expected.constant * dt,
            "{problem:?}: {differences:?}"
        );
    }
    let ratio = differences[0] / differences[1];
    let [least, most] = expected.ratio;
    assert!(
        (least..most).contains(&ratio),
        "{problem:?}, order 1: {differences:?}"
    );
    let loss = expected.loss.unwrap_or(own.loss);
    // First order: the error falls with the step.
    let finer = expected.steps[0] / expected.steps[1];
    let extrapolated = runs[1].loss + (runs[1].loss - runs[0].loss) / (finer - 1.0);
    println!(
        "losses {} {}, in the limit {extrapolated}, own {loss}",
        runs[0].loss, runs[1].loss
    );
    assert!(
        (extrapolated - loss).abs() < 0.01 * loss,
        "{problem:?}: energy in the limit {extrapolated}, own {loss}"
    );
}
