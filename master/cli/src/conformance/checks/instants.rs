//! Outputs inside a step are the ends of shorter ones.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::instance::Inside;
use crate::conformance::verdict::{Stop, Verdict};

/// Interior outputs are those of steps that end at the instants.
pub struct Instants;

/// Where a step is cut, as shares of it.
const SHARES: [f64; 3] = [0.2, 0.5, 0.7];

/// Share of the distance between the motion and a straight line by which interior outputs may be off: interpolation shows.
const OF_BEND: f64 = 0.1;

impl Check for Instants {
    fn about(&self) -> About {
        About {
            name: "instants",
            title: "outputs at instants are those of steps that end there, and the step ends as one that is cut there",
            equation: "outputs at T + c_i H = ends of the steps from T + c_(i-1) H to T + c_i H under the same polynomials",
            tolerance: "0.1 of the distance between the motion and the straight line over the step, and 4 times the solver's tolerance",
            look_at: "whether internal steps end at the instants (nothing is interpolated), instants count from the start of the step, and \
                      the order of the answer: all interior outputs at the first instant, then at the second one",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let subject = &bench.subject;
        if !subject.capabilities.interior_outputs {
            return Err(Stop::not_applicable(
                "the model offers no outputs inside a step",
            ));
        }
        let (step, count) = (bench.step(), subject.outputs.len());
        let inputs = bench.loaded(3);
        let mut instance = bench.in_motion()?;
        let begin = instance.evaluate(&inputs.values(0.0))?;
        let start = instance.keep()?;
        let instants = SHARES.map(|share| share * step);
        let inside = Inside {
            instants: &instants,
            integrals: 0,
        };
        let cut = instance.step_inside(step, &inputs, inside)?;

        instance.go_back(&start)?;
        let mut ends = Vec::new();
        let mut from = 0.0;
        for share in SHARES.into_iter().chain([1.0]) {
            ends.push(instance.step_part([from, share], step, &inputs)?);
            from = share;
        }
        let Some((last, interior)) = ends.split_last() else {
            return Ok(());
        };
        let bend = |output: usize| {
            let straight = |share: f64| begin[output] + share * (last[output] - begin[output]);
            let ways = SHARES.iter().zip(interior);
            ways.fold(0.0_f64, |bend, (&share, own)| {
                bend.max((own[output] - straight(share)).abs())
            })
        };
        let mut comparison = Comparison::default();
        let lists = [(&1.0, last)]
            .into_iter()
            .chain(SHARES.iter().zip(interior));
        for ((share, expected), found) in lists.zip(cut.chunks(count)) {
            for (output, name) in subject.outputs.iter().enumerate() {
                let floor = bench.floor(output, &[expected[output], begin[output]]);
                let allowed = OF_BEND * bend(output) + floor;
                let place = format!("{name} at {share} H");
                comparison.near(place, found[output], expected[output], allowed);
            }
        }
        verdict.judge(
            comparison,
            bench.grade_of_motion(),
            "other values than steps that end there",
        );
        Ok(())
    }
}
