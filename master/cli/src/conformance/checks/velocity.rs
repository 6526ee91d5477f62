//! Velocities change by the accelerations.

use super::{About, Check};
use crate::conformance::bench::{Bench, PRELUDE};
use crate::conformance::compare::{Comparison, rounding};
use crate::conformance::inputs::Inputs;
use crate::conformance::measured::{LIMIT_SHARE, Limit, allowed, in_the_limit};
use crate::conformance::subject::Motion;
use crate::conformance::verdict::{Stop, Verdict};

/// The change of velocity over a short step is its length times the mean acceleration.
pub struct Velocity;

/// Steps of the same length before the one that is looked at: solvers that carry accelerations along have those of a longer step
/// at first.
pub const BEFORE: usize = 8;

/// A velocity with its acceleration.
struct Pair {
    motion: Motion,
    velocity: usize,
    acceleration: usize,
}

impl Check for Velocity {
    fn about(&self) -> About {
        About {
            name: "velocity",
            title: "velocities change by the mean acceleration, gravity and loads included",
            equation: "v(T + h) - v(T) = h (a(T) + a(T + h))/2 + O(h^3)",
            tolerance: "1e-3 of the change, at the one of the steps h = H, H/4, .. that misses it least",
            look_at: "whether accelerations are those of the point, with gravity, in inertial axes and under the present loads, and whether \
                      Step applies the same loads as Evaluate",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let pairs = pairs(bench);
        if pairs.is_empty() {
            return Err(Stop::not_applicable(
                "no marker of the model tells velocity and acceleration",
            ));
        }
        // Those that the prelude ends with: no solver has to notice a jump.
        let inputs = bench.prelude(PRELUDE);
        let limit = closest(bench, &pairs, &inputs)?;
        limit.judge(
            verdict,
            bench.grade_of_motion(),
            "velocities change otherwise",
        );
        Ok(())
    }
}

fn pairs(bench: &Bench<'_>) -> Vec<Pair> {
    let markers = bench.subject.markers.iter();
    let of_marker = markers.flat_map(|marker| {
        let places = marker.velocity.iter().zip(&marker.acceleration).enumerate();
        places.map(|(component, (&velocity, &acceleration))| Pair {
            motion: marker.motion(component),
            velocity,
            acceleration,
        })
    });
    of_marker.collect()
}

fn closest(bench: &Bench<'_>, pairs: &[Pair], inputs: &Inputs) -> Result<Limit, Stop> {
    let mut instance = bench.in_motion()?;
    let start = instance.keep()?;
    in_the_limit(bench.step(), |step| {
        instance.go_back(&start)?;
        for _ in 0..BEFORE {
            instance.step(step, inputs)?;
        }
        let before = instance.evaluate(&inputs.values(0.0))?;
        instance.step(step, inputs)?;
        let after = instance.evaluate(&inputs.values(1.0))?;
        let changes: Vec<[f64; 2]> = pairs
            .iter()
            .map(|pair| {
                let mean = (before[pair.acceleration] + after[pair.acceleration]) / 2.0;
                [after[pair.velocity] - before[pair.velocity], step * mean]
            })
            .collect();
        let size = |of: Motion| {
            let alike = pairs
                .iter()
                .zip(&changes)
                .filter(|(own, _)| own.motion == of);
            let largest =
                |size: f64, change: &[f64; 2]| size.max(change[0].abs()).max(change[1].abs());
            alike.fold(0.0_f64, |size, (_, change)| largest(size, change))
        };
        let mut comparison = Comparison::default();
        for (pair, [found, expected]) in pairs.iter().zip(&changes) {
            let floor =
                4.0 * bench.tolerance + rounding(&[before[pair.velocity], after[pair.velocity]]);
            if let Some(allowed) = allowed(LIMIT_SHARE, size(pair.motion), floor) {
                let place = format!("change of {}", bench.subject.outputs[pair.velocity]);
                comparison.near(place, *found, *expected, allowed);
            }
        }
        Ok(comparison)
    })
}
